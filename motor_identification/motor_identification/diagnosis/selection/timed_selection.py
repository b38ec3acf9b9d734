"""Select which effects are missing beside the timing of the speeds: once, and again where what was found shows another.

What nobody knew of yet hides a timing, or is taken for one; and a timing hides what nobody knew of.
"""

from dataclasses import replace

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.selection.selection import Selection
from motor_identification.diagnosis.selection.whole_selection import Selected, select_best, select_in_time
from motor_identification.diagnosis.start import (
    Start,
    begin_as_timed,
    find_earlier_voltages_beside,
    find_timing_beside,
    find_voltages_beside,
)
from motor_identification.estimation.request import Request
from motor_identification.progress import ProgressReporter, Stopped, TimeLimit
from motor_identification.timing.timing import ASSUMED, Timing
from motor_model.effects import EFFECT_BY_NAME, LAGGING, LAGS

(DEAD_TIME,) = set(LAGS).difference(LAGGING)
AGE_MARGIN = 0.1  # rows: by how much a dead time may differ from the age of means
DONE_ONCE = 0.95  # of the progress, where a selection is made again


def select_as_timed(
    first: Start, request: Request, reporter: ProgressReporter, limit: TimeLimit[Selection]
) -> tuple[Start, Selected]:
    """Select what is missing with speeds as their motion shows that they were made; once more if that shows otherwise.

    And where something is left that can be predicted, by voltages that held until the rows, if those leave nothing.
    """
    start, selected = _select_beside_timing(first, request, reporter, limit)
    if not selected.finished or selected.selection.model.complete:
        return start, selected
    return _select_by_earlier_voltages(first, start, selected, request, reporter, limit) or (start, selected)


def _select_beside_timing(
    first: Start, request: Request, reporter: ProgressReporter, limit: TimeLimit[Selection]
) -> tuple[Start, Selected]:
    """Select what is missing beside the timing that the motion shows; once more if what was found shows another.

    What was not known yet may have been taken for another timing, which a lag then undoes: so it was where the new one
    leaves no more. Or for a filter: so it was where without it half is left.
    """
    limit.begin_with(first.selection)
    try:
        start = begin_as_timed(first, find_timing_beside(first, first.selection), request, reporter.stopped)
    except Stopped:
        return first, select_best(limit)
    limit.begin_with(start.selection)
    selected = select_in_time(start.selection, reporter, limit)
    if not selected.finished:
        return start, selected
    if start.timing is None:
        nearest = _select_as_timed_by_nearest(first, selected, request, reporter, limit)
        nearest = nearest or _select_as_timed_beside_lag(first, selected, request, reporter, limit)
        return nearest or _select_by_voltages_before(first, selected, request, reporter, limit) or (start, selected)
    # A filter behind which more is left than the sensor leaves may be what was not known yet. Measured: of times
    # between edges a ripple was taken for one, with a gap of six times what the true timing leaves.
    above, complete = selected.selection.model.above_floor, selected.selection.model.complete
    doubted = start.timing.filter is not None and above
    # Where something is left that can be predicted, too. Measured: beside a drag that nobody knew of, speeds of 3 edges
    # a turn over the times between them seemed values of instants, and the drag alone left 38 times the floor.
    if not (doubted or (above and not complete) or set(LAGS).intersection(selected.effects)):
        return start, selected
    timing = find_timing_beside(first, selected.selection, filtered=not doubted, lagging=True)
    most = thresholds.HALVED_GAP if doubted else thresholds.GAP_CHANCE
    if timing == start.timing:
        return _select_as_means(first, start, selected, request, reporter, limit) or (start, selected)
    again, other = _select_again(first, timing, request, reporter, limit)
    if other is None:
        return start, replace(selected, finished=False)
    model = other.selection.model
    # What a filter hides of the noise makes a gap smaller, too: without it, all has to be explained.
    # Or by far more than it hides. Measured: beside an open play, a false one left 370 rad/s and none 55.
    gap, before = model.held.gap, selected.selection.model.held.gap
    alike = gap <= most * before and (model.complete or not doubted or gap <= thresholds.FAR_LESS_GAP * before)
    return (again, other) if alike or _needs_no_lag(start, selected, again, other) else (start, selected)


def _needs_no_lag(start: Start, selected: Selected, again: Start, other: Selected) -> bool:
    """Decide whether voltages that hold from the rows on explain all without the lag that undoes those before.

    Measured: a slot that was told 22 % too long, of an eccentric disc, left 0.28 rad/s by a dead time of 0.93 of a row
    behind the voltages that held before, and 0.32 rad/s, no more than the sensor does, by the others without any.
    """
    undone = start.timing is not None and start.timing.is_early
    undone &= again.timing is None or not again.timing.is_early
    model = other.selection.model
    return undone and set(other.effects) < set(selected.effects) and model.complete and not model.above_floor


def _select_as_means(
    first: Start,
    start: Start,
    selected: Selected,
    request: Request,
    reporter: ProgressReporter,
    limit: TimeLimit[Selection],
) -> tuple[Start, Selected] | None:
    """Select once more with means over rows, where values of instants need a dead time as long as those are old.

    That is the same motion in more words. None where means leave more, or need as many effects. Measured: of means over
    rows of 1 and 10 ms, whose inductance or friction nobody knew of when they seemed instants, the dead times were
    0.976 and 0.996 of half a row.
    """
    timing = start.timing
    if timing is None or not _needs_age_of_means(start, selected):
        return None
    means = replace(ASSUMED, rows=timing.rows)
    again, other = _select_again(first, None if means == ASSUMED else means, request, reporter, limit)
    if other is None:
        return start, replace(selected, finished=False)
    fewer = set(other.effects) < set(selected.effects)
    return (again, other) if fewer and _leaves_no_more(other, selected) else None


