"""What figures draw over time: measured and simulated mean speeds of one recording, and the residual."""

from dataclasses import dataclass, fields
from math import isnan, nan

import numpy as np

from motor_identification.diagnosis.result import Diagnosis
from motor_identification.discrepancy.worst_regions import Region
from motor_identification.estimation.residual import compute_residuals
from motor_identification.measurement.build_intervals import make_intervals
from motor_identification.measurement.intervals import Intervals
from motor_identification.recording import Bools, Floats, Recording
from motor_identification.timing.timing import read_again
from motor_identification.uncertainty.result import Fit
from motor_identification.validation.held_out import HeldOut
from motor_model.simulate import simulate

WINDOW = 3.0  # [s]


@dataclass(frozen=True)
class Curves:
    """One model on one recording, in the order of time; arrays of shape (I,)."""

    time: Floats  # [s] middle of every interval
    duration: Floats  # [s] of every interval
    measured: Floats  # [rad/s] mean speeds
    simulated: Floats
    residual: Floats  # [rad/s] simulated − measured
    floor: Floats  # [rad/s] standard deviation that timer and slots leave in it
    still: Bools  # no edge came: what is measured is a bound
    scored: Bools  # counts in the gap
    regions: tuple[Bools, ...]  # which belong to the worst regions

    def between(self, start: float, stop: float) -> "Curves":
        """The part between two times [s]."""
        inside = (self.time >= start) & (self.time <= stop)
        columns = {field.name: getattr(self, field.name)[inside] for field in fields(self) if field.name != "regions"}
        return Curves(**columns, regions=tuple(region[inside] for region in self.regions))


def make_held_out_curves(held: HeldOut, share: float, number: int, regions: tuple[Region, ...]) -> Curves:
    """Make a model's curves on recording `number` of its held-out data; `share` is the slots' irregularity."""
    data, angle = held.intervals[number], held.angles[number]
    begin = sum(len(other.first) for other in held.intervals[:number])
    part = slice(begin, begin + len(data.first))
    marked = []
    for region in regions:
        whole = np.zeros(len(held.counted), dtype=bool)
        whole[held.counted] = region.inside
        marked.append(whole[part])
    return _curves(data, angle, share, held.scored[number], tuple(marked))


def make_fit_curves(recording: Recording, fit: Fit) -> Curves:
    """Make the curves of a fitted model on one of the recordings that it was fitted to."""
    recording = read_again(recording, fit.timing)
    number = fit.uris.index(recording.uri) if recording.uri in fit.uris else -1
    start = fit.start_speeds[number] if number >= 0 else 0.0
    share = fit.slot_irregularity[number] if number >= 0 else nan
    data = make_intervals(recording)
    motion = simulate(fit.parameters, recording.time, recording.voltage, data.time, start)
    everywhere = np.ones(len(data.first), dtype=bool)
    return _curves(data, motion.angle, 0.0 if isnan(share) else share, everywhere, ())


def _curves(data: Intervals, angle: Floats, share: float, scored: Bools, regions: tuple[Bools, ...]) -> Curves:
    """Put intervals, shape (I,), in the order of time; `angle` [rad] is simulated, at the times of `data`."""
    middle = 0.5 * (data.time[data.first] + data.time[data.last])
    order = np.argsort(middle, kind="stable")
    return Curves(
        time=middle[order],
        duration=data.duration[order],
        measured=data.speed[order],
        simulated=((angle[data.last] - angle[data.first]) / data.duration)[order],
        residual=compute_residuals(data, angle)[order],
        floor=np.sqrt(data.floor_squared(share * data.unit))[order],
        still=(data.slack > 0.0)[order],
        scored=scored[order],
        regions=tuple(region[order] for region in regions),
    )


def find_largest_change(diagnosis: Diagnosis) -> tuple[int, float, float]:
    """Find the recording and the 3 s in which a diagnosis changes the squared error most; without one, the worst."""
    best = (-np.inf, 0, 0.0)
    for number, recording in enumerate(diagnosis.before.recordings):
        starts = _starts(recording.duration)
        before = _squares(make_held_out_curves(diagnosis.before, 0.0, number, ()), starts)
        after = _squares(make_held_out_curves(diagnosis.after, 0.0, number, ()), starts)
        gain = np.abs(before - after) if diagnosis.findings else after
        best = max(best, (float(gain.max()), number, float(starts[int(np.argmax(gain))])))
    _, number, start = best
    return number, start, start + WINDOW


def find_largest_error(curves: Curves, duration: float) -> tuple[float, float]:
    """Find the 3 s of a recording, from and to [s], with the largest squared error."""
    starts = _starts(duration)
    start = float(starts[int(np.argmax(_squares(curves, starts)))])
    return start, start + WINDOW


def _starts(duration: float) -> Floats:
    return np.asarray(np.arange(0.0, max(duration - WINDOW, 0.0) + 1e-9, 0.5), dtype=np.float64)


def _squares(one: Curves, starts: Floats) -> Floats:
    """[rad²/s] of what counts in the seconds after every start."""
    sums = np.append(0.0, np.cumsum(np.where(one.scored, one.duration * one.residual**2, 0.0)))
    begin, end = np.searchsorted(one.time, starts), np.searchsorted(one.time, starts + WINDOW)
    return np.asarray(sums[end] - sums[begin])
