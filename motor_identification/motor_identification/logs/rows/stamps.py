"""Stamps that are coarse, doubled or shared: rows get times that differ, and regular rows regular ones."""

from dataclasses import replace

import numpy as np

from motor_identification.logs.signals import Floats, Integers, Signals

COARSE = 0.02  # of a sample period: a finer resolution of the stamps is no matter
REGULAR = 1.0  # resolutions by which stamps may lie beside regular rows: rounding and truncation are within
SELDOM = 0.01  # of the rows: so few may lie twice as far, within half a row: a board's or a link's late moments
LACKING = 0.05  # of the rows: more gaps of a regular log than this are its rhythm
CONTINUES = 3.0  # usual steps, within which a clock that was full goes on
_REGISTERS = (2**32 * 10**3, 2**32 * 10**6, 24 * 3600 * 10**9)  # [ns] 32 bits of µs and of ms; the time of day
_RESOLUTIONS = [10**power for power in range(9, 2, -1)]  # [ns] 1 s to 1 µs


def unwrap_clock(signals: Signals, unit: int) -> tuple[Signals, list[str]]:
    """Take back what a clock lost where its register was full: 32 bits of µs or ms, 16 bits, or midnight.

    Args:
        signals: rows in the order of their lines.
        unit: [ns] of the column of times.
    """
    time = signals.time.copy()
    found: list[int] = []
    for run in signals.runs.values():
        steps = np.diff(time[run])
        forward = steps[steps > 0]
        usual = CONTINUES * float(np.median(forward)) if len(forward) else 0.0
        for place in np.flatnonzero(steps < 0):
            full = next((size for size in (*_REGISTERS, 2**16 * unit) if 0 < steps[place] + size <= usual), 0)
            time[run.start + place + 1 : run.stop] += full
            found += [full] if full else []
    if not found:
        return signals, []
    times = "once" if len(found) == 1 else f"{len(found)} times"
    said = f"The clock begins again after {found[0] * 1e-9:.6g} s, where its register is full ({times}): it goes on."
    return replace(signals, time=time), [said]


def drop_stray_stamps(signals: Signals) -> tuple[Signals, list[str]]:
    """Leave out single rows whose stamp lies beyond that of a neighbour, where the neighbours are in order."""
    stray = np.zeros(len(signals), np.bool_)
    for run in signals.runs.values():
        time = signals.time[run]
        if len(time) < 4:
            continue
        before, here, after = time[:-2], time[1:-1], time[2:]
        stray[run.start + 1 : run.stop - 1] = (before < after) & ((here > after) | (here < before))
    count = int(np.count_nonzero(stray))
    if not 0 < count <= SELDOM * len(signals):
        return signals, []
    which = "1 row whose stamp lies" if count == 1 else f"{count} rows whose stamps lie"
    return signals.only(~stray), [f"Left out: {which} beyond the next row's or before the last one's."]


def stamp_resolution(time: Integers) -> int:
    """[ns] the largest power of ten that all stamps, shape (K,), are multiples of; 0 where that is below 1 µs."""
    return next((size for size in _RESOLUTIONS if not np.any(time % size)), 0)


def separate_stamps(signals: Signals) -> tuple[Signals, list[str]]:
    """Give rows of coarse stamps the times of regular rows where that fits, and rows that share a stamp a time each."""
    signals, said = _drop_repeats(signals)
    steps = signals.steps()
    period = float(np.mean(steps)) if len(steps) else 0.0
    coarse = stamp_resolution(signals.time)
    shared = bool(np.any(steps == 0))
    if not shared and (coarse <= COARSE * period or _lacks_rows(steps)):
        return signals, said
    time = signals.time.copy()
    regular = 0
    for run in signals.runs.values():
        even = _even_times(time[run])
        if even is not None and _are_regular(even, time[run], coarse):
            time[run] = np.rint(even).astype(np.int64)
            regular += 1
        elif np.any(np.diff(time[run]) == 0):
            time[run] = _spread(time[run])
    whole = f"Stamps are whole multiples of {_span(coarse)}" if coarse else "Some rows share a stamp"
    if regular == len(signals.runs):
        if np.array_equal(time, signals.time):
            return signals, said
        even_period = float(np.median(np.diff(time)))
        said.append(
            f"{whole}; the rows are regular, {even_period * 1e-6:.4g} ms apart (assumed), and take those times."
        )
    elif shared:
        said.append(f"{whole}; rows that share one are spread evenly until the next (assumed).")
    else:
        said.append(f"{whole}, and the rows are not regular: times are that uncertain.")
    return _still_forward(replace(signals, time=time)), said


