"""Begin a diagnosis: hold out what it is judged by, fit the known model to the rest, and time speeds as they show."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from motor_identification.diagnosis.selection.selection import Selection, begin_selection
from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.request import Request, SearchReport
from motor_identification.estimation.search.global_search import search_globally
from motor_identification.estimation.thinning import thin_problem
from motor_identification.periodic.periodic_fit import add_periodic_effects, drop_periodic_effects
from motor_identification.recording import Recording
from motor_identification.timing.speed_timing import find_earlier_voltages, find_timing, find_voltages
from motor_identification.timing.timing import Timing
from motor_identification.validation.hold_out import HoldOut, make_hold_out
from motor_model.effects import normalised


@dataclass(frozen=True)
class Start:
    """What a diagnosis begins with: recordings, and the known model fitted to them."""

    recordings: Sequence[Recording]
    validation: Sequence[Recording]
    selection: Selection  # without steps
    search: SearchReport
    timing: Timing | None = None  # of speeds, where it is not as assumed


def begin(
    recordings: Sequence[Recording],
    validation: Sequence[Recording],
    request: Request,
    stopped: Callable[[], bool],
) -> Start:
    """Hold out what the diagnosis is judged by, and fit the known model to the rest."""
    hold_out = make_hold_out(recordings, validation, stopped)
    return Start(recordings, validation, *fit_known(recordings, request, hold_out))


def fit_known(recordings: Sequence[Recording], request: Request, hold_out: HoldOut) -> tuple[Selection, SearchReport]:
    """Fit the model to begin with to what is not held out, searched globally."""
    known = normalised(request.effects)
    effects, stopped = drop_periodic_effects(known), hold_out.problem.stopped
    whole = thin_problem(make_problem(recordings, effects, request.workers, stopped))
    estimate, search = search_globally(hold_out.restrict(whole), request.search)
    single = estimate.on(replace(estimate.problem, workers=1))  # effects are tried at a time instead
    return begin_selection(add_periodic_effects(single, known), hold_out, request.workers), search


def find_timing_beside(
    first: Start, selection: Selection, filtered: bool = True, lagging: bool = False
) -> Timing | None:
    """Find how speeds, which nobody timed, were made, as the motion shows beside what was selected; None as assumed.

    filtered: whether they may have passed a filter. lagging: whether, where none is found so,
    an inductance among it is believed.
    """
    model, restrict = selection.model, first.selection.hold_out.restrict
    return find_timing(first.recordings, model.estimate, restrict, model.effects, filtered, lagging)


def find_voltages_beside(first: Start, selection: Selection) -> Timing | None:
    """Find whether counts answer voltages that held until their rows, beside what was selected and explains all.

    None where they do not, or where they are no counts of which nobody said it.
    """
    model, restrict = selection.model, first.selection.hold_out.restrict
    return find_voltages(first.recordings, model.estimate, restrict, model.effects)


def find_earlier_voltages_beside(first: Start, selection: Selection, timing: Timing | None) -> Timing | None:
    """Find whether voltages held until rows, beside an inductance and what was selected by another timing.

    None where they do not, or where somebody said from when on they hold.
    """
    model, restrict = selection.model, first.selection.hold_out.restrict
    return find_earlier_voltages(first.recordings, model.estimate, restrict, model.effects, timing)


def begin_as_timed(first: Start, timing: Timing | None, request: Request, stopped: Callable[[], bool]) -> Start:
    """Begin again where speeds were made otherwise than assumed."""
    if timing is None:
        return first
    again = begin(timing.set_on(first.recordings), timing.set_on(first.validation), request, stopped)
    return replace(again, timing=timing)
