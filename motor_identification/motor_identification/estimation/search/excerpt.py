"""Take excerpts of long recordings for a global search, so that an hour is searched as quickly as a minute.

Where the valley is, a minute of motion says as well as an hour; what the hour adds is for least squares. Pieces begin
at a standstill (or with the recording), so that they need no initial speed of their own, and are spread over the
recording: half of them where the voltage changes most, which shows the dynamics, half where it spreads widest, which
shows the static curve.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from motor_identification.estimation.problem import Problem
from motor_identification.measurement.intervals import Intervals
from motor_identification.recording import Floats, Integers, Recording
from motor_model.effects import EFFECTS

MOST_SEARCHED = 12_000.0  # sample periods of all recordings together above which excerpts are searched
PIECES_PER_RECORDING = 4
LEAST_REST = 20.0  # sample periods without any speed before a motor counts as standing
# Effects of something that happens once, or slowly, can be anywhere; phases count from a recording's beginning.
ANYWHERE = frozenset(effect.name for effect in EFFECTS if effect.anywhere)
BEGINNING = frozenset(effect.name for effect in EFFECTS if effect.periodic)


def take_excerpt(problem: Problem, most: float = MOST_SEARCHED) -> Problem:
    """Take an excerpt of at most so many sample periods of motion, with the same unknowns; a short problem as it is.

    Join intervals before (`Problem.coarse`), not after: joining starts at the recording's beginning again. Each piece
    counts as a recording: `commands` and `intervals` have as many entries as there are pieces.
    """
    effects, longest = set(problem.unknowns.effects), most * problem.sample_period
    total = sum(recording.duration for recording in problem.recordings)
    if total <= longest or effects & ANYWHERE:
        return problem
    recordings, intervals, turning = [], [], []
    for recording, data, moving in zip(problem.recordings, problem.intervals, problem.unknowns.turning, strict=True):
        length = recording.duration * longest / total
        starts = [0.0] if moving or effects & BEGINNING else _starts(recording, data, length / PIECES_PER_RECORDING)
        for start in starts:
            piece = _piece(data, start, start + length / len(starts))
            if len(piece.first) > 0:
                recordings.append(recording)
                intervals.append(piece)
                turning.append(bool(moving))
    if not recordings:
        return problem
    return replace(
        problem,
        recordings=tuple(recordings),
        intervals=tuple(intervals),
        unknowns=replace(problem.unknowns, turning=np.array(turning)),
    )


def _starts(recording: Recording, data: Intervals, length: float) -> list[float]:
    """Where pieces of so many seconds begin: in each of equal parts of the recording, the one that shows most.

    Pieces without motion are left out: a motor may stand for most of a recording.
    """
    time = recording.time
    candidates = _standing(recording, length)
    candidates = candidates[time[candidates] <= max(time[-1] - length, 0.0)]
    first, last = np.sort(data.time[data.first]), np.sort(data.time[data.last])
    inside = np.searchsorted(last, time[candidates] + length, "right") - np.searchsorted(first, time[candidates])
    if np.any(inside > 0):
        candidates = candidates[inside > 0]
    ends = np.searchsorted(time, time[candidates] + length)
    part = np.minimum(time[candidates] / time[-1] * PIECES_PER_RECORDING, PIECES_PER_RECORDING - 1).astype(np.int64)
    starts = []
    for number in np.unique(part):
        here = part == number
        shown = _SHOWN[number % len(_SHOWN)](recording.voltage, candidates[here], ends[here])
        starts.append(float(time[candidates[here][np.argmax(shown)]]))
    return starts


def _standing(recording: Recording, length: float) -> Integers:
    """Samples at which the motor stands: the first one, and the middle of every standstill.

    Towards the end of a standstill the motor may be moving already: it has a slot to go before an edge shows it. Of one
    that is longer than a piece [s], where its voltage has not changed yet counts too: the middle would show nothing.
    """
    time, still = recording.time, recording.speed == 0.0
    began = np.flatnonzero(still & ~np.append(False, still[:-1]))
    ended = np.flatnonzero(still & ~np.append(still[1:], False))
    long = time[ended] - time[began] >= LEAST_REST * recording.sample_period
    middle = (began[long] + ended[long]) // 2
    changes = np.append(np.flatnonzero(np.diff(recording.voltage)), len(time) - 1)  # the last samples before
    late = np.minimum(changes[np.searchsorted(changes, middle)], ended[long])[
        (time[ended] - time[began])[long] > length
    ]
    return np.asarray(np.unique(np.concatenate([[0], middle, late])), dtype=np.int64)


def _changes(voltage: Floats, begin: Integers, end: Integers) -> Floats:
    """[V] how far the voltage travels in each piece."""
    travelled = np.append(0.0, np.cumsum(np.abs(np.diff(voltage, append=voltage[-1]))))
    return np.asarray(travelled[end] - travelled[begin])


def _spread(voltage: Floats, begin: Integers, end: Integers) -> Floats:
    """[V²] the voltage's variance in each piece."""
    sums, squares = (np.append(0.0, np.cumsum(voltage**power)) for power in (1, 2))
    count = np.maximum(end - begin, 1)
    return np.asarray((squares[end] - squares[begin]) / count - ((sums[end] - sums[begin]) / count) ** 2)


_SHOWN: tuple[Callable[[Floats, Integers, Integers], Floats], ...] = (_changes, _spread)


def _piece(data: Intervals, start: float, stop: float) -> Intervals:
    """The intervals between two times [s]; the motion starts at the first one."""
    inside = (data.time[data.first] >= start) & (data.time[data.last] <= stop)
    first, last = data.first[inside], data.last[inside]
    used, index = np.unique(np.concatenate([first, last]), return_inverse=True)
    shift = 0 if len(used) and data.time[used[0]] == start else 1  # the start is a time of its own
    time = data.time[used] if shift == 0 else np.append(start, data.time[used])
    return replace(
        data,
        time=time,
        first=(index[: len(first)] + shift).astype(np.int64),
        last=(index[len(first) :] + shift).astype(np.int64),
        speed=data.speed[inside],
        slack=data.slack[inside],
        blur=data.blur[inside],
        edge=data.edge[inside],
    )
