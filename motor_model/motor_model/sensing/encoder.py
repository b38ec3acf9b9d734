"""The encoder: a disc with irregular slots turns angle into edges, each with its exact time.

Edges are of one polarity. Turning forward the sensor sees one flank of a hole, turning backward the other, half a slot
away and with an irregularity of its own; that is why a table of slot offsets belongs to one direction. The same flanks
passed the other way are the falling edges of the sensor's signal.
"""

from dataclasses import dataclass
from math import floor, pi, sin, tau

import numpy as np
from numpy.typing import NDArray

from motor_model.compiled import compiled
from motor_model.dynamics.motor import piece, time_in_piece
from motor_model.dynamics.state import State
from motor_model.effects import INDEX

ECCENTRICITY, ECCENTRICITY_PHASE = INDEX["eccentricity"], INDEX["eccentricity_phase"]
GEAR = INDEX["gear_ratio"]
HOLE_SHARE = 0.5  # of a slot

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Lines:
    """How a sensor of two channels sees its disc, as shares of a period of channel A, forward."""

    duty_cycle: float = 0.5  # for which A and B are high
    phase: float = 0.25  # from A's rising flank to B's


@dataclass(frozen=True)
class Disc:
    """Where a disc's flanks are: angles [rad] of edge i seen turning forward and backward, both of shape (N,).

    They are the output's angles: behind a gear a turn of the disc is less than a turn.
    """

    forward: Floats
    backward: Floats


def make_disc(edges_per_revolution: int, irregularity: float = 0.0, seed: int = 0, gear: float = 1.0) -> Disc:
    """Make a disc whose flanks are off by a Gaussian share `irregularity` of a slot, the same every turn."""
    random = np.random.default_rng(seed)
    slot = tau / edges_per_revolution / gear
    nominal = slot * np.arange(edges_per_revolution)
    offsets = irregularity * slot * random.standard_normal((2, edges_per_revolution))
    offsets -= offsets.mean(axis=1, keepdims=True)
    return Disc(nominal + offsets[0], nominal + HOLE_SHARE * slot + offsets[1])


def make_lines_disc(
    pulses: int, quadrature: int, irregularity: float, seed: int, gear: float, lines: "Lines | None" = None
) -> Disc:
    """Make a disc whose flanks of two channels all count, the same both ways: 2 (of A) or 4 (of both) in a period.

    They are off by a Gaussian share of the mean angle between two counts, besides what duty cycle and phase make.
    """
    random, lines = np.random.default_rng(seed), lines or Lines()
    period = tau / pulses / gear
    shares = np.array([0.0, lines.phase, lines.duty_cycle, lines.phase + lines.duty_cycle])[:: 4 // quadrature]
    offsets = irregularity / quadrature * random.standard_normal((pulses, quadrature))
    flanks = (np.arange(pulses)[:, None] + shares + offsets - offsets.mean()).ravel() * period
    return Disc(flanks, flanks)


@compiled
def shown_angle(p: Floats, angle: float) -> float:
    """Turn an angle [rad] of the output into what an eccentric disc shows; `eccentricity` is an angle of the disc."""
    if p[ECCENTRICITY] == 0.0:
        return angle
    return angle + p[ECCENTRICITY] / p[GEAR] * sin(p[GEAR] * angle + p[ECCENTRICITY_PHASE])


@compiled
def shaft_angle_at(p: Floats, shown: float) -> float:
    """Return the output's travel [rad] when the disc has shown this travel since the output was at 0; within e³."""
    e, phase, gear = p[ECCENTRICITY], p[ECCENTRICITY_PHASE], p[GEAR]
    if e == 0.0:
        return shown
    angle = gear * shown + e * sin(phase)
    return (angle - e * sin(angle - e * sin(angle + phase) + phase)) / gear


@compiled
def show(p: Floats, angles: Floats, anchor: Floats) -> None:
    """Replace the output's angles [rad] by what an eccentric disc shows of them; at `anchor` [rad], if not empty."""
    if p[ECCENTRICITY] != 0.0:
        for k in range(len(angles)):
            at = shaft_angle_at(p, anchor[k]) if len(anchor) > 0 else angles[k]
            angles[k] += shown_angle(p, at) - at


@compiled
def _shaft_angle(p: Floats, shown: float) -> float:
    """The output's angle [rad] at which an eccentric disc shows this angle; the inverse of `shown_angle`."""
    e, gear = p[ECCENTRICITY] / p[GEAR], p[GEAR]
    if e == 0.0:
        return shown
    low, high = shown - e, shown + e
    for _ in range(60):
        middle = 0.5 * (low + high)
        if middle + e * sin(gear * middle + p[ECCENTRICITY_PHASE]) < shown:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


@compiled
def flank(flanks: Floats, index: int, revolution: float = 2.0 * pi) -> float:
    """Angle [rad] of edge `index` counted without end over the disc's turns, of `revolution` [rad] each."""
    n = len(flanks)
    turn = index // n
    return flanks[index - turn * n] + revolution * turn


@compiled
def next_flank(flanks: Floats, here: float, sign: int, revolution: float) -> int:
    """Index of the first flank beyond an angle [rad], in the direction of `sign`."""
    index = int(floor(here / (revolution / len(flanks)))) - 2 * sign
    while (flank(flanks, index, revolution) - here) * sign <= 0.0:
        index += sign
    return index


@compiled
def turn(
    p: Floats,
    u: float,
    s: State,
    t: float,
    dt: float,
    forward: Floats,
    backward: Floats,
    offset: float,
    times: Floats,
    directions: NDArray[np.int64],
    falls: bool = False,
) -> tuple[State, int]:
    """Turn the motor for dt [s] at an effective voltage u [V] and write down the edges it passes.

    offset: [rad] where the disc stands when the shaft is at 0. times [s] and directions (±1, falling edges ±2 and only
    where `falls`) are filled as far as they reach. Returns the state and the number of edges.
    """
    end, count, revolution = t + dt, 0, 2.0 * pi / p[GEAR]
    while t < end:
        left = end - t
        after, taken = piece(p, u, s, t, left)
        if after.angle != s.angle:
            sign = 1 if after.angle > s.angle else -1
            rising, falling = (forward, backward) if sign > 0 else (backward, forward)
            here, there = shown_angle(p, s.angle) + offset, shown_angle(p, after.angle) + offset
            rise = next_flank(rising, here, sign, revolution)
            fall = next_flank(falling, here, sign, revolution) if falls else rise
            while True:
                up, down = flank(rising, rise, revolution), flank(falling, fall, revolution)
                first = falls and (up - down) * sign > 0.0
                at = down if first else up
                if (there - at) * sign < 0.0:
                    break
                if count < len(times):
                    times[count] = t + time_in_piece(p, u, s, t, taken, _shaft_angle(p, at - offset))
                    directions[count] = 2 * sign if first else sign
                    count += 1
                if first:
                    fall += sign
                else:
                    rise += sign
        s = after
        t = end if taken >= left else t + taken
    return s, count
