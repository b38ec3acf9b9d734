"""A measured motion for the tests of what repeats with the angle."""

import numpy as np

from motor_identification.noise.error_model import Lag
from motor_identification.periodic.linear_response import Course

LAG = Lag(12.5, 0.0055)


def course(intervals: int, seed: int = 0) -> Course:
    """Even turns in intervals, forth and then back, with a standstill in between and gaps after every tenth."""
    random = np.random.default_rng(seed)
    duration = random.uniform(0.5e-3, 20e-3, intervals)
    speed = np.where(np.arange(intervals) < intervals // 2, 1.0, -1.0) * random.uniform(5.0, 150.0, intervals)
    moving = np.ones(intervals, dtype=bool)
    moving[intervals // 2] = False
    run = (np.arange(intervals) >= intervals // 2).astype(np.int64)
    number = np.arange(intervals)
    gap = np.where((number % 10 == 9) & (number != intervals // 2), random.uniform(1e-3, 10e-3, intervals), 0.0)
    start = 300.0 + np.cumsum(speed * gap) + np.concatenate([[0.0], np.cumsum(speed * duration)[:-1]])
    return Course(number, run, start, start + speed * duration, duration, gap, moving, LAG)
