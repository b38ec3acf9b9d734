"""Compute the linear response of a motor to a load that repeats with the angle, over measured angles.

A load of 1 V, e^(i·c·θ) for c cycles a turn, moves the speed by x with dx/dt = −rate·x − e^(i·c·θ)/inertia. Within an
interval between two measured angles the shaft turns evenly, and the response is had in closed form.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from motor_identification.recording import Bools, Floats, Integers
from motor_model.compiled import compiled

Complexes = NDArray[np.complex128]

CYCLES_TOGETHER = 32  # numbers of cycles: phasors are turned from one to the next so often before they are had anew

SMALL_TURN = 1e-6  # [rad] of the load, below which it is taken for constant


@dataclass(frozen=True)
class Course:
    """The measured motion of one recording, and the motor that made it; arrays of shape (I,)."""

    order: Integers  # of the intervals in time
    run: Integers  # the counted run that an interval is in, see `Track`
    start: Floats  # [rad]
    end: Floats  # [rad]
    duration: Floats  # [s]
    moving: Bools
    rate: float  # [1/s] at which a motor forgets its speed, kv/ka
    inertia: float  # [V·s²/rad] ka

    def response(self, cycles: float) -> tuple[Floats, Floats]:
        """Compute the increments [rad] that loads of sin(cycles·θ) and of cos(cycles·θ), 1 V each, make, (I,) each."""
        travel = np.zeros(len(self.start), dtype=np.complex128)
        _fill_response(self.order, self.start, self.end, self.duration, self.moving, cycles, self.rate, travel)
        travel /= self.rate * self.inertia
        return travel.imag, travel.real

    def products(self, pull: Floats, cycles: Floats, block: Integers) -> Iterator[tuple[Floats, Floats]]:
        """Sum the products of `pull` (I,) with the responses to evenly spaced `cycles` (C,) over every block (B,).

        A few numbers of cycles at a time: with sines and with cosines, (few, B) each.
        """
        width = float(cycles[1] - cycles[0]) if len(cycles) > 1 else 0.0
        blocks = int(block.max()) + 1
        for i in range(0, len(cycles), CYCLES_TOGETHER):
            sums = np.zeros((blocks, min(CYCLES_TOGETHER, len(cycles) - i)), dtype=np.complex128)
            _add_products(
                self.order, self.start, self.end, self.duration, self.moving, float(cycles[i]), width, self.rate, pull,
                block, sums,
            )  # fmt: skip
            sums /= self.rate * self.inertia
            yield sums.imag.T, sums.real.T

    def transient(self) -> Floats:
        """Compute the increments [rad] that a speed of 1 rad/s at the beginning of every counted run makes, (I,)."""
        travel = np.zeros(len(self.start))
        _fill_transient(self.order, self.run, self.duration, self.moving, self.rate, travel)
        return travel


@compiled
def _passed(
    speed: complex, here: complex, there: complex, turn: float, h: float, fade: float, rate: float
) -> tuple[complex, complex]:
    """Travel, times rate, in h s in which the load turns from `here` to `there`, by `turn` rad; and the speed then.

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
def _phasor(angle: float) -> complex:
    return complex(np.cos(angle), np.sin(angle))


@compiled
def _fill_response(
    order: Integers, start: Floats, end: Floats, duration: Floats, moving: Bools,
    cycles: float, rate: float, travel: Complexes,
) -> None:  # fmt: skip
    speed, there, at = complex(0.0, 0.0), complex(1.0, 0.0), 0.0
    for i in order:
        h = duration[i]
        if not moving[i] or h <= 0.0:
            speed = complex(0.0, 0.0)
            continue
        here = there if start[i] == at else _phasor(cycles * start[i])
        there, at = _phasor(cycles * end[i]), end[i]
        turn, fade = cycles * (end[i] - start[i]), np.exp(-rate * h)
        travel[i], speed = _passed(speed, here, there, turn, h, fade, rate)


@compiled
def _turn_on(work: Floats, to: int, cycles: float, width: float, angle: float) -> None:
    """Fill the row from `to` on, and the next, with cosines and sines of all cycles at an angle, by doubling."""
    first, on = _phasor(cycles * angle), _phasor(width * angle)
    work[to], work[to + CYCLES_TOGETHER] = first.real, first.imag
    known = 1
    while known < CYCLES_TOGETHER:
        for k in range(to, to + known):
            x, y = work[k], work[k + CYCLES_TOGETHER]
            work[k + known] = x * on.real - y * on.imag
            work[k + known + CYCLES_TOGETHER] = x * on.imag + y * on.real
        on = on * on
        known *= 2


