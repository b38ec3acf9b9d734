"""Sum the products of a residual with the linear responses to many evenly spaced numbers of cycles, in one pass.

What a spectrum over the angle is made of: from one number of cycles to the next, the phasor of every angle turns by the
same angle, so that none is computed twice.
"""

from collections.abc import Iterator

import numpy as np

from motor_identification.periodic.linear_response import SMALL_TURN, Complexes, Course, pass_interval, phasor
from motor_identification.recording import Bools, Floats, Integers
from motor_model.compiled import compiled

CYCLES_TOGETHER = 32  # numbers of cycles: phasors are turned from one to the next so often before they are had anew


def sum_products(course: Course, pull: Floats, cycles: Floats, block: Integers) -> Iterator[tuple[Floats, Floats]]:
    """Sum the products of `pull` (I,) with the responses to evenly spaced `cycles` (C,) over every block (B,).

    A few numbers of cycles at a time: with sines and with cosines, (few, B) each.
    """
    width = float(cycles[1] - cycles[0]) if len(cycles) > 1 else 0.0
    blocks = int(block.max()) + 1
    for i in range(0, len(cycles), CYCLES_TOGETHER):
        sums = np.zeros((blocks, min(CYCLES_TOGETHER, len(cycles) - i)), dtype=np.complex128)
        _add_products(
            course.order, course.start, course.end, course.duration, course.gap, course.moving,
            float(cycles[i]), width, course.lag.rate, pull, block, sums,
        )  # fmt: skip
        sums /= course.lag.rate * course.lag.ka
        yield sums.imag.T, sums.real.T


@compiled
def _turn_on(work: Floats, to: int, cycles: float, width: float, angle: float) -> None:
    """Fill the row from `to` on, and the next, with cosines and sines of all cycles at an angle, by doubling."""
    first, on = phasor(cycles * angle), phasor(width * angle)
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
    """Do what `pass_interval` does for all numbers of cycles, in real numbers, and sum up."""
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
        travel, then = pass_interval(speed, here, there, (cycles + k * width) * turn, h, fade, rate)
        work[SPEED + k], work[SPEED + CYCLES_TOGETHER + k] = then.real, then.imag
        work[SUMS + k] += along * travel.real
        work[SUMS + CYCLES_TOGETHER + k] += along * travel.imag


@compiled
def _pass(
    work: Floats, cycles: float, width: float, turn: float, h: float, least: float, rate: float, along: float
) -> None:
    """Do it all at once where the shaft turns by more than `least` [rad]."""
    if abs(turn) > least:
        _pass_all(work, cycles, width, turn, h, np.exp(-rate * h), rate, along)
    else:
        _pass_each(work, cycles, width, turn, h, np.exp(-rate * h), rate, along)


@compiled
def _add_products(
    order: Integers, start: Floats, end: Floats, duration: Floats, gap: Floats, moving: Bools,
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
        if gap[i] > 0.0:  # it turns on, and no travel of it counts
            work[START:END] = work[END:SUMS]
            _turn_on(work, END, cycles, width, start[i])
            _pass(work, cycles, width, start[i] - at, gap[i], least, rate, 0.0)
            at = start[i]
        if start[i] == at:
            work[START:END] = work[END:SUMS]
        else:
            _turn_on(work, START, cycles, width, start[i])
        _turn_on(work, END, cycles, width, end[i])
        at = end[i]
        _pass(work, cycles, width, turn, h, least, rate, pull[i])
    _flush(work, sums, latest)


@compiled
def _flush(work: Floats, sums: Complexes, block: int) -> None:
    """Add the sums of a block to what it has (none before the first), and begin anew."""
    if block >= 0:
        for k in range(sums.shape[1]):
            sums[block, k] += complex(work[SUMS + k], work[SUMS + CYCLES_TOGETHER + k])
    work[SUMS:] = 0.0