def _needs_age_of_means(start: Start, selected: Selected) -> bool:
    """Decide whether values of instants need a dead time that is as long as means over the row before are old."""
    timing = start.timing
    instants = timing is not None and timing.lag == 0.0 and timing.slot == 0.0 and timing.filter is None
    if not instants or DEAD_TIME not in selected.effects:
        return False
    seconds = selected.selection.model.estimate.parameters.value(EFFECT_BY_NAME[DEAD_TIME].parameters[0].name)
    row = min(recording.info.sample_period for recording in start.recordings)
    return abs(seconds - ASSUMED.lag * row) <= AGE_MARGIN * row


def _select_as_timed_by_nearest(
    first: Start, selected: Selected, request: Request, reporter: ProgressReporter, limit: TimeLimit[Selection]
) -> tuple[Start, Selected] | None:
    """Select once more where something is left that can be predicted, and the nearest model shows another timing.

    What was not known hid it. None where nothing is left, it shows none, or does not explain all. Measured: beside a
    backlash that nobody knew of a tachogenerator's own instants were likelier by 14 only, in 600 rows, and half a row
    kept the backlash from explaining what it does. Beside an inductance of a third of the time constant of 5 ms they
    did not show at 1 kHz, unless it was fitted too. Nor where a torque is said to be all that is left, and the nearest
    halves it: of a friction and a drag in speeds over times between edges 1.49 rad/s were left, and 0.74 by a load and
    its step, beside which that shows. Nor where it needs a dead time that undoes it: the motion is that of means then,
    in more words. Measured: of means under two levels, whose breakaway nobody can know of there, instants were taken
    with a dead time of 0.985 of half a row and a drag, neither of which was in the motor.
    """
    model, nearest = selected.selection.model, limit.best
    if nearest is None or not nearest.steps or not model.above_floor:
        return None
    halves = not selected.effects and nearest.model.held.gap < thresholds.HALVED_GAP * model.held.gap
    if model.complete and not halves:
        return None
    timing = find_timing_beside(first, nearest, lagging=True)
    if timing is None:
        return None
    again, other = _select_again(first, timing, request, reporter, limit)
    if other is None:
        return first, replace(selected, finished=False)
    if other.selection.model.complete and not _needs_age_of_means(again, other):
        return again, other
    limit.begin_with(nearest)  # of which is told where nothing is named
    return None


def _select_as_timed_beside_lag(
    first: Start, selected: Selected, request: Request, reporter: ProgressReporter, limit: TimeLimit[Selection]
) -> tuple[Start, Selected] | None:
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
    return (again, other) if _leaves_no_more(other, selected) else None


def _select_by_voltages_before(
    first: Start, selected: Selected, request: Request, reporter: ProgressReporter, limit: TimeLimit[Selection]
) -> tuple[Start, Selected] | None:
    """Select once more where counts answer voltages that held until their rows, beside all that explains them.

    None where they do not, or where what is selected by these leaves more or needs more effects. Measured: of ramps
    with rows of a 160th of the time constant the voltages that held before were likelier by 155, 0.013 a row, and by
    the others a load of 1.3 mV was named, 17 of its standard errors, which is not there.
    """
    if not selected.selection.model.complete:
        return None
    timing = find_voltages_beside(first, selected.selection)
    if timing is None:
        return None
    again, other = _select_again(first, timing, request, reporter, limit)
    if other is None:
        return first, replace(selected, finished=False)
    alike = other.selection.model.complete and _leaves_no_more(other, selected)
    return (again, other) if alike and len(other.effects) <= len(selected.effects) else None


def _select_by_earlier_voltages(
    first: Start,
    start: Start,
    selected: Selected,
    request: Request,
    reporter: ProgressReporter,
    limit: TimeLimit[Selection],
) -> tuple[Start, Selected] | None:
    """Select once more by voltages that held until the rows, beside a lag that hid them; None if not all is explained.

    Measured: of a limit and an inductance of 0.4 of the time constant, in rows of a sixtieth of it, one row left 64
    times the floor, "outside the table"; and of a dead zone behind a filter of a row and a half 1.5 times.
    """
    nearest = limit.best if limit.best is not None and limit.best.steps else selected.selection
    timing = find_earlier_voltages_beside(first, nearest, start.timing)
    if timing is None:
        return None
    again, other = _select_again(first, timing, request, reporter, limit)
    if other is None:
        return start, replace(selected, finished=False)
    if other.selection.complete and _leaves_no_more(other, selected):
        return again, other
    limit.begin_with(nearest)  # of which is told where nothing is named
    return None


def _leaves_no_more(other: Selected, selected: Selected) -> bool:
    """Decide whether what was selected by another timing leaves no larger a gap, but for chance."""
    return other.selection.model.held.gap <= thresholds.GAP_CHANCE * selected.selection.model.held.gap


def _select_again(
    first: Start, timing: Timing | None, request: Request, reporter: ProgressReporter, limit: TimeLimit[Selection]
) -> tuple[Start, Selected | None]:
    """Select once more with speeds that were made by another timing; nothing is selected where time is used up."""
    if not limit.begin_again():
        return first, None
    again = begin_as_timed(first, timing, request, reporter.stopped)
    selected = select_in_time(again.selection, reporter.beyond(DONE_ONCE), limit)
    return again, selected if selected.finished else None
