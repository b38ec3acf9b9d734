"""A measured motion for the tests of what repeats with the angle."""

import numpy as np

from motor_identification.noise.error_model import Lag
from motor_identification.periodic.linear_response import Course

LAG = Lag(12.5, 0.0055)


def course(intervals: int, seed: int = 0) -> Course:
    """Even turns in intervals that follow each other, forth and then back, with a standstill in between."""
    random = np.random.default_rng(seed)
    duration = random.uniform(0.5e-3, 20e-3, intervals)
    speed = np.where(np.arange(intervals) < intervals // 2, 1.0, -1.0) * random.uniform(5.0, 150.0, intervals)
    moving = np.ones(intervals, dtype=bool)
    moving[intervals // 2] = False
    angle = 300.0 + np.concatenate([[0.0], np.cumsum(speed * duration)])
    run = (np.arange(intervals) >= intervals // 2).astype(np.int64)
    return Course(np.arange(intervals), run, angle[:-1], angle[1:], duration, moving, LAG)
