"""When a fault could be known at the earliest: no motion of the motor fits what its encoder says any more.

A perfect observer knows the motor (top speed, time constant, friction), its state at the instant of the fault, and that
a load may change as it likes within a bound. All motions that are left are a set of angle and speed,

    dθ/dt = ω,   τ dω/dt = (u − friction − load)/kv − ω,   |load| <= bound

that spreads with time and is cut where an edge comes, or none: between edges the shaft stays within its slot, at an
edge it is at one of the slot's ends (which one, a single channel does not say). Where nothing is left, the likelihood
of a healthy motor is 0. What such an observer does not know, nobody does; a stop before that would be a guess.

The set is a polygon for each direction of the latest edge; the load is constant over a sample, and flanks are within
`OFF` of where they should be.
"""

from dataclasses import dataclass
from math import exp, inf

import numpy as np
from faults_loop import Loop
from faults_motor import BREAKAWAY, SLIDING
from numpy.typing import NDArray

from motor_model.sample import Sample

OFF = 0.05  # of a slot: five times the disc's irregularity
EPSILON = 1e-9
Polygon = NDArray[np.float64]  # corners, of shape (n, 2): angle [slots] and speed [slots/s]; no corner: empty


@dataclass(frozen=True)
class Told:
    """What a sample says, and what was true at the one before it."""

    sample: Sample
    dt: float  # [s] since the one before
    edges: int  # since the one before; negative: backward, two channels
    voltage: float  # [V] since the one before
    after: float  # [s] of the latest edge, since the sample before


@dataclass(frozen=True)
class Healthy:
    """A motor without a fault; speeds [slots/s], voltages as shares of the motor's."""

    top: float
    lag: float  # [s]
    load: float  # at most
    two_channels: bool

    def step(self, polygon: Polygon, voltage: float, dt: float) -> Polygon:
        """Spread a set of states over a time [s] at a voltage."""
        if len(polygon) == 0 or dt <= 0.0:
            return polygon
        friction = self._friction(polygon)
        low, high = voltage - friction[1] - self.load, voltage - friction[0] + self.load
        kept = exp(-dt / self.lag)
        glide = self.lag * (1.0 - kept)
        angle, speed = polygon[:, 0], polygon[:, 1]
        free = np.column_stack((angle + glide * speed, kept * speed))
        push = np.array([dt - glide, 1.0 - kept]) * self.top
        return hull(np.vstack((free + low * push, free + high * push)))

    def _friction(self, polygon: Polygon) -> tuple[float, float]:
        """What friction may take, forward."""
        if polygon[:, 1].min() > 0.0:
            return SLIDING, BREAKAWAY
        return (-BREAKAWAY, -SLIDING) if polygon[:, 1].max() < 0.0 else (-BREAKAWAY, BREAKAWAY)


def hull(points: Polygon) -> Polygon:
    """Corners of the convex hull, counter-clockwise (Andrew's monotone chain)."""
    points = points[np.lexsort((points[:, 1], points[:, 0]))]
    if len(points) < 3:
        return points
    chains = []
    for ordered in (points.tolist(), points[::-1].tolist()):
        chain: list[list[float]] = []
        for x, y in ordered:
            while len(chain) > 1:
                (ax, ay), (bx, by) = chain[-2], chain[-1]
                if (bx - ax) * (y - ay) - (by - ay) * (x - ax) > EPSILON:
                    break
                chain.pop()
            chain.append([x, y])
        chains += chain[:-1]
    return np.array(chains)


def clip(polygon: Polygon, column: int, bound: float, above: bool) -> Polygon:
    """Cut off what is below a bound of a column, or above it."""
    if len(polygon) == 0:
        return polygon
    inside = (polygon[:, column] - bound) * (1.0 if above else -1.0)
    kept = []
    for k in range(len(polygon)):
        here, before = inside[k], inside[k - 1]
        if here * before < 0.0:
            share = before / (before - here)
            kept.append(polygon[k - 1] + share * (polygon[k] - polygon[k - 1]))
        if here >= 0.0:
            kept.append(polygon[k])
    return np.array(kept) if kept else np.empty((0, 2))


def stay(polygon: Polygon) -> Polygon:
    """Keep what is within the slot: no edge has come."""
    return clip(clip(polygon, 0, -OFF, True), 0, 1.0 + OFF, False)


def cross(polygons: list[Polygon], ways: tuple[int, ...]) -> list[Polygon]:
    """Keep what is at an end of the slot, and put it at the beginning of the next one; one set for each way."""
    after = []
    for way in (1, -1):
        ends = []
        for polygon in polygons if way in ways else []:
            end = clip(polygon, 1, 0.0, way > 0)
            end = clip(clip(end, 0, 1.0 - OFF if way > 0 else -OFF, True), 0, 1.0 + OFF if way > 0 else OFF, False)
            if len(end):
                ends.append(end - np.array([float(way), 0.0]))
        after.append(hull(np.vstack(ends)) if ends else np.empty((0, 2)))
    return after


def follow(motor: Healthy, polygons: list[Polygon], told: Told) -> list[Polygon]:
    """Follow one sample; edges are evenly between the first and the latest of it, as far as they are told."""
    voltage, count = told.voltage, abs(told.edges)
    ways = ((1 if told.edges > 0 else -1),) if motor.two_channels else (1, -1)
    time = 0.0
    if count:
        period = told.sample.edge_period if told.sample.edge_period > 0.0 else told.dt
        first = max(told.after - (count - 1) * period, 0.0)
        times = [told.after] if count == 1 else np.linspace(first, told.after, count).tolist()
        for at in times:
            polygons = cross([motor.step(one, voltage, at - time) for one in polygons], ways)
            time = at
    return [stay(motor.step(one, voltage, told.dt - time)) for one in polygons]


@dataclass
class Recorder:
    """What a loop's controller was told, and the true motion."""

    loop: Loop
    told: list[tuple[Sample, float]]  # beside it the true speed [rad/s]


def record(loop: Loop) -> Recorder:
    """Record what the encoder's line says from now on."""
    recorder, line = Recorder(loop, []), loop.line

    def told(sample: Sample) -> Sample:
        said = line(sample)
        recorder.told.append((said, loop.board.speed))
        return said

    loop.line = told
    return recorder


def knowable(recorder: Recorder, load: float) -> float:
    """Find the time [s] after its beginning at which no motion fits a record any more; infinite: one always does."""
    loop = recorder.loop
    slot = 2.0 * np.pi / loop.edges
    lag = loop.motor.parameters().value("ka") / loop.motor.kv
    motor = Healthy(loop.motor.top / slot, lag, load, not loop.single_channel)
    before, speed = recorder.told[0]
    speed = abs(speed) * (-1.0 if before.speed < 0.0 else 1.0) / slot  # exchanged channels show it the other way
    polygons = [np.array([[0.0, speed], [1.0, speed]])]  # where in its slot, it does not know
    begin = before.sample_time
    for sample, _ in recorder.told[1:]:
        dt, after = (
            (sample.sample_time - before.sample_time) * 1e-9,
            (sample.edge_time - before.sample_time) * 1e-9,
        )
        edges = sample.edge_count - before.edge_count
        share = before.voltage / loop.motor.voltage
        polygons = follow(motor, polygons, Told(sample, dt, edges, share, min(max(after, 0.0), dt)))
        if not any(len(one) for one in polygons):
            return (sample.sample_time - begin) * 1e-9
        before = sample
    return inf
