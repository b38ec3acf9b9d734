"""Find when a log's speeds were made, where nobody said: means over the row before, or values of the row's own instant.

Speeds that were counted are means over the row before, and so an importer takes them. The value of a tachogenerator, or
what a simulation wrote, is that of its own instant: half a row younger, and sharper where the motion bends. Some
programs write a row when its voltage has been applied: then the motion seems to answer a voltage before it is there,
which no effect does, since a dead time is never negative. So every timing is fitted beside what shapes most motions,
and one that is much likelier is taken; a row more only where the motion still comes too early. Then, of speeds as they
were before any filter, whether the motion goes by the rows' stamps or by a clock that these are late on, and whether
each was computed with the length of its own row (`row_times.py`). Or a speed is a slot over the time between the latest
two edges, and the older the slower (`pulse_slot.py`). Counts are read at their rows: of those, only the voltages may be
of another time (`held_until.py`).
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import inf

import numpy as np

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.problem import Problem
from motor_identification.recording import Floats, Recording
from motor_identification.sensor.speed_sensor import find_speed_sensor, is_converted, lies_on_steps
from motor_identification.timing.error_likelihood import measure_log_likelihood
from motor_identification.timing.held_until import find_held_behind_lag, held_until
from motor_identification.timing.pulse_slot import (
    are_coarse,
    find_likeliest_slot,
    find_shown_slot,
    list_tick_slots,
    measure_gain_of_speeds,
    measure_gain_over_lag,
    measure_usual_travel,
)
from motor_identification.timing.row_times import AS_STAMPED, RowTimes, list_row_times
from motor_identification.timing.shaped_fit import ShapedFit, Shaper, measure_gain
from motor_identification.timing.smoothing import AS_LIKELY, Likelihood, find_filter
from motor_identification.timing.timing import ASSUMED, LEAST_DELAY, OTHERS, UNTIL, Timing, is_open, is_voltage_open
from motor_model.effects import EFFECT_BY_NAME, LAGGING, LAGS
from motor_model.sample import Measurement

# Of log likelihood, in all and a row, which another timing has to be worth. Measured: 100 and more, 0.1 to 1 a row,
# where it is another; up to 17 in all (0.004 a row) where it is as assumed and something else is missing; 0 to 25
# (0.03) in logs of others, of which nobody knows.
LEAST_GAIN, LEAST_GAIN_OF_ROW = 20.0, 0.02
# A row, of values of their rows' own instants, which make the motion half a row later and nothing early. Measured:
# 0.008 to 0.018 of tachogenerators in thousands of rows, of which one had a friction made up for it; 0.003 of counts.
LEAST_GAIN_OF_INSTANT = 0.006
# A row, of a slot that no stays show. Measured: 0.01 to 0.9 of most speeds over times between edges; of 107 other logs
# at most 0.04 where it is 14 and less in all, and below 0.009 where it is more.
LEAST_PULSE_GAIN_OF_ROW = 0.01
# In all, of a slot that undoes a dead time, which is what makes the speeds late by any other timing: the age of values
# is likelier than an effect. Measured: 4.7 to 50 of such speeds; none of 160 other logs but beside filters.
LEAST_UNDOING_GAIN = 3.0
# Of what a motor usually turns in a row: no slot is told that is less, unless whole ticks of a timer prove it.
# Measured: 0.03 to 0.5 of true ones, 0.002 and 0.004 of tachogenerators at 1 kHz, which had no noise then.
LEAST_SLOT = 0.01
LEAST_SPEEDS = 50
# Rows by which speeds over times between edges answer voltages that held until them, at most: a dead time is drawn by
# chance there, and one of nearly a row is none of voltages from the rows on. Measured: 0.63 of a motor with one; 0.7 to
# 0.9 where they hold from there.
SURELY_EARLY = 0.65
TOO_EARLY = Timing(1.0, -1.5, "")  # half a row more than any program makes speeds early


def find_timing(
    recordings: Sequence[Recording],
    estimate: Estimate,
    restrict: Callable[[Problem], Problem] | None = None,
    beside: Sequence[str] = (),
    filtered: bool = True,
    lagging: bool = False,
) -> Timing | None:
    """Find when the speeds of recordings were made, and how smoothed they are, as their motion shows.

    Of counts, which are of their rows' instants, whether voltages held until these. None if as assumed, or as was said.
    estimate: of the same motor, as the assumed timing gives it. restrict: to what a fit may see; all, without. beside:
    effects that are known to be in the motor; of what only makes it late, and of what repeats with its angle, the
    timing is found without. filtered: whether they may have passed a filter. lagging: whether, where none is found so,
    an inductance is believed that is beside.
    """
    if sum(len(recording) for recording in recordings) < LEAST_SPEEDS:
        return None
    found = _find_beside(Shaper(recordings, estimate, restrict, _list_shaping(beside)), filtered)
    if found is None and lagging and set(LAGGING).intersection(beside):
        found = _find_beside(Shaper(recordings, estimate, restrict, _list_shaping(beside, LAGGING)), filtered)
    return found


def find_voltages(
    recordings: Sequence[Recording],
    estimate: Estimate,
    restrict: Callable[[Problem], Problem] | None,
    beside: Sequence[str],
) -> Timing | None:
    """Find whether voltages of counted recordings held until their rows, beside effects that explain all of them.

    None where they hold from there on, as assumed, and where it was said or speeds are no counts. For the rest see
    `find_timing`.
    """
    shaper = Shaper(recordings, estimate, restrict, _list_shaping(beside))
    told = sum(map(len, recordings)) >= LEAST_SPEEDS and all(map(is_voltage_open, recordings))
    return UNTIL if told and held_until(shaper, complete=True) else None


def find_earlier_voltages(
    recordings: Sequence[Recording],
    estimate: Estimate,
    restrict: Callable[[Problem], Problem] | None,
    beside: Sequence[str],
    known: Timing | None,
) -> Timing | None:
    """Find whether voltages held until rows beside an inductance that nobody may have found, by effects that shape.

    None where nobody asked for it: they do so already, it was said, or speeds passed a filter or are of edges' times.
    For the rest see `find_timing`; known: what that gave.
    """
    timing = ASSUMED if known is None else known
    open_ = all(is_voltage_open(one) or (is_open(one) and one.info.voltage_assumed) for one in recordings)
    usual = timing.filter is None and timing.slot == 0.0 and not timing.is_early
    if not (open_ and usual) or sum(map(len, recordings)) < LEAST_SPEEDS:
        return None
    shaper = Shaper(recordings, estimate, restrict, _list_shaping(beside), timing.rows)
    found = find_held_behind_lag(shaper, timing)
    return None if found is None else replace(found, rows=timing.rows)


def _find_beside(shaper: Shaper, filtered: bool) -> Timing | None:
    """Find the timing of recordings by what shapes their motion; None if as assumed, or as was said."""
    recordings = shaper.recordings
    if all(map(is_voltage_open, recordings)):
        return _find_voltages(shaper)
    if any(recording.info.measurement is not Measurement.SPEED for recording in recordings):
        return None
    found = _find_as_stamped(shaper, filtered)
    if found is not None and found.slot == 0.0 and _are_open(recordings):
        rows = _find_row_times(shaper, found)
        again = _find_as_stamped(replace(shaper, rows=rows), filtered) if rows != AS_STAMPED else None
        found = found if again is None else replace(again, rows=rows)
    return None if found == ASSUMED else found


def _find_voltages(shaper: Shaper) -> Timing | None:
    """Find whether voltages held until their rows, of counts, and of speeds of said counts, maybe behind a filter."""
    speeds = all(recording.info.measurement is Measurement.SPEED for recording in shaper.recordings)
    found = find_filter(shaper, (ASSUMED, UNTIL)) if speeds else ASSUMED
    sharp = replace(shaper, recordings=replace(ASSUMED, filter=found.filter).set_on(shaper.recordings))
    if held_until(sharp):
        return replace(UNTIL, filter=found.filter)
    found = find_filter(shaper, (ASSUMED,)) if found.is_early else found
    return None if found == ASSUMED else found


def _list_shaping(effects: Sequence[str], late: Sequence[str] = ()) -> tuple[str, ...]:
    """List what shapes a motion, of some effects: neither makes it late, but for some, nor repeats with its angle."""
    return tuple(name for name in effects if (name in late or name not in LAGS) and not EFFECT_BY_NAME[name].periodic)


def _find_row_times(shaper: Shaper, timing: Timing) -> RowTimes:
    """Find the times of rows by which speeds are much likelier than by their stamps, as a timing has these.

    By what is assumed, too: behind late stamps there may be no filter, though one made up for them. Of as many speeds
    either way: those that are off the lattice of counts once they are divided are left out, and would count as likely.
    """
    stamped = Likelihood(shaper, timing)
    least = stamped.of(timing.filter) + _find_least_gain(stamped.count)
    likely = {
        rows: max(
            Likelihood(replace(shaper, rows=rows), one, stamped.count).of(one.filter) for one in {timing, ASSUMED}
        )
        for rows in list_row_times(max(shaper.recordings, key=len))
    }
    most = max(likely.values(), default=least)
    return next((rows for rows in likely if likely[rows] > max(least, most - AS_LIKELY)), AS_STAMPED)


def _find_as_stamped(shaper: Shaper, filtered: bool = True) -> Timing | None:
    """Find when speeds were made, and how smoothed they are, by the times of rows that fits have.

    None where the motion comes too early for any timing.
    """
    timing = _find_instants(shaper)
    slot = find_shown_slot(shaper.recordings) if _are_open(shaper.recordings) else 0.0
    if slot > 0.0:  # what values show is proof: where edges come as seldom as rows, a fit tells little
        return replace(_choose_instants(shaper, slot), slot=slot)
    if timing is None:
        return None
    usual = (ASSUMED, OTHERS[0]) if _are_open(shaper.recordings) else ()
    found = find_filter(shaper, (timing, *(one for one in usual if one != timing))) if filtered else timing
    if found.filter:
        return _find_periods_instead(shaper, found) or _find_again_behind(shaper, found)
    return _find_periods(shaper, found) or found


def _find_again_behind(shaper: Shaper, found: Timing) -> Timing:
    """Find behind a filter whether the motion comes early: smoothed speeds come late, and it shows in what was."""
    sharp = replace(ASSUMED, filter=found.filter).set_on(shaper.recordings)
    again = _find_instants(replace(shaper, recordings=sharp))
    return replace(again, filter=found.filter) if again in OTHERS[1:] else found


def _find_periods_instead(shaper: Shaper, found: Timing) -> Timing | None:
    """Find that what a filter seems to smooth are times between edges, if those are likelier; else None.

    A value that stays until the next edge is one that a filter's memory keeps, too. Both beside none of them.
    """
    likelihood = Likelihood(shaper, found)
    periods = _find_periods(shaper, replace(found, filter=None), likelihood.of(found.filter) - likelihood.of(None))
    return periods if periods is not None and periods.slot > 0.0 else None


def _find_periods(shaper: Shaper, other: Timing, least: float = -inf) -> Timing | None:
    """Find that speeds are a slot over the times between edges, likelier by this than by another timing; else None.

    Or that they are values of instants, of which a slot that passes often in a row is another word. Not of counts, nor
    of what is held for even frames; a converter's steps are no times.
    """
    sensors = [find_speed_sensor(recording) for recording in shaper.recordings]
    counted = any(sensor.step > 0.0 or sensor.frame > 0.0 for sensor in sensors)
    stepped = any(lies_on_steps(one.speed) for one in shaper.recordings) and not list_tick_slots(shaper.recordings)
    coarse = are_coarse(shaper.recordings) or any(map(is_converted, shaper.recordings))
    if counted or stepped or coarse or not _are_open(shaper.recordings):
        return None
    instants = (OTHERS[0], OTHERS[2]) if other.is_early and not _are_voltages_said(shaper) else (OTHERS[0],)
    found, timing = max(
        ((find_likeliest_slot(shaper, one, other), one) for one in instants), key=lambda one: one[0].gain
    )
    proved = bool(list_tick_slots(shaper.recordings))
    enough = LEAST_UNDOING_GAIN if found.undoes or proved else LEAST_GAIN
    if found.gain <= max(least, enough, 0.0 if proved else LEAST_PULSE_GAIN_OF_ROW * found.rows):
        return None
    if not proved:
        if found.slot < LEAST_SLOT * measure_usual_travel(shaper.recordings):  # it ends at the row's own instant
            return timing if _is_likelier_by_all(shaper, timing, other) else None
        if measure_gain_over_lag(shaper, replace(timing, slot=found.slot), other) <= 0.0:
            return None
    return replace(_choose_instants(shaper, found.slot), slot=found.slot)


def _is_likelier_by_all(shaper: Shaper, instants: Timing, other: Timing) -> bool:
    """Decide whether values of instants are likelier than another timing by all rows, not by those that move alone.

    Measured: of counts likelier by 48 of 1,404 rows that moved, and less likely by 84 of all 2,000, of a motor that
    coasts where nobody drives it.
    """
    one, before = (shaper.fit(timing).residuals for timing in (instants, other))
    return _is_likelier_at_all(one, before)


def _choose_instants(shaper: Shaper, slot: float) -> Timing:
    """Choose whether voltages hold from rows on or held until them, of speeds over the times of a slot [rad].

    Until them only where the motion comes too early otherwise, and by more than such times are sure of.
    """
    if _are_voltages_said(shaper):
        return OTHERS[0]
    later, early = (shaper.fit(replace(timing, slot=slot)) for timing in (OTHERS[0], OTHERS[2]))
    row = min(recording.info.sample_period for recording in shaper.recordings)
    too_early = later.delay <= LEAST_DELAY * row and early.delay < SURELY_EARLY * row
    likelier = too_early and measure_gain_of_speeds(later, early) > _find_least_gain(len(early.residuals))
    return OTHERS[2] if likelier else OTHERS[0]


def _find_instants(shaper: Shaper) -> Timing | None:
    """Find when speeds were made of which nobody said it; what is assumed where the motion does not say otherwise.

    Of a converter's steps that is an instant: half a row is a dead time to a motor that answers within some rows.
    None where the motion comes too early for any timing: nothing can be learned of it.
    """
    if not _are_open(shaper.recordings):
        return ASSUMED
    row = min(recording.info.sample_period for recording in shaper.recordings)
    least = LEAST_DELAY * row
    assumed = shaper.fit(ASSUMED)
    best, fitted = ASSUMED, assumed
    counted = all(find_speed_sensor(recording).step > 0.0 for recording in shaper.recordings)
    converted = all(map(is_converted, shaper.recordings))
    early = assumed.delay <= least and not _are_voltages_said(shaper)
    others = [(timing, shaper.fit(timing)) for timing in (OTHERS if early else OTHERS[:1])]
    if early and others[-1][1].delay <= least and shaper.fit(TOO_EARLY).delay <= least:
        return None  # earlier than any row says: not for its timing
    if converted and measure_gain(fitted.residuals, others[0][1].residuals) > -AS_LIKELY:
        best, fitted = others[0]
    for timing, other in others:  # each makes the speeds younger than the one before, which is taken if as likely
        is_instant = timing is OTHERS[0]
        gain_of_row = LEAST_GAIN_OF_INSTANT if is_instant else LEAST_GAIN_OF_ROW
        if (fitted.delay <= least or is_instant) and _beats(other.residuals, (best, fitted), counted, gain_of_row):
            best, fitted = next(one for one in others if not _beats(other.residuals, one, counted))
    # With a dead time that brings it back to the row's own instant, none is early: it is another mean than a row's.
    back = best.is_early and best.lag * row + fitted.delay > -least
    return OTHERS[0] if back and measure_gain(assumed.residuals, others[0][1].residuals) > 0.0 else best


def _are_voltages_said(shaper: Shaper) -> bool:
    """Decide whether somebody said of all recordings from when on the voltages of their rows hold."""
    return all(one.info.source == "import" and not one.info.voltage_assumed for one in shaper.recordings)


def _beats(
    residuals: Floats,
    other: tuple[Timing, ShapedFit],
    counted: bool,
    gain_of_row: float = LEAST_GAIN_OF_ROW,
) -> bool:
    """Decide whether one timing's residuals (I,) rule another one out: a count of a row's is no value of an instant.

    Measured: by counts of rows, and voltages that held until them, likelier by 176 than as assumed, by instants by 110,
    and a dead zone came out 3 of its errors small beside a random torque that there was not.
    """
    timing, fitted = other
    if counted and timing is OTHERS[0]:
        return _is_likelier_at_all(residuals, fitted.residuals)
    return _is_likelier(residuals, fitted.residuals, gain_of_row)


def _are_open(recordings: Sequence[Recording]) -> bool:
    return all(is_open(recording) for recording in recordings)


def _is_likelier(one: Floats, other: Floats, gain_of_row: float = LEAST_GAIN_OF_ROW) -> bool:
    """Decide whether one timing's residuals (I,) are much likelier than another's, and not by a few rows alone."""
    return measure_gain(other, one) > _find_least_gain(len(one), gain_of_row) and _is_steady(one, other)


def _is_likelier_at_all(one: Floats, other: Floats) -> bool:
    """Decide whether one timing's residuals (I,) are likelier than another's, by however little, not by a few rows."""
    return measure_gain(other, one) > 0.0 and _is_steady(one, other)


def _is_steady(one: Floats, other: Floats) -> bool:
    """Decide whether one timing's residuals (I,) are likelier than another's where some rows may be off by far, too.

    Measured: the sizes of means of rows in which a motor turned over, five of 2,000, made instants likelier by 152, and
    without them less likely by 47; of true instants 8 to 80 was left of 6 to 500.
    """
    count = min(len(one), len(other))
    alike: Floats = np.ones(count)
    return measure_log_likelihood(one[-count:], alike) > measure_log_likelihood(other[-count:], alike)


def _find_least_gain(count: int, gain_of_row: float = LEAST_GAIN_OF_ROW) -> float:
    """Find how much likelier, of log likelihood, another timing of so many rows has to be."""
    return max(LEAST_GAIN, gain_of_row * count)
