"""What a random torque colours is whitened, and a fast line stands out of it."""

import numpy as np
import pytest

from motor_identification.periodic.autoregression import ORDER, Autoregression, fit_autoregression
from motor_identification.recording import Floats

RANDOM = np.random.default_rng(7)
SHUFFLED = RANDOM.permutation(4000)


def coloured(number: int, pole: float) -> Floats:
    """A first-order lag's answer to white noise."""
    white, out = RANDOM.standard_normal(number), np.zeros(number)
    for i in range(1, number):
        out[i] = pole * out[i - 1] + white[i]
    return out


def test_a_slow_torque_is_whitened_with_its_power_kept() -> None:
    slow = coloured(4000, 0.95)
    residuals = np.empty(4000)
    residuals[SHUFFLED] = slow  # intervals are not in the order of time
    white = fit_autoregression(residuals, SHUFFLED).whiten(residuals)
    assert np.sqrt(np.mean(white**2)) == pytest.approx(np.sqrt(np.mean(residuals**2)), rel=1e-6)
    ordered = white[SHUFFLED]
    assert abs(np.mean(ordered[1:] * ordered[:-1]) / np.mean(ordered**2)) < 0.05
    assert np.mean(slow[1:] * slow[:-1]) / np.mean(slow**2) > 0.9


def test_a_fast_line_stands_out_of_it() -> None:
    line = np.sin(2.1 * np.arange(4000.0))
    residuals, order = coloured(4000, 0.98) + 0.5 * line, np.arange(4000)

    def share(found: Autoregression) -> float:  # of the power, along the line
        white, along = found.whiten(residuals), found.whiten(line)
        return float((white @ along) ** 2 / (along @ along) / (white @ white))

    nothing = Autoregression(order, np.zeros(0), 1.0)
    assert share(fit_autoregression(residuals, order)) > 5.0 * share(nothing)


def test_products_with_what_is_white_by_the_transpose() -> None:
    found = fit_autoregression(coloured(4000, 0.9), SHUFFLED)
    one, other = RANDOM.standard_normal((2, 4000))
    assert found.whiten(one) @ other == pytest.approx(one @ found.whiten_adjoint(other), rel=1e-9)


@pytest.mark.parametrize("residuals", [np.zeros(400), np.ones(10 * ORDER - 1)])
def test_nothing_to_learn_from_leaves_residuals_alone(residuals: Floats) -> None:
    found = fit_autoregression(residuals, np.arange(len(residuals)))
    assert np.array_equal(found.whiten(residuals), residuals)