# Rows of the work of `_add_products`: real and imaginary parts of the speed, of the phasors at both ends, and of the
# sums. All in one array, with rows of a fixed length: only so it is vectorised.
SPEED, START, END, SUMS, ROWS = 0, 2 * CYCLES_TOGETHER, 4 * CYCLES_TOGETHER, 6 * CYCLES_TOGETHER, 8 * CYCLES_TOGETHER


@compiled
def _pass_all(
    work: Floats, cycles: float, width: float, turn: float, h: float, fade: float, rate: float, along: float
) -> None:
    """Do what `_passed` does for all numbers of cycles, in real numbers, and sum up."""
    per_second = turn / h
    for k in range(CYCLES_TOGETHER):
        frequency = (cycles + k * width) * per_second
        size = rate * rate + frequency * frequency
        inverse = 1.0 / (size * frequency)
        share, period = frequency * inverse, size * inverse  # 1/size, 1/frequency
        x, y = work[SPEED + k], work[SPEED + CYCLES_TOGETHER + k]
        hx, hy = work[START + k], work[START + CYCLES_TOGETHER + k]
        tx, ty = work[END + k], work[END + CYCLES_TOGETHER + k]
        real, imaginary = tx - fade * hx, ty - fade * hy
        then_x = fade * x - share * (real * rate + imaginary * frequency)
        then_y = fade * y - share * (imaginary * rate - real * frequency)
        work[SPEED + k], work[SPEED + CYCLES_TOGETHER + k] = then_x, then_y
        work[SUMS + k] += along * (x - then_x - (ty - hy) * period)
        work[SUMS + CYCLES_TOGETHER + k] += along * (y - then_y + (tx - hx) * period)


@compiled
def _pass_each(
    work: Floats, cycles: float, width: float, turn: float, h: float, fade: float, rate: float, along: float
) -> None:
    """Do the same one by one, also where the shaft hardly turns."""
    for k in range(CYCLES_TOGETHER):
        speed = complex(work[SPEED + k], work[SPEED + CYCLES_TOGETHER + k])
        here = complex(work[START + k], work[START + CYCLES_TOGETHER + k])
        there = complex(work[END + k], work[END + CYCLES_TOGETHER + k])
        travel, then = _passed(speed, here, there, (cycles + k * width) * turn, h, fade, rate)
        work[SPEED + k], work[SPEED + CYCLES_TOGETHER + k] = then.real, then.imag
        work[SUMS + k] += along * travel.real
        work[SUMS + CYCLES_TOGETHER + k] += along * travel.imag


@compiled
def _add_products(
    order: Integers, start: Floats, end: Floats, duration: Floats, moving: Bools,
    cycles: float, width: float, rate: float, pull: Floats, block: Integers, sums: Complexes,
) -> None:  # fmt: skip
    """All numbers of cycles in one pass: from one to the next, every angle's phasor turns by the same angle."""
    work, at, latest = np.zeros(ROWS), np.inf, -1
    least = SMALL_TURN / min(abs(cycles), abs(cycles + (CYCLES_TOGETHER - 1) * width))
    for i in order:
        h, turn = duration[i], end[i] - start[i]
        if not moving[i] or h <= 0.0:
            work[:START] = 0.0
            continue
        if block[i] != latest:
            _flush(work, sums, latest)
            latest = block[i]
        if start[i] == at:
            work[START:END] = work[END:SUMS]
        else:
            _turn_on(work, START, cycles, width, start[i])
        _turn_on(work, END, cycles, width, end[i])
        at, fade = end[i], np.exp(-rate * h)
        if abs(turn) > least:
            _pass_all(work, cycles, width, turn, h, fade, rate, pull[i])
        else:
            _pass_each(work, cycles, width, turn, h, fade, rate, pull[i])
    _flush(work, sums, latest)


@compiled
def _flush(work: Floats, sums: Complexes, block: int) -> None:
    """Add the sums of a block to what it has (none before the first), and begin anew."""
    if block >= 0:
        for k in range(sums.shape[1]):
            sums[block, k] += complex(work[SUMS + k], work[SUMS + CYCLES_TOGETHER + k])
    work[SUMS:] = 0.0


@compiled
def _fill_transient(
    order: Integers, run: Integers, duration: Floats, moving: Bools, rate: float, travel: Floats
) -> None:
    """Increments of dx/dt = −rate·x in every run that begins with x = 1 rad/s."""
    speed, number = 0.0, -1
    for i in order:
        if run[i] != number or not moving[i]:
            speed, number = 1.0, run[i]
        if moving[i]:
            fade = np.exp(-rate * duration[i])
            travel[i] = speed * (1.0 - fade) / rate
            speed *= fade
