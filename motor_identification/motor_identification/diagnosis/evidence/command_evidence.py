"""Evidence that a motion goes by its command: a model of the command alone explains some of its variation.

A random torque is learned from what a model leaves, however much that is. Where the columns of voltage and motion do
not belong together, or rows were lost, all of the motion is such a torque, and its gap at the floor.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from motor_identification.diagnosis.candidate_model import find_lasting_interval
from motor_identification.discrepancy.free_curves import BY_TIME
from motor_identification.discrepancy.structure import Structure
from motor_identification.measurement.command_swing import is_sweep
from motor_identification.recording import Floats, Recording
from motor_identification.validation.held_out import HeldOut

# Of the variance of what lasts in the speed that a model has to explain, if the command varies by as much of its
# largest value (RMS) and what is left is as much of the speed (RMS). Measured: 0.5 and more where a torque of 0.3 V
# shook a motor of 12 V; below 0 of a program that logged another signal as its command.
LEAST_EXPLAINED, VARIES, MATTERS = 0.25, 0.1, 0.1
# Levels of the largest voltage, and visits of each, by which a speed falls, and of its most by how much, where a model
# falls by less than that share of it. Measured: by 0.25 from half of the duty on, up and down three times, of an
# encoder whose counts a program missed.
LEVELS, FEWEST_VISITS, LEAST_FALL, SHARED = 8, 3, 0.1, 0.5
# A motor that was switched off: of the largest voltage, what drives it; of its speed, what moves; of the time under
# such voltages, in which it moved before; and times as long as it rested there, and rows, for which it stands to the
# end, but not so many times as it moved. Measured: 6 s at 0.6 of the supply, at which a robot's wheel had run seven
# times for 3 s, 0.1 s after each step; a position loop held 1.7 s at half of it, and had passed that within 0.1 s.
DRIVING, MOVING, MOVED, RESTS, FEWEST_ROWS = 0.5, 0.05, 0.5, 3.0, 50.0


@dataclass(frozen=True)
class Stopped:
    """A motor that stands to the end of a recording under voltages that moved it before."""

    recording: Recording
    begin: float  # [s] after the first sample


@dataclass(frozen=True)
class Ignored:
    """A motion that hardly follows its command."""

    gap: float  # [rad/s] what the model leaves of what lasts
    variation: float  # [rad/s] standard deviation of the measured speeds that last


@dataclass(frozen=True)
class Falling:
    """A motion that is slower, each time, where the voltage is higher."""

    voltage: float  # [V] of the fastest level
    speed: float  # [rad/s] there, along the voltage
    higher: float  # [V]
    slower: float  # [rad/s] there


def find_falling(held: HeldOut) -> Falling | None:
    """Find whether a motion is slower at a higher voltage at every visit there than at every visit below.

    Not where the model's motion is, too: a motor that had no time to follow, or a load that came.
    """
    largest = max((float(np.max(np.abs(one.voltage))) for one in held.recordings), default=0.0)
    if largest == 0.0:
        return None
    visits: list[list[Floats]] = [[] for _ in range(LEVELS)]
    for recording, data, left in zip(held.recordings, held.intervals, held.residuals_of, strict=False):
        voltage = recording.voltage[data.find_rows(recording)]
        level = np.minimum((LEVELS * np.abs(voltage) / largest).astype(int), LEVELS - 1)
        each = np.sign(voltage) * np.stack([data.speed, data.speed + left, voltage])
        for part in np.split(np.arange(len(level)), np.flatnonzero(np.diff(level)) + 1):
            if len(part):
                visits[level[part[0]]].append(each[:, part] @ data.duration[part] / data.duration[part].sum())
    seen = [np.stack(some, axis=1) for some in visits if len(some) >= FEWEST_VISITS]
    if not seen:
        return None
    fastest = int(np.argmax([some[0].mean() for some in seen]))
    peak, low = seen[fastest], min(seen[fastest:], key=lambda some: float(some[0].mean()))
    (speed, simulated, at), (slower, follows, higher) = (some.mean(axis=1) for some in (peak, low))
    fell = speed - slower
    apart = low[0].max() < peak[0].min() and fell > LEAST_FALL * speed
    return Falling(at, speed, higher, slower) if apart and simulated - follows < SHARED * fell else None


def find_stopped(recordings: Sequence[Recording]) -> Stopped | None:
    """Find the first recording at whose end a motor stands for long under voltages that moved it before; None if none.

    Far longer than it stood under such before it moved: a dead time, or a friction that lets it go, is no end. Nor is
    what a loop holds where it was to go.
    """
    for recording in recordings:
        begin = _find_stop(recording)
        if begin is not None:
            return Stopped(recording, begin)
    return None


def _find_stop(recording: Recording) -> float | None:
    """Find from when on [s] the motor of a recording stands to the end under voltages that moved it before."""
    voltage, speed = np.abs(recording.voltage), np.abs(recording.speed)
    moves = speed > MOVING * float(np.quantile(speed, 0.99))
    if not moves.any():
        return None
    rows = np.arange(len(recording))
    duration = np.diff(recording.time, append=recording.duration + recording.sample_period)
    driven = voltage > DRIVING * float(voltage.max())
    stands = driven & (rows > rows[moves][-1])
    before = driven & ~stands & (voltage <= float(np.max(voltage[stands], initial=0.0)))
    moved, stood = float(duration[before & moves].sum()), float(duration[stands].sum())
    if not (moved > MOVED * duration[before].sum() and RESTS * moved > stood):
        return None
    rests = before & ~moves
    parts = np.split(rows, np.flatnonzero(np.diff(rests)) + 1)
    rest = max(float(duration[part][rests[part]].sum()) for part in parts)
    least = max(RESTS * rest, FEWEST_ROWS * float(np.median(duration)))
    return float(recording.time[stands][0]) if stood > least else None


def find_ignored(held: HeldOut) -> Ignored | None:
    """Find whether what lasts in a motion has next to nothing to do with its command."""
    if not held.counted.any() or not _varies(held):
        return None
    lasting = held.joined(find_lasting_interval(held))
    if len(lasting.residuals) < 2:
        return None
    speed, weight = np.concatenate([data.speed for data in lasting.intervals]), lasting.weight
    mean = float(weight @ speed)
    variation = float(np.sqrt(weight @ (speed - mean) ** 2))
    explained = lasting.gap**2 < (1.0 - LEAST_EXPLAINED) * variation**2
    small = lasting.gap < MATTERS * float(np.hypot(mean, variation))
    return None if explained or small else Ignored(lasting.gap, variation)


def goes_with_sweep(structure: Sequence[Structure], held: HeldOut) -> bool:
    """Decide whether what is left goes with the time, most of all, under sweeps, in which that is the frequency too."""
    certain = [one for one in structure if one.certain]
    by_time = bool(certain) and certain[0].variable == BY_TIME and not certain[0].cause
    return by_time and bool(held.recordings) and all(map(is_sweep, held.recordings))


def _varies(held: HeldOut) -> bool:
    """Decide whether the command of any recording varies enough to move a motor otherwise than evenly."""
    return any(np.std(one.voltage) > VARIES * np.max(np.abs(one.voltage)) for one in held.recordings)
