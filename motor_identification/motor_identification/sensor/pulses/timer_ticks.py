"""Recognise speeds over a timer's whole ticks: each is one angle over a number of ticks, which no other sensor makes.

The reciprocals of such speeds lie on a lattice, whose step is a tick over the angle. Of the slowest motions printed
digits hide it, and of the fastest there are too few numbers of ticks: so it is looked for among some fast ones. Means
of a few such speeds that are nearly alike lie on one, too, finer by as many times.
"""

from functools import lru_cache
from math import inf

import numpy as np

from motor_identification.recording import Floats
from motor_identification.sensor.value_lattice import find_lattice

FASTEST = 0.99  # quantile of the speeds, from which on some may be false
SLOWER = (1.5, 2.5, 5.0, 12.0)  # times slower than that: a motor that hardly changes its speed, and one that stops
FEWEST_SPEEDS = 40  # different ones
MOST_TICKS = 20_000.0  # of the slowest that is looked at
MOST_SLOTS, SAME = 4, 1e-3  # of which a mean may be; share of it, by which an angle may be off
# [s] of what programs and timers count in: microseconds, the four of an Arduino's clock, timers of 16 and 2 MHz behind
# their dividers, the tens and hundreds that some divide by, and milliseconds.
TICKS = (62.5e-9, 0.5e-6, 1e-6, 4e-6, 8e-6, 10e-6, 16e-6, 64e-6, 100e-6, 1e-3)


def find_speed_of_a_tick(speed: Floats) -> float:
    """Find the speed [rad/s] of one tick, of which all speeds (K,) are whole parts; 0 where they are none."""
    size = np.abs(speed)
    moving = size[size > 0.0]
    return _find(np.unique(moving).tobytes(), float(np.quantile(moving, FASTEST))) if len(moving) else 0.0


@lru_cache(maxsize=16)  # a recording's sensor is looked at again and again
def _find(levels: bytes, top: float) -> float:
    different = np.frombuffer(levels)
    before = 0
    for slower in SLOWER:
        some = different[(different >= top / slower) & (different <= top)]
        if len(some) < FEWEST_SPEEDS or len(some) == before:
            continue
        before = len(some)
        step = find_lattice(1.0 / some, MOST_TICKS)
        if step > 0.0:
            return 1.0 / step
    return 0.0


def are_over_slots(speed: Floats, slot: float) -> bool:
    """Decide whether speeds (K,) are over whole ticks of a timer, as there are, for one slot or a few of them each.

    slot: [rad], or whatever the speeds are in times a second.
    """
    slots = np.array([found / slot for found in list_slots(speed)])
    numbers = np.rint(slots)
    return bool(np.any((np.abs(slots - numbers) < SAME * numbers) & (numbers <= MOST_SLOTS)))


def list_slots(speed: Floats, longest: float = inf) -> tuple[float, ...]:
    """List the slots [rad] that such speeds (K,) may be over, by ticks as there are; empty where they are none."""
    tick_speed = find_speed_of_a_tick(speed)
    return tuple(slot for tick in TICKS if 0.0 < (slot := tick_speed * tick) <= longest)
