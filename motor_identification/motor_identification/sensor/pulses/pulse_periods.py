"""Recognise speeds that were computed as one slot over the time between the latest two edges: the period method.

Such a value stays until the next edge, which comes a slot over its own value after the one before: the slower the
motor, the longer. No window of counts and no even frame does so. Between edges some programs let the value fall as a
slot over the time since the latest one: that tells when it came, and of no new one.
"""

from dataclasses import dataclass
from math import log, tau

import numpy as np

from motor_identification.recording import Bools, Floats, Integers
from motor_identification.sensor.value_lattice import find_lattice
from motor_model.compiled import compiled

# Values that stayed for two rows or more, as long as the next one says. Measured: of 670 logs of other sensors four had
# 8 of them, one had 20.
FEWEST = 20
AGAINST = 9.0  # of them that one value which does not come as its slot says weighs as much as: nine in ten fit
# Of the squares by which the stays differ, what a slot leaves at most: stays of even frames differ by chance, if at
# all, which leaves 1 or more. Measured: 0.1 to 0.6 of speeds by periods.
LEFT = 0.85
# Of those values, that stayed for another number of rows than most: a single count in a mean of two rows stays for two,
# and is the larger the shorter they are. Measured: one of such means, 16 and more of speeds by periods.
OTHERS = 4
OFF, OFF_SLOT = 0.05, 0.03  # of a row and of a slot's time, for stamps and slots that are a little off
SLOW = 1.05  # rows that a slot takes at what is slow
STAYED = 1.5  # rows that a value was there for more than one of them
STEPS = 10.0  # of what values are rounded to, at least: of fewer nobody knows how much time a slot took
EVEN = 0.02  # of a value: how much neighbours differ by at an even speed
EXACT = 0.05  # rows by which the time since the latest edge may grow otherwise than the rows' own
# Relative: slots that pairs of falling values tell are one within this; beside those within a wider range, of which so
# many times as many as chance would put there are that one, and at least a share of all that fall; or as many as chance
# would not put there in a long log either, whose motor is seldom slow.
SAME_DECAY, AROUND, BEYOND_CHANCE, OF_ALL_FALLS, MANY_DECAYS = 0.002, 0.1, 5.0, 0.05, 20
# Such pairs, at least. Measured: of 30 logs that fall 13 have them, all with the true slot to 1e-4; none of 400 logs of
# other sensors, nor of 226 of real motors.
FEWEST_DECAYS = 6
CANDIDATES = 3  # such slots that are looked at: of counts in rows of uneven lengths there are dozens, and none is one
GRID = 1.02  # from one slot that is tried to the next
ALIKE = 0.98  # of the best score: slots that explain the values as well
LONGEST = 200.0  # rows that a slot takes at nearly the fastest speed, at most
SAID_SLOT = 0.25  # of a slot that was said, that one which values show may be off
LONGEST_SLOT = 1.1 * tau  # [rad]: a disc has one edge a turn at least; slots are known to some per cent
ENDS = (0.02, 0.98)  # quantiles of the speeds, between which slots are tried


def are_times_of_slot(slot: float, time: Floats, speed: Floats) -> bool:
    """Decide whether speeds (K,) [rad/s] that are no counts, at times (K,) [s], were computed over a slot [rad].

    They stay until the next edge, as long as the slot takes at them, or fall from there; no counts within a row do, nor
    what is smoothed of them. Measured: 1.05 and 0.99 of the slot in two simulated logs; none shows in 38 of counts.
    """
    found = find_slot_by_decays(time, speed) or find_slot_by_stays(time, speed)
    return abs(found - slot) < SAID_SLOT * slot


def find_slot_by_stays(time: Floats, speed: Floats) -> float:
    """Find the slot [rad] over whose times speeds (K,) [rad/s] at times (K,) [s] were computed; 0 where none shows."""
    changed = _list_changed(speed)
    if len(changed) < FEWEST:
        return 0.0
    low, high = np.quantile(np.abs(speed[changed]), ENDS) * float(np.median(np.diff(time)))
    slots = low * GRID ** np.arange(log(LONGEST * high / low) / log(GRID))
    slots = slots[_may_tell(time, speed, slots)]
    stays = _measure_stays(time, speed, slots)
    most = max((stay.score for stay in stays if stay.tells), default=0.0)
    alike = [stay.tells and stay.score >= ALIKE * most for stay in stays]
    slot = float(np.exp(np.mean(np.log(slots[alike])))) if any(alike) else 0.0
    return slot if slot <= LONGEST_SLOT else 0.0


