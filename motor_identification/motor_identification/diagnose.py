"""Diagnose a motor: find which effects are missing from its model by stepwise selection on held-out motion.

Forward selection tries every effect of the table on top of the model, with all parameters fitted again (a wrong
parameter eats missing physics), and takes the one under which held-out motion is most likely (`noise/likelihood.py`),
if it is likely enough not to be a false alarm and explains enough of the gap. Afterwards backward elimination takes
back what is not needed beside the others.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from time import perf_counter

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.effect_test import sort_by_table
from motor_identification.diagnosis.evidence.sensor_lag import may_lag
from motor_identification.diagnosis.evidence.static_evidence import find_untold, is_told_alone
from motor_identification.diagnosis.result import Diagnosis, Verdict
from motor_identification.diagnosis.selection.backward_elimination import eliminate_backward
from motor_identification.diagnosis.selection.determination import drop_undetermined, drop_undetermined_at_once
from motor_identification.diagnosis.selection.forward_selection import select_forward
from motor_identification.diagnosis.selection.restarts import retry_with_another_first, retry_with_pair
from motor_identification.diagnosis.selection.rivals import check_beside_torque
from motor_identification.diagnosis.selection.selection import Selection
from motor_identification.diagnosis.selection.stand_ins import (
    doubt_instants,
    drop_stand_ins,
    drop_stand_ins_of_either,
    keep_confirmed,
)
from motor_identification.diagnosis.selection.torque_selection import (
    fits_slow_torque,
    list_hidden_by_torque,
    select_beside_torque,
)
from motor_identification.diagnosis.start import Start, begin, begin_as_timed, find_timing_beside
from motor_identification.diagnosis.verdict import conclude, find_nearest
from motor_identification.estimation.request import Request
from motor_identification.measurement.request_checks import check_effects
from motor_identification.progress import ProgressReporter, Stage, Stopped, TimeLimit
from motor_identification.recording import Recording
from motor_identification.sensor.description import note_sensors
from motor_identification.timing.timing import Timing
from motor_model.effects import LAGGING, LAGS
from motor_model.errors import RecordingError
from motor_model.program.memory import ask_for_room

__all__ = ["Request", "Stage", "Stopped", "diagnose"]

ROOM = 256 * 2**20  # [bytes] half a minute at 200 Hz on two cores fits in 330 MiB beside the imports, not in 230
NOTHING_KNOWN = Request()
DONE_ONCE = 0.95  # of the progress, where a selection is made again


def diagnose(
    recordings: Sequence[Recording],
    validation: Sequence[Recording] = (),
    request: Request = NOTHING_KNOWN,
    progress: Callable[[Stage], None] | None = None,
    stopped: Callable[[], bool] | None = None,
) -> Diagnosis:
    """Diagnose checked recordings of one motor; without `validation` a quarter of them is kept out of every fit.

    The effects of `request` are in the model already, when the diagnosis begins. Where its time limit ends the search,
    the best model so far is the result, and undecided.

    Raises:
        ModelError: a known effect is not in the table, or no fit of these recordings can have it.
        NotEnoughMemory: a fit has no room.
        RecordingError: a recording cannot answer.
        Stopped: `stopped` said so.
    """
    begun = perf_counter()
    if not recordings:
        raise RecordingError("there is no recording to diagnose: name at least one bag.")
    ask_for_room(ROOM)
    check_effects(request.effects)
    recordings, validation = note_sensors(recordings), note_sensors(validation)
    limit = TimeLimit(request.time_limit, stopped or (lambda: False), _has_smaller_gap)
    reporter = ProgressReporter(progress or (lambda stage: None), limit.over, limit.keep)
    reporter.report("first fit", 0.0, "", float("nan"))
    first = begin(recordings, validation, request, reporter.stopped)
    start, selected = _select_as_timed(first, request, reporter, limit)
    found = conclude(
        start.selection.model,
        selected.selection,
        start.recordings,
        start.validation,
        start.search,
        lambda: perf_counter() - begun,
        selected.undetermined,
        may_lag(first.recordings, start.recordings),
    )
    found = replace(found, model=replace(found.model, timing=start.timing))
    if not selected.finished:
        return replace(found, verdict=Verdict.UNDECIDED, time_limit=limit.seconds)
    if _is_silent(found) and limit.best is not None:
        return replace(found, nearest=find_nearest(limit.best, found.gap_before))
    return found


def _is_silent(found: Diagnosis) -> bool:
    """Decide whether something is or may be missing, and nothing of the table is named for it.

    Where the fits have seen what they are judged by, a gap that something takes away is a reason to tell of it only
    where sensor and random torque leave less.
    """
    above = found.gap_after > thresholds.EXPLAINED_GAP * found.noise_floor
    open_ = found.verdict is Verdict.UNDECIDED and (above or not found.after.seen)
    return not found.findings and (open_ or found.verdict is Verdict.UNEXPLAINED)


def _has_smaller_gap(one: Selection, other: Selection) -> bool:
    return one.model.held.gap < other.model.held.gap


@dataclass(frozen=True)
class _Selected:
    """What was selected, and whether there was time to finish."""

    selection: Selection
    undetermined: tuple[str, ...]  # effects one of which may be missing
    finished: bool

    @property
    def effects(self) -> tuple[str, ...]:
        """What the model has."""
        return self.selection.model.effects


def _select_in_time(start: Selection, reporter: ProgressReporter, limit: TimeLimit[Selection]) -> _Selected:
    """Select what is missing, or return the best selection so far once the time is used up."""
    try:
        selected = _Selected(*_select(start, reporter), finished=True)
    except Stopped:
        return _select_best(limit)
    limit.done = True
    return selected


def _select_best(limit: TimeLimit[Selection]) -> _Selected:
    """Select the best so far, where the time is used up.

    Raises:
        Stopped: it is not, or there is none: the caller wanted an end.
    """
    if not limit.reached or limit.best is None:
        raise Stopped("the diagnosis was stopped.")
    limit.done = True  # what is left is to say it
    return _Selected(drop_undetermined_at_once(drop_stand_ins(limit.best)), (), finished=False)


def _select_as_timed(
    first: Start, request: Request, reporter: ProgressReporter, limit: TimeLimit[Selection]
) -> tuple[Start, _Selected]:
    """Select what is missing with speeds as their motion shows that they were made; once more if that shows otherwise.

    What was not known yet may have been taken for another timing, which a lag then undoes: so it was where the new one
    leaves no more. Or for a filter: so it was where without it half is left.
    """
    limit.begin_with(first.selection)
    try:
        start = begin_as_timed(first, find_timing_beside(first, first.selection), request, reporter.stopped)
    except Stopped:
        return first, _select_best(limit)
    limit.begin_with(start.selection)
    selected = _select_in_time(start.selection, reporter, limit)
    if not selected.finished:
        return start, selected
    if start.timing is None:
        nearest = _select_as_timed_by_nearest(first, selected, request, reporter, limit)
        return nearest or _select_as_timed_beside_lag(first, selected, request, reporter, limit) or (start, selected)
    # A filter behind which more is left than the sensor leaves may be what was not known yet. Measured: of times
    # between edges a ripple was taken for one, with a gap of six times what the true timing leaves.
    doubted = start.timing.filter is not None and selected.selection.model.above_floor
    if not (doubted or set(LAGS).intersection(selected.effects)):
        return start, selected
    timing = find_timing_beside(first, selected.selection, filtered=not doubted, lagging=True)
    most = thresholds.HALVED_GAP if doubted else thresholds.GAP_CHANCE
    if timing == start.timing:
        return start, selected
    again, other = _select_again(first, timing, request, reporter, limit)
    if other is None:
        return start, replace(selected, finished=False)
    model = other.selection.model
    # What a filter hides of the noise makes a gap smaller, too: without it, all has to be explained.
    alike = model.held.gap <= most * selected.selection.model.held.gap and (model.complete or not doubted)
    return (again, other) if alike else (start, selected)


def _select_as_timed_by_nearest(
    first: Start, selected: _Selected, request: Request, reporter: ProgressReporter, limit: TimeLimit[Selection]
) -> tuple[Start, _Selected] | None:
    """Select once more where something is left that can be predicted, and the nearest model shows another timing.

    What was not known hid it. None where nothing is left, it shows none, or does not explain all. Measured: beside a
    backlash that nobody knew of a tachogenerator's own instants were likelier by 14 only, in 600 rows, and half a row
    kept the backlash from explaining what it does. Beside an inductance of a third of the time constant of 5 ms they
    did not show at 1 kHz, unless it was fitted too.
    """
    model, nearest = selected.selection.model, limit.best
    if nearest is None or not nearest.steps or not model.above_floor or model.complete:
        return None
    timing = find_timing_beside(first, nearest, lagging=True)
    if timing is None:
        return None
    again, other = _select_again(first, timing, request, reporter, limit)
    if other is None:
        return first, replace(selected, finished=False)
    if other.selection.model.complete:
        return again, other
    limit.begin_with(nearest)  # of which is told where nothing is named
    return None


def _select_as_timed_beside_lag(
    first: Start, selected: _Selected, request: Request, reporter: ProgressReporter, limit: TimeLimit[Selection]
) -> tuple[Start, _Selected] | None:
    """Select once more where an inductance was found, and another timing shows beside it; None if that leaves more.

    Measured: 1.1 ms of 1.6, whose missing half a millisecond was that of values of their rows' own instants.
    """
    if not set(LAGGING).intersection(selected.effects):
        return None
    timing = find_timing_beside(first, selected.selection, lagging=True)
    if timing is None:
        return None
    again, other = _select_again(first, timing, request, reporter, limit)
    if other is None:
        return first, replace(selected, finished=False)
    alike = other.selection.model.held.gap <= thresholds.GAP_CHANCE * selected.selection.model.held.gap
    return (again, other) if alike else None


def _select_again(
    first: Start, timing: Timing | None, request: Request, reporter: ProgressReporter, limit: TimeLimit[Selection]
) -> tuple[Start, _Selected | None]:
    """Select once more with speeds that were made by another timing; nothing is selected where time is used up."""
    if not limit.begin_again():
        return first, None
    again = begin_as_timed(first, timing, request, reporter.stopped)
    selected = _select_in_time(again.selection, reporter.beyond(DONE_ONCE), limit)
    return again, selected if selected.finished else None


def _select(start: Selection, reporter: ProgressReporter) -> tuple[Selection, tuple[str, ...]]:
    """Select forward and eliminate backward, beside a random torque where there is one; and what is undetermined."""
    first = select_forward(start, reporter)
    selection = plain = retry_with_pair(retry_with_another_first(first, reporter), reporter)
    reporter.report("checking", 0.9, "", plain.model.held.gap)
    beside = select_beside_torque(start, plain, reporter)
    if beside is None:
        selection = eliminate_backward(drop_stand_ins_of_either(first, selection), reporter)
        if selection.model.complete and selection.model.above_floor:
            selection = check_beside_torque(selection, reporter)
    elif beside.steps and fits_slow_torque(beside, start):
        selection = eliminate_backward(keep_confirmed(selection, beside.model.effects), reporter)
    else:
        selection = beside
    left, undetermined = drop_undetermined(selection, reporter)
    left = doubt_instants(left)
    if selection is beside:
        undetermined = undetermined or list_hidden_by_torque(plain, beside)
    if untold := set(find_untold(left.model)) - set(start.model.effects):
        if selection is beside and is_told_alone(plain.model, left.model):
            return drop_undetermined(plain, reporter)
        return start, sort_by_table(untold | set(undetermined))
    # What is left of a model that fits a slow torque instead of the motion tells less than the one to begin with.
    return start if fits_slow_torque(left, start) else left, undetermined
