"""Diagnose a motor: find which effects are missing from its model by stepwise selection on held-out motion.

Forward selection tries every effect of the table on top of the model, with all parameters fitted again (a wrong
parameter eats missing physics), and takes the one under which held-out motion is most likely (`noise/likelihood.py`),
if it is likely enough not to be a false alarm and explains enough of the gap. Afterwards backward elimination takes
back what is not needed beside the others.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from time import perf_counter

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import tosses
from motor_identification.diagnosis.evidence.sensor_lag import may_lag
from motor_identification.diagnosis.findings import find_nearest
from motor_identification.diagnosis.result import Diagnosis, Verdict
from motor_identification.diagnosis.selection.selection import Selection
from motor_identification.diagnosis.selection.timed_selection import select_as_timed
from motor_identification.diagnosis.start import begin
from motor_identification.diagnosis.verdict import conclude
from motor_identification.estimation.request import Request
from motor_identification.measurement.request_checks import check_effects
from motor_identification.measurement.sanity_checks import find_undriven
from motor_identification.progress import ProgressReporter, Stage, Stopped, TimeLimit
from motor_identification.recording import Recording
from motor_identification.sensor.description import note_sensors
from motor_model.errors import RecordingError
from motor_model.program.memory import ask_for_room

__all__ = ["Request", "Stage", "Stopped", "diagnose"]

ROOM = 256 * 2**20  # [bytes] half a minute at 200 Hz on two cores fits in 330 MiB beside the imports, not in 230
NOTHING_KNOWN = Request()


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
    undriven = find_undriven(recordings)
    if undriven is not None:
        base = first.selection
        found = conclude(base.model, base, recordings, validation, first.search, lambda: perf_counter() - begun)
        return replace(found, verdict=Verdict.UNDECIDED, undriven=undriven, undetermined=(), suggested_experiment="")
    start, selected = select_as_timed(first, request, reporter, limit)
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
    where sensor and random torque leave less; or the torque is larger than those of gears and loads. Measured: a torque
    of 13 % of the voltage in three levels of a real motor, whose coasting bridge halved the gap alone.
    """
    above = found.gap_after > thresholds.EXPLAINED_GAP * found.noise_floor
    torque = found.disturbance
    above |= torque is not None and tosses(torque, found.after.recordings)
    open_ = found.verdict is Verdict.UNDECIDED and (above or not found.after.seen)
    return not (found.findings or found.is_of_no_motor) and (open_ or found.verdict is Verdict.UNEXPLAINED)


def _has_smaller_gap(one: Selection, other: Selection) -> bool:
    return one.model.held.gap < other.model.held.gap
