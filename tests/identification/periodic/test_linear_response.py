"""What a load that repeats with the angle does to a motor's speed and travel."""

import numpy as np
import pytest
from periodic_course import LAG, course
from scipy.integrate import solve_ivp


def slope(t: float, x: list[float], begin: float, turn: float, cycles: float, phase: float) -> list[float]:
    """Speed and travel of a motor under a load sin(cycles·θ + phase), while the shaft turns evenly."""
    return [-LAG.rate * x[0] - np.sin(cycles * (begin + turn * t) + phase) / LAG.ka, x[0]]


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
            if seen.gap[i] > 0.0:  # it turns on, and no travel of it counts
                before = seen.end[i - 1]
                load = (before, (seen.start[i] - before) / seen.gap[i], cycles, phase)
                gap = solve_ivp(slope, (0.0, seen.gap[i]), [speed, 0.0], "DOP853", args=load, rtol=1e-10, atol=1e-14)
                speed = gap.y[0, -1]
            duration, begin = seen.duration[i], seen.start[i]
            load = (begin, (seen.end[i] - begin) / duration, cycles, phase)
            end = solve_ivp(slope, (0.0, duration), [speed, 0.0], "DOP853", args=load, rtol=1e-10, atol=1e-14)
            speed, travel = end.y[:, -1]
            assert abs(travels[i] - travel) < 1e-9 + 1e-7 * abs(travel)


def test_a_speed_at_the_beginning_fades_in_every_run() -> None:
    seen = course(40)
    travel = seen.transient()
    for number in (0, 1):
        here = (seen.run == number) & seen.moving
        begins = np.concatenate([[0.0], np.cumsum(seen.duration[here])[:-1]]) + np.cumsum(seen.gap[here])
        expected = np.exp(-LAG.rate * begins) * (1.0 - np.exp(-LAG.rate * seen.duration[here])) / LAG.rate
        assert np.allclose(travel[here], expected, rtol=1e-12)
    assert travel[~seen.moving].sum() == 0.0
