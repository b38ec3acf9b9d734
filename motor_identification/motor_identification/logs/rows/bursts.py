"""Give rows that a link stored and handed on in bursts the even times at which their board made them.

A program that draws between two reads of its serial port stamps rows when it takes them: many at once, then none. Its
last row of a burst came at once, so that those lie on the board's clock, and the time from one to the next goes with
the number of rows between them. A board that really pauses takes as long for each pause, however many rows came before.

Where a log has rows of its own instead, those repeat the latest value until the link goes on: a position stands still,
and then goes all the way at once.
"""

from dataclasses import replace

import numpy as np

from motor_identification.logs.signals import Bools, Floats, Integers, Signals

FEWEST = 10  # bursts that tell
QUICK = 0.8  # of the even distance: rows within a burst are closer
SAME = 0.2  # relative: how far the time that one more row takes may be from the even distance
SURE = 4.0  # standard errors of that time, by which it is more than within a burst
BESIDE, MOSTLY = 1.5, 0.9  # even distances beside the board's clock that a last row may be, and the share that is

# A value that stays for so many times the usual, while the motor goes on, was not handed on:
STALL = 5.0
AROUND = 4  # changes before it, none of them late, that tell how fast the motor was
LATE = 2.0  # times the usual, beyond which a change is late
CAUGHT_UP = 0.7, 1.4  # of the way that it would have gone meanwhile
AT_ONCE, MOST = 0.25, 12  # of the stall's time, and changes, within which it is caught up
FEW = 0.05  # of the changes: a motor that sticks and slips does so again and again
# Times the speed that the motor has in a twentieth of the time: slower, it stopped and started by itself.
FASTER, USUAL = 1.5, 0.95
MISSING = 0.5  # of a stall without a row: rows that repeat a value come all through it


def cut_stalls(signals: Signals, name: str) -> tuple[Signals, list[str]]:
    """Leave out rows whose position a link did not hand on, until it made up for it at once: a run begins there."""
    keep, begins, lines = np.ones(len(signals), np.bool_), np.zeros(len(signals), np.bool_), []
    for run in signals.runs.values():
        for first, last in _find_stalls((signals.time[run] - signals.time[run.start]) * 1e-9, signals.motion[run]):
            keep[run.start + first : run.start + last] = False
            begins[run.start + last] = True
            lines.append(int(signals.lines[run.start + first]))
    if not lines:
        return signals, []
    lost = int(np.count_nonzero(~keep))
    split = signals.split(begins)
    rows = np.isin(split.lines, signals.lines[keep])
    cut = split.only(rows)
    rows_lost = "1 row" if lost == 1 else f"{lost} rows"
    said = (
        f"Left out: {rows_lost} from line {', '.join(map(str, lines))} on, in which {name} stays while the motor goes "
        f"on and then makes up for it at once, as a link hands on what it held back: {len(cut.runs)} runs, a bag each."
    )
    return cut, [said]


def _find_stalls(time: Floats, position: Floats) -> list[tuple[int, int]]:
    """The first row of each stall of positions (K,) at times (K,) [s], and the one at which it is made up for."""
    changed = np.flatnonzero(np.diff(position)) + 1
    gaps = np.diff(time[changed])
    if len(gaps) < 4 * AROUND:
        return []
    usual, found = float(np.median(gaps)), []
    fastest = _find_fastest(np.abs(np.diff(position[changed])) / gaps, gaps)
    for k in np.flatnonzero(gaps > STALL * usual):
        before, seen = changed[max(k - AROUND, 0) : k + 1], time[changed]
        if len(before) <= AROUND or np.any(gaps[k - AROUND : k] > LATE * usual):
            continue
        rate = (position[before[-1]] - position[before[0]]) / (time[before[-1]] - time[before[0]])
        if rate == 0.0:  # it went forth and back
            continue
        stays = time[changed[k] : changed[k + 1] + 1]
        if np.max(np.diff(stays)) > MISSING * gaps[k]:  # rows are missing there, in which nothing was repeated
            continue
        for end in range(k + 2, min(k + 2 + MOST, len(changed))):
            way = position[changed[end]] - position[before[-1]]
            share = way / (rate * (seen[end] - seen[k]))
            if seen[end] - seen[k + 1] > AT_ONCE * gaps[k]:
                break
            speed = abs(way) / (seen[end] - seen[k + 1] + usual)
            if CAUGHT_UP[0] <= share <= CAUGHT_UP[1] and speed > FASTER * fastest:
                end += int(
                    np.argmax(np.append(gaps[end:], np.inf) > QUICK * usual)
                )  # behind the last that came so soon
                held = int(np.searchsorted(time, seen[k] + usual))
                found.append((held, int(changed[end])))
                break
    return found if len(found) <= FEW * len(changed) else []


def _find_fastest(speed: Floats, duration: Floats) -> float:
    """Find the speed of changes (C,) that the motor does not exceed for most of the time."""
    order = np.argsort(speed)
    passed = np.cumsum(duration[order])
    return float(speed[order][np.searchsorted(passed, USUAL * passed[-1])])


def spread_bursts(signals: Signals, gap: Bools) -> tuple[Signals, list[str]]:
    """Spread rows of bursts evenly, in every run whose rows after a gap are marked, shape (K,), if all of them tell."""
    time, period, rows = signals.time.copy(), 0.0, 0.0
    if not gap.any():
        return signals, []
    for run in signals.runs.values():
        last = np.flatnonzero(gap[run]) - 1
        period = _board_period((signals.time[run] - signals.time[run.start]) * 1e-9, last)
        if period == 0.0:
            return signals, []
        rows = float(np.median(np.diff(last)))
        time[run] = time[run.start] + np.rint(period * 1e9 * np.arange(run.stop - run.start)).astype(np.int64)
    said = (
        f"Rows come in bursts, about {rows:.0f} at a time, as a link hands them on that stores them: they are taken to "
        f"be {period * 1e3:.4g} ms apart (assumed; otherwise: --sample-period)."
    )
    return replace(signals, time=time), [said]


def _board_period(time: Floats, last: Integers) -> float:
    """[s] how far rows at times (K,) [s] are apart on the board; 0 where that is not sure.

    last: the last row of each burst.
    """
    if len(last) < FEWEST:
        return 0.0
    took, rows = np.diff(time[last]), np.diff(last).astype(np.float64)
    spread = rows - rows.mean()
    if not np.any(spread):
        return 0.0
    each = float(spread @ took) / float(spread @ spread)  # what one more row takes
    left = took - took.mean() - each * spread
    error = float(np.sqrt(left @ left / max(len(rows) - 2, 1) / (spread @ spread)))
    period, begin = _robust_line(last, time[last])
    quick = float(np.median(np.diff(time)))
    beside = np.abs(time[last] - begin - period * last)
    even = abs(each - period) < SAME * period and each - SURE * error > quick and quick < QUICK * period
    return period if even and np.mean(beside < BESIDE * period) >= MOSTLY else 0.0


def _robust_line(x: Integers, y: Floats) -> tuple[float, float]:
    """Slope and begin of a line through most points: by least squares, twice without those far beside."""
    good = np.ones(len(x), np.bool_)
    slope, begin = np.polyfit(x, y, 1)
    for _ in range(2):
        beside = np.abs(y - begin - slope * x)
        good = beside <= 3.0 * np.median(beside) + 1e-12
        slope, begin = np.polyfit(x[good], y[good], 1)
    return float(slope), float(begin)
