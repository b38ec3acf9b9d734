"""What is drawn over time: measured and simulated speeds of one held-out recording, and what is left of them."""

from dataclasses import dataclass

import numpy as np

from motor_identification.diagnosis.result import Diagnosis
from motor_identification.discrepancy.worst_regions import Region
from motor_identification.recording import Bools, Floats
from motor_identification.validation.held_out import HeldOut

TELLING = 3.0  # [s]


@dataclass(frozen=True)
class Curves:
    """One model on one recording, in the order of time; arrays of shape (I,)."""

    time: Floats  # [s] middle of every interval
    measured: Floats  # [rad/s] mean speeds
    simulated: Floats
    left: Floats  # [rad/s] the residual
    floor: Floats  # [rad/s] standard deviation that timer and slots leave in it
    scored: Bools  # counts in the gap
    regions: tuple[Bools, ...]  # which belong to the worst regions

    def between(self, start: float, stop: float) -> "Curves":
        """The part between two times [s]."""
        inside = (self.time >= start) & (self.time <= stop)
        return Curves(
            self.time[inside], self.measured[inside], self.simulated[inside], self.left[inside], self.floor[inside],
            self.scored[inside], tuple(region[inside] for region in self.regions),
        )  # fmt: skip


def curves(held: HeldOut, share: float, number: int, regions: tuple[Region, ...]) -> Curves:
    """A model on recording `number` of its held-out data."""
    problem = held.problem
    data, angle = problem.intervals[number], problem.angles(held.place)[number]
    begin = sum(len(other.first) for other in problem.intervals[:number])
    part = slice(begin, begin + len(data.first))
    middle = 0.5 * (data.time[data.first] + data.time[data.last])
    everything = HeldOut(problem, held.place, tuple(np.ones_like(marks) for marks in held.scored), 0)
    order = np.argsort(middle, kind="stable")
    marked = []
    for region in regions:
        whole = np.zeros(len(held.counted), dtype=bool)
        whole[held.counted] = region.inside
        marked.append(whole[part][order])
    return Curves(
        time=middle[order],
        measured=data.speed[order],
        simulated=((angle[data.last] - angle[data.first]) / data.duration)[order],
        left=everything.residuals[part][order],
        floor=everything.floors(share)[part][order],
        scored=held.scored[number][order],
        regions=tuple(marked),
    )


def telling(diagnosis: Diagnosis) -> tuple[int, float, float]:
    """The recording and the seconds, from and to, in which the models differ most, or the last one is most wrong."""
    best = (-np.inf, 0, 0.0)
    for number, recording in enumerate(diagnosis.before.problem.recordings):
        starts = np.asarray(np.arange(0.0, max(recording.duration - TELLING, 0.0) + 1e-9, 0.5), dtype=np.float64)
        before = _squares(diagnosis.before, number, starts)
        after = _squares(diagnosis.after, number, starts)
        gain = np.abs(before - after) if diagnosis.findings else after
        best = max(best, (float(gain.max()), number, float(starts[int(np.argmax(gain))])))
    _, number, start = best
    return number, start, start + TELLING


def _squares(held: HeldOut, number: int, starts: Floats) -> Floats:
    """[rad²/s] of what counts in the seconds after every start."""
    one = curves(held, 0.0, number, ())
    data = held.problem.intervals[number]
    order = np.argsort(0.5 * (data.time[data.first] + data.time[data.last]), kind="stable")
    sums = np.append(0.0, np.cumsum(np.where(one.scored, data.duration[order] * one.left**2, 0.0)))
    begin, end = np.searchsorted(one.time, starts), np.searchsorted(one.time, starts + TELLING)
    return np.asarray(sums[end] - sums[begin])
