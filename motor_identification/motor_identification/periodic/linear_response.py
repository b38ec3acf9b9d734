"""Compute the linear response of a motor to a load that repeats with the angle, over measured angles.

A load of 1 V, e^(i·c·θ) for c cycles a turn, moves the speed by x with dx/dt = −rate·x − e^(i·c·θ)/ka. Within an
interval between two measured angles the shaft turns evenly, and so it does from one to the next where a run has gaps;
the response is had in closed form.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from motor_identification.noise.error_model import Lag
from motor_identification.recording import Bools, Floats, Integers
from motor_model.compiled import compiled

Complexes = NDArray[np.complex128]

SMALL_TURN = 1e-6  # [rad] of the load, below which it is taken for constant


@dataclass(frozen=True)
class Course:
    """The measured motion of one recording, and the motor that made it; arrays of shape (I,)."""

    order: Integers  # of the intervals in time
    run: Integers  # the counted run that an interval is in, see `Track`
    start: Floats  # [rad]
    end: Floats  # [rad]
    duration: Floats  # [s]
    gap: Floats  # [s] from the interval before in the same run; 0 where it follows that at once, or a run begins
    moving: Bools
    lag: Lag

    def response(self, cycles: float) -> tuple[Floats, Floats]:
        """Compute the increments [rad] that loads of sin(cycles·θ) and of cos(cycles·θ), 1 V each, make, (I,) each."""
        travel = np.zeros(len(self.start), dtype=np.complex128)
        _fill_response(
            self.order, self.start, self.end, self.duration, self.gap, self.moving, cycles, self.lag.rate, travel
        )
        travel /= self.lag.rate * self.lag.ka
        return travel.imag, travel.real

    def transient(self) -> Floats:
        """Compute the increments [rad] that a speed of 1 rad/s at the beginning of every counted run makes, (I,)."""
        travel = np.zeros(len(self.start))
        _fill_transient(self.order, self.run, self.duration, self.gap, self.moving, self.lag.rate, travel)
        return travel


@compiled
def pass_interval(
    speed: complex, here: complex, there: complex, turn: float, h: float, fade: float, rate: float
) -> tuple[complex, complex]:
    """Compute travel, times rate, and speed after h s in which the load turns from `here` to `there`, by `turn` rad.

    Of a motor of inertia 1. Real numbers are kept apart from complex ones: times faster.
    """
    frequency = turn / h
    share = 1.0 / (rate * rate + frequency * frequency)
    lag = complex(rate * share, -frequency * share)  # 1/(rate + i·frequency)
    left = complex(fade * speed.real, fade * speed.imag)
    then = left - (there - complex(fade * here.real, fade * here.imag)) * lag
    change = there - here
    if abs(turn) > SMALL_TURN:
        load = complex(change.imag / frequency, -change.real / frequency)
    else:
        load = complex(here.real * h, here.imag * h)
    return speed - then - load, then


@compiled
def phasor(angle: float) -> complex:
    """Compute e^(i·angle) of an angle [rad]."""
    return complex(np.cos(angle), np.sin(angle))


@compiled
def _fill_response(
    order: Integers, start: Floats, end: Floats, duration: Floats, gap: Floats, moving: Bools,
    cycles: float, rate: float, travel: Complexes,
) -> None:  # fmt: skip
    speed, there, at = complex(0.0, 0.0), complex(1.0, 0.0), 0.0
    for i in order:
        h = duration[i]
        if not moving[i] or h <= 0.0:
            speed = complex(0.0, 0.0)
            continue
        here = there if start[i] == at else phasor(cycles * start[i])
        if gap[i] > 0.0:
            turn, fade = cycles * (start[i] - at), np.exp(-rate * gap[i])
            speed = pass_interval(speed, there, here, turn, gap[i], fade, rate)[1]
        there, at = phasor(cycles * end[i]), end[i]
        turn, fade = cycles * (end[i] - start[i]), np.exp(-rate * h)
        travel[i], speed = pass_interval(speed, here, there, turn, h, fade, rate)


@compiled
def _fill_transient(
    order: Integers, run: Integers, duration: Floats, gap: Floats, moving: Bools, rate: float, travel: Floats
) -> None:
    """Increments of dx/dt = −rate·x in every run that begins with x = 1 rad/s."""
    speed, number = 0.0, -1
    for i in order:
        if run[i] != number or not moving[i]:
            speed, number = 1.0, run[i]
        else:
            speed *= np.exp(-rate * gap[i])
        if moving[i]:
            fade = np.exp(-rate * duration[i])
            travel[i] = speed * (1.0 - fade) / rate
            speed *= fade