def find_slot_by_decays(time: Floats, speed: Floats) -> float:
    """Find the slot [rad] over the time since whose edge speeds (K,) [rad/s] at times (K,) [s] fall; 0 where none do.

    From row to row the inverse of such a value grows by the row's time over the slot, whatever the value: each pair of
    rows tells the slot, and all the same one. Not where values lie on a lattice, of which few differences are made; a
    timer's ticks make another one, by which edges would come more seldom than values.
    """
    size, rows = np.abs(speed), np.diff(time)
    falls = np.flatnonzero((speed[1:] * speed[:-1] > 0.0) & (size[1:] < size[:-1]))
    if len(falls) < FEWEST_DECAYS or find_lattice(speed) > 0.0:
        return 0.0
    grown = 1.0 / size[1:][falls] - 1.0 / size[:-1][falls]
    slots = np.sort(np.log(rows[falls][grown > 0.0] / grown[grown > 0.0]))
    alike, around = (_count_within(slots, width) for width in (SAME_DECAY, AROUND))
    likely = alike >= np.maximum(
        max(FEWEST_DECAYS, min(OF_ALL_FALLS * len(slots), MANY_DECAYS)), BEYOND_CHANCE * SAME_DECAY / AROUND * around
    )
    likely &= slots <= np.log(LONGEST_SLOT)
    for _ in range(CANDIDATES):
        if not likely.any():
            break
        most = np.argmax(np.where(likely, alike, 0))
        near = np.abs(slots - slots[most]) < SAME_DECAY
        slot = float(np.exp(np.median(slots[near])))
        if not contradicts(score_stays(time, speed, slot)):
            return slot
        likely &= ~near
    return 0.0


def _count_within(values: Floats, width: float) -> Integers:
    """Count the sorted values (N,) that are no farther from each than a width."""
    return np.asarray(np.searchsorted(values, values + width) - np.searchsorted(values, values - width))


def score_stays(time: Floats, speed: Floats, slot: float) -> float:
    """Score how speeds (K,) [rad/s] at times (K,) [s] stay: those as long as a slot [rad] says, less what do not."""
    return _measure_stays(time, speed, np.array([slot]))[0].score


def contradicts(score: float) -> bool:
    """Decide whether a score of stays says that speeds come more often than a slot passes, or never so."""
    return score < -FEWEST


def divide_slot(slot: float, speed: Floats) -> Floats:
    """Divide a slot [rad] by speeds (K,) [rad/s]: the time [s] that it takes; 0 where they are 0."""
    return np.asarray(np.divide(slot, np.abs(speed), out=np.zeros(len(speed)), where=speed != 0.0))


def mark_decays(time: Floats, period: Floats, row: float) -> Bools:
    """Mark rows (K,) that show the time since the latest edge: from one to the next it grows as much as the rows' own.

    period: [s] that a slot takes at each row's speed; 0 where that is 0. row: [s] from one to the next.
    """
    grows = np.abs(np.diff(period) - np.diff(time)) < EXACT * row
    pair = grows & (period[:-1] > 0.0) & (period[1:] > row)
    return np.asarray(np.append(pair, False) | np.append(False, pair))


@dataclass(frozen=True)
class _Stays:
    """How well a slot says when values come."""

    held: int  # values that it explains and that came two rows or more after the one before
    against: int  # slow values that it does not explain
    open: int  # fast values that stayed for longer than it says: by chance, or by another slot
    apart: Floats  # [s] from the one before to each slow value that it explains, shape (S,)
    period: Floats  # [s] the slot's time at those
    alike: int  # of those that it explains, the values that stayed for the commonest number of rows

    @property
    def score(self) -> float:
        return self.held - AGAINST * self.against - self.open

    @property
    def tells(self) -> bool:
        """Whether enough values stay as long as the slot says, and their stays differ as it says."""
        if self.held < FEWEST or self.score < 0.0 or self.held - self.alike < OTHERS:
            return False
        varied = float(np.sum((self.apart - np.mean(self.apart)) ** 2))
        return float(np.sum((self.apart - self.period) ** 2)) < LEFT * varied


def _list_changed(speed: Floats) -> Integers:
    """List the rows with another value than the one before, of a motor that turns."""
    return np.flatnonzero((np.diff(speed) != 0.0) & (speed[1:] != 0.0)) + 1


def _may_tell(time: Floats, speed: Floats, slots: Floats) -> Bools:
    """Mark the slots [rad] (S,) that may tell: of hundreds nearly all are refuted by how many values they explain."""
    row, fine = float(np.median(np.diff(time))), np.abs(speed) >= STEPS * find_lattice(speed)
    known = time, speed, _list_changed(speed), fine, np.cumsum(speed == 0.0), row
    counts = np.array([_count_stays(*known, divide_slot(slot, speed)) for slot in slots]).reshape(-1, 3)
    return np.asarray((counts[:, 0] >= FEWEST) & (counts @ np.array([1.0, -AGAINST, -1.0]) >= 0.0))


