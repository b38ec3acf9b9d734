"""Follow all states of a healthy motor that fit what its encoder says (set-membership estimation).

A state is an angle [slots] and a speed [slots/s]; all that fit are a polygon for each direction of the latest edge. It
spreads with time, as the load may be anything up to a bound, and is cut where an edge comes, or none. The load is
constant over a sample, flanks are within OFF of where they should be, and of several edges in a sample the latest is
looked at.
"""

from dataclasses import dataclass
from math import exp

import numpy as np
from faults_motor import BREAKAWAY, SLIDING
from polygon import Polygon, clip, hull

from motor_model.sample import Sample

OFF = 0.05  # of a slot: five times the disc's irregularity


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


@dataclass(frozen=True)
class Course:
    """What is left of motions whose latest edge was passed one way: angles and speeds are counted that way, from it."""

    way: int
    states: Polygon


def stay(course: Course, two_channels: bool) -> Course:
    """Keep what shows no edge: up to the next flank, or back to where the other polarity's is."""
    back = 0.0 if two_channels else -0.5
    return Course(course.way, clip(clip(course.states, 0, back - OFF, True), 0, 1.0 + OFF, False))


def cross(courses: list[Course], count: int, two_channels: bool, direction: int) -> list[Course]:
    """Keep what is at a flank after so many edges [one way]; direction: measured by two channels, else 0."""
    found: dict[int, list[Polygon]] = {1: [], -1: []}
    for course in courses:
        on, turns = course.way, [(0.5, 0.0), (0.0, 0.5)] if two_channels else [(0.5, 0.0), (-0.5, 0.0)]
        if direction in (0, on):
            found[on].append(cut(course.states, float(count), True) - np.array([float(count), 0.0]))
        if direction in (0, -on):
            for at, then in turns:
                end = cut(course.states, at - (count - 1), False)
                end[:, 0] = then + (at - (count - 1)) - end[:, 0]
                end[:, 1] = -end[:, 1]
                found[-on].append(end)
        if count > 1 and len(course.states) and course.states[:, 1].min() < 0.0:  # it may have turned in between
            for way in (1, -1):
                fastest = float(np.abs(course.states[:, 1]).max())
                found[way].append(np.array([[a, v] for a in (-0.5, 1.0) for v in (-fastest, fastest)]))
    return [Course(way, hull(np.vstack(some))) for way, some in found.items() if any(len(one) for one in some)]


def cut(states: Polygon, at: float, onward: bool) -> Polygon:
    """Cut out what is at an angle, moving onward or back."""
    end = clip(states, 1, 0.0, onward)
    return clip(clip(end, 0, at - OFF, True), 0, at + OFF, False).reshape(-1, 2).copy()


def move(motor: Healthy, courses: list[Course], voltage: float, dt: float) -> list[Course]:
    """Let time [s] pass under a voltage."""
    return [Course(one.way, motor.step(one.states, one.way * voltage, dt)) for one in courses]


def follow(motor: Healthy, courses: list[Course], told: Told) -> list[Course]:
    """Follow one sample: of its edges the latest has a stamp."""
    time, count = 0.0, abs(told.edges)
    if count:
        time = told.after
        direction = (1 if told.edges > 0 else -1) if motor.two_channels else 0
        courses = cross(move(motor, courses, told.voltage, time), count, motor.two_channels, direction)
    after = [stay(one, motor.two_channels) for one in move(motor, courses, told.voltage, told.dt - time)]
    return [one for one in after if len(one.states)]
