"""Lay the even clock of a sensor through frames of positions that a loop saw later and later, and missed now and then.

Where a robot's loop asks a controller that answers every 20 ms by a clock of its own, each answer is seen a little
later than the one before, until one is missed, and the way of two comes in one. At the times at which rows show them
the motor would be twice as fast there. Ways tell how many frames they took; counted so, frames lie on the controller's
clock, and so do the positions.
"""

from typing import NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from motor_identification.recording import Floats, Integers
from motor_identification.sensor.parabola_scatter import WINDOW, measure_scatter
from motor_identification.sensor.slipping_frames import AROUND

MOST_FRAMES, NEAR = 3, 0.3  # in one way, and how far it may be from as many usual ones
FAST = 0.1  # of the way in a frame that nine of ten do not exceed: slower, a motor that starts goes many times its way
SMOOTHER = 0.64  # times the squares of what any other times of the frames leave of the positions beside parabolas


class OwnClock(NamedTuple):
    """Frames by a sensor's own clock."""

    row: Integers  # that shows each frame first, shape (F,)
    made: Floats  # [s] even, shape (F,)
    number: Floats  # of each frame, shape (F,)
    period: float  # [s]


def lay_own_clock(time: Floats, positions: Floats, changed: Integers, guess: float, even: Floats) -> OwnClock | None:
    """Lay a clock through frames counted by their ways; None where positions lie as well on other times of them.

    Args:
        time: [s] of the rows, shape (K,).
        positions: of the same shape.
        changed: rows whose position differs from that before, shape (F,).
        guess: [s] about a frame.
        even: [s] times (F,) of the changes on an even grid, where they lie on one; else empty.
    """
    seen, gaps, way = time[changed], np.diff(time[changed]), np.diff(positions[changed])
    if len(way) < 2 * WINDOW:
        return None
    frames = np.maximum(np.rint(gaps / guess), 1.0)
    short = frames <= MOST_FRAMES
    if not short.any():
        return None
    around = sliding_window_view(np.pad(way / frames, AROUND // 2, mode="edge"), AROUND)
    usual = np.median(around, axis=1)
    took = np.divide(way, usual, out=np.zeros(len(way)), where=usual != 0.0)
    whole = np.rint(took)
    fast = np.abs(usual) >= FAST * np.quantile(np.abs(usual), 0.9)
    told = short & fast & (whole >= 1.0) & (whole <= MOST_FRAMES) & (np.abs(took - whole) < NEAR)
    frames[told] = whole[told]
    frames[~short] = np.rint(gaps[~short] * np.sum(frames[short]) / np.sum(gaps[short]))  # the motor stood
    number = np.append(0.0, frames.cumsum())
    period, begin = np.polyfit(number, seen, 1)
    made = begin + period * number
    if not period > 0.0 or np.max(np.abs(seen - made)) > MOST_FRAMES * period:
        return None
    others = [one for one in (seen, even) if len(one)]
    own, *left = (float(np.mean(measure_scatter(clock, positions[changed]))) for clock in (made, *others))
    if own >= SMOOTHER * min(left):
        return None
    inside = (made >= time[0]) & (made <= time[-1])
    return OwnClock(changed[inside], made[inside], number[inside], float(period))