@compiled
def _count_stays(  # noqa: C901
    time: Floats, speed: Floats, changed: Integers, fine: Bools, zeros: Integers, row: float, period: Floats
) -> tuple[int, int, int]:
    """Count what a slot explains, does not, and leaves open, as `_measure_stays_of` does, without its arrays.

    fine: see there. zeros: rows up to each that stand. period: [s] that the slot takes at each row's speed.
    """
    held = against = left = 0
    before, last, at, checked, fell = -1, -1, 0.0, -2, False
    for k in changed:
        earlier = fell if checked == k - 1 else _falls(time, period, k - 1, row)
        checked, fell = k, _falls(time, period, k, row)
        if earlier or fell:
            continue
        takes, now = period[k], time[k]
        room = now - time[k - 1] + OFF * row + OFF_SLOT * takes
        apart, as_said, fits, even = 0.0, False, False, False
        stay = 0.0
        if before >= 0 and zeros[before] == zeros[k] and speed[before] * speed[k] > 0.0:
            stay = now - time[before]
            late = stay - takes
            fits = late < room and -late < time[before] - time[before - 1] + OFF * row + OFF_SLOT * takes
        if last >= 0 and zeros[last] == zeros[k] and speed[last] * speed[k] > 0.0:
            apart = now - at
            late = apart - takes
            as_said = late < room and -late < at - time[last - 1] + OFF * row + OFF_SLOT * takes
        if as_said:
            stay = apart
        elif fits:
            fits = apart < STAYED * row and abs(speed[last]) < abs(speed[before])
        if last >= 0:
            even = apart > takes and abs(takes - period[last]) < EVEN * takes
        if fine[k]:
            if takes > SLOW * row and apart > 0.0:
                if as_said or fits:
                    held += 1 if stay > STAYED * row else 0
                elif not even:
                    against += 1
            elif apart > STAYED * row and not as_said and not even:
                left += 1
        before, last, at = last, k, now
    return held, against, left


@compiled
def _falls(time: Floats, period: Floats, k: int, row: float) -> bool:
    """Whether a row and the next show the time since the latest edge: see `mark_decays`."""
    if k < 0 or k + 1 >= len(time) or period[k] <= 0.0 or period[k + 1] <= row:
        return False
    return bool(abs(period[k + 1] - period[k] - (time[k + 1] - time[k])) < EXACT * row)


def _measure_stays(time: Floats, speed: Floats, slots: Floats) -> list[_Stays]:
    """Compare when values come with when they should by each of some slots [rad] (S,)."""
    row, fine = float(np.median(np.diff(time))), np.abs(speed) >= STEPS * find_lattice(speed)
    changed = _list_changed(speed)
    return [_measure_stays_of(time, speed, changed, fine, slot, row) for slot in slots]


def _measure_stays_of(time: Floats, speed: Floats, changed: Integers, fine: Bools, slot: float, row: float) -> _Stays:
    """Compare when values come with when they should: from the last edge to this one a slot's time has passed.

    fine: rows (K,) whose values are many of the steps that they are rounded to.
    """
    period = divide_slot(slot, speed)
    new = changed[~mark_decays(time, period, row)[changed]]
    takes = period[new]
    apart, fits = _compare(time, speed, new, takes, row)
    slow, fitting = (takes > SLOW * row) & (apart[0] > 0.0), fits.any(axis=0)
    stay = np.where(fits[0], apart[0], apart[1])
    # Edges are hidden where one value follows an equal one: at an even speed, of which timers tell no more.
    even = np.append(False, np.abs(np.diff(takes)) < EVEN * takes[1:]) & (apart[0] > takes)
    too_long = ~slow & (apart[0] > STAYED * row) & ~fits[0] & ~even
    told = slow & fitting & fine[new]
    marks = (told & (stay > STAYED * row), slow & ~fitting & ~even & fine[new], too_long & fine[new])
    held, against, left = (int(np.count_nonzero(some)) for some in marks)
    alike = np.max(np.bincount(np.rint(stay[marks[0]] / row).astype(np.int64)), initial=0)
    return _Stays(held, against, left, stay[told], takes[told], int(alike))


def _compare(time: Floats, speed: Floats, new: Integers, takes: Floats, row: float) -> tuple[Floats, Bools]:
    """How long [s] new values came after the one before and the one before that, and whether the slot says so; (2, N).

    Both edges came somewhere within the rows that show them first. 0 where the motor turned or stood in between.
    takes: [s] a slot's time at each, shape (N,).
    """
    rows, zeros = np.diff(time, prepend=time[0] - row)[new], np.cumsum(speed == 0.0)
    room = OFF * row + OFF_SLOT * takes
    apart, fits = np.zeros((2, len(new))), np.zeros((2, len(new)), np.bool_)
    for back in (1, 2):
        first, second = new[:-back], new[back:]
        along = (zeros[first] == zeros[second]) & (speed[first] * speed[second] > 0.0)
        late = time[second] - time[first] - takes[back:]
        apart[back - 1, back:] = np.where(along, time[second] - time[first], 0.0)
        fits[back - 1, back:] = along & (late < (rows + room)[back:]) & (late > -rows[:-back] - room[back:])
    # A value of the row before that is smaller than the one before may only have said how long ago the edge was.
    falls = np.append([False, False], np.abs(speed[new[1:-1]]) < np.abs(speed[new[:-2]]))[: len(new)]
    fits[1] &= falls & (apart[0] < STAYED * row)
    return apart, fits
