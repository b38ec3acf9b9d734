"""The gain of a run is a nuisance with a prior: its likelihood is that of a covariance with one more rank."""

import numpy as np
import pytest

from motor_identification.noise.run_gain import (
    RunGain,
    estimate_scatter,
    goes_smoothly,
    guess_deviation,
    make_projection,
    move_to_likeliest,
)

RANDOM = np.random.default_rng(0)
RESPONSE, WHITE = RANDOM.normal(size=50), RANDOM.normal(size=50)


def log_normal(residuals: np.ndarray, covariance: np.ndarray) -> float:
    """Without the constant."""
    return -0.5 * float(residuals @ np.linalg.solve(covariance, residuals) + np.linalg.slogdet(covariance)[1])


@pytest.mark.parametrize("scatter", [0.01, 0.3, 10.0])
def test_the_price_is_that_of_a_covariance_with_one_more_rank(scatter: float) -> None:
    white = WHITE + 0.5 * RESPONSE
    gain = move_to_likeliest(0.2, white - 0.2 * RESPONSE, RESPONSE, scatter)
    left = white - gain.deviation * RESPONSE
    wanted = log_normal(white, np.eye(50) + scatter**2 * np.outer(RESPONSE, RESPONSE))
    assert log_normal(left, np.eye(50)) - gain.compute_price(scatter) == pytest.approx(wanted)


def test_a_projection_whitens() -> None:
    along = make_projection(RESPONSE, 0.4)
    root = np.eye(50) - np.outer(along, along)
    assert root @ (np.eye(50) + 0.16 * np.outer(RESPONSE, RESPONSE)) @ root == pytest.approx(np.eye(50), abs=1e-12)
    assert not make_projection(np.zeros(50), 0.4).any()


def test_a_guess_is_that_of_least_squares() -> None:
    assert guess_deviation(0.03 * RESPONSE, RESPONSE) == pytest.approx(0.03)
    assert guess_deviation(WHITE, 0.0 * RESPONSE) == 0.0


def test_gains_that_nothing_is_known_of_scatter_as_assumed() -> None:
    assert estimate_scatter([RunGain(0.0, 0.0)] * 5, 0.02) == pytest.approx(0.02)
    assert estimate_scatter([RunGain(0.03, 1e12), RunGain(-0.01, 1e12)], 0.5) == pytest.approx(np.sqrt(5e-4))


def test_values_on_a_line_go_smoothly_and_others_do_in_one_case_of_a_hundred() -> None:
    random = np.random.default_rng(0)
    for count in (5, 8, 15):
        smooth = [goes_smoothly(random.standard_normal(count)) for _ in range(2000)]
        assert 0.0 <= np.mean(smooth) < 0.015
        line = np.linspace(-1.0, 1.0, count) + 0.05 * random.standard_normal(count)
        assert goes_smoothly(line) is (count > 5)  # of which not even a line is less than chance
    assert not goes_smoothly(np.zeros(8))
