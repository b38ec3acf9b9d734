"""What a load that repeats with the angle does to a motor's speed, and how fast a spectrum of it is had."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from motor_identification.periodic.linear_response import CYCLES_TOGETHER, Course

RATE, INERTIA = 12.5, 0.0055


def course(intervals: int, seed: int = 0) -> Course:
    """Even turns in intervals that follow each other, forth and then back, with a standstill in between."""
    random = np.random.default_rng(seed)
    duration = random.uniform(0.5e-3, 20e-3, intervals)
    speed = np.where(np.arange(intervals) < intervals // 2, 1.0, -1.0) * random.uniform(5.0, 150.0, intervals)
    moving = np.ones(intervals, dtype=bool)
    moving[intervals // 2] = False
    angle = 300.0 + np.concatenate([[0.0], np.cumsum(speed * duration)])
    run = (np.arange(intervals) >= intervals // 2).astype(np.int64)
    return Course(np.arange(intervals), run, angle[:-1], angle[1:], duration, moving, RATE, INERTIA)


def slope(t: float, x: list[float], begin: float, turn: float, cycles: float, phase: float) -> list[float]:
    """Speed and travel of a motor under a load sin(cycles·θ + phase), while the shaft turns evenly."""
    return [-RATE * x[0] - np.sin(cycles * (begin + turn * t) + phase) / INERTIA, x[0]]


@pytest.mark.parametrize("cycles", [0.0, 1.0, 7.3, 48.0])
def test_a_load_makes_the_travel_that_the_differential_equation_says(cycles: float) -> None:
    seen = course(12)
    for phase, travels in zip((0.0, np.pi / 2.0), seen.response(cycles), strict=True):  # sine, cosine
        speed = 0.0
        for i, moving in enumerate(seen.moving):
            if not moving:
                speed = 0.0
                assert travels[i] == 0.0
                continue
            duration, begin = seen.duration[i], seen.start[i]
            load = (begin, (seen.end[i] - begin) / duration, cycles, phase)
            end = solve_ivp(slope, (0.0, duration), [speed, 0.0], "DOP853", args=load, rtol=1e-10, atol=1e-14)
            speed, travel = end.y[:, -1]
            assert abs(travels[i] - travel) < 1e-9 + 1e-7 * abs(travel)


def test_a_spectrum_is_the_products_with_every_response() -> None:
    seen, random = course(400, 1), np.random.default_rng(2)
    cycles = np.arange(1.0, 5.0, 1.0 / 32.0)[: 2 * CYCLES_TOGETHER + 5]
    pull, block = random.normal(size=400), random.integers(0, 6, 400)
    along, across = (np.concatenate(parts) for parts in zip(*seen.products(pull, cycles, block), strict=True))
    assert along.shape == across.shape == (len(cycles), 6)
    for i, number in enumerate(cycles):
        for found, response in zip((along[i], across[i]), seen.response(float(number)), strict=True):
            expected = np.bincount(block, pull * response, 6)
            assert np.abs(found - expected).max() < 1e-10 * np.abs(expected).max() + 1e-15


def test_a_speed_at_the_beginning_fades_in_every_run() -> None:
    seen = course(40)
    travel = seen.transient()
    for number in (0, 1):
        here = (seen.run == number) & seen.moving
        begins = np.concatenate([[0.0], np.cumsum(seen.duration[here])[:-1]])
        expected = np.exp(-RATE * begins) * (1.0 - np.exp(-RATE * seen.duration[here])) / RATE
        assert np.allclose(travel[here], expected, rtol=1e-12)
    assert travel[~seen.moving].sum() == 0.0