def _drop_repeats(signals: Signals) -> tuple[Signals, list[str]]:
    """Leave out rows that repeat the one before, stamp and all."""
    alike = np.zeros(len(signals), np.bool_)
    same = [np.diff(column) == 0 for column in (signals.time, signals.voltage, signals.motion)]
    alike[1:] = np.logical_and.reduce(same)
    alike[[run.start for run in signals.runs.values()]] = False
    steps = signals.steps()
    # Where most stamps are shared, a standing motor's rows look like repeats, and are none.
    if not alike.any() or np.mean(steps == 0) > 0.25:
        return signals, []
    lost = int(alike.sum())
    rows = "1 row that repeats" if lost == 1 else f"{lost} rows that repeat"
    return signals.only(~alike), [f"Left out: {rows} the one before."]


def _lacks_rows(steps: Integers) -> bool:
    """Whether longer steps are rows that are missing: the stamps of rows that are there are then right.

    Where regular rows were rounded to the next stamp, the longer steps come at even distances.
    """
    usual = np.median(steps)
    longer = np.flatnonzero(steps != usual)
    if len(longer) > LACKING * len(steps) or np.any(steps % usual) or np.any(steps < usual):
        return False
    between = np.diff(longer)
    return len(between) < 2 or bool(np.ptp(between) > max(2.0, 0.1 * float(np.median(between))))


def _are_regular(even: Floats, time: Integers, coarse: int) -> bool:
    """Whether stamps [ns], shape (K,), lie as near to even times as those of regular rows do, save a few."""
    far = np.abs(even - time)
    half_row = 0.5 * (even[-1] - even[0]) / (len(even) - 1)
    farthest = max(REGULAR * coarse, min(2.0 * REGULAR * coarse, half_row))
    return bool(np.max(far) <= farthest and np.mean(far > REGULAR * coarse) <= SELDOM)


def _even_times(time: Integers) -> Floats | None:
    """[ns] of regular rows through these stamps, shape (K,)."""
    if len(time) < 5:
        return None
    rows = np.arange(len(time), dtype=np.float64)
    origin = int(time[0])
    slope, offset = np.polyfit(rows, (time - origin).astype(np.float64), 1)
    even = origin + offset + slope * rows
    return np.asarray(even, dtype=np.float64) if slope > 0.0 else None


def _spread(time: Integers) -> Integers:
    """Rows of one stamp, evenly until the next stamp."""
    fresh = np.flatnonzero(np.diff(time, prepend=time[:1] - 1))
    if len(fresh) < 2:
        return time
    step = (time[fresh[-1]] - time[fresh[-2]]) / (fresh[-1] - fresh[-2])
    known = np.append(time[fresh], time[fresh[-1]] + step * (len(time) - fresh[-1]))
    rows = np.append(fresh, len(time))
    origin = int(time[0])
    spread = np.rint(np.interp(np.arange(len(time)), rows, (known - origin).astype(np.float64)))
    return np.asarray(origin + spread.astype(np.int64), dtype=np.int64)


def _still_forward(signals: Signals) -> Signals:
    """Leave out rows whose time does not go on."""
    keep = np.ones(len(signals), np.bool_)
    keep[1:] = np.diff(signals.time) > 0
    keep[[run.start for run in signals.runs.values()]] = True
    return signals if keep.all() else signals.only(keep)


def _span(time: int) -> str:
    for unit, size in (("s", 10**9), ("ms", 10**6), ("µs", 10**3)):
        if time >= size:
            return f"{time // size} {unit}"
    return f"{time} ns"
