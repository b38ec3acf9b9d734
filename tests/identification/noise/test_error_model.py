"""What a random torque leaves in mean speeds is a closed form."""

import numpy as np
import pytest

from motor_identification.noise.error_model import ErrorModel, Lag

KV, KA = 0.07, 0.0055
RATE = KV / KA
LAG = Lag(RATE, KA)


@pytest.mark.parametrize("duration", [1e-4, 0.02, 1.0, 30.0])
def test_what_a_torque_leaves_in_a_mean_speed(duration: float) -> None:
    """Against a double sum of the autocovariance over the interval."""
    model = ErrorModel(0.0, 0.0, 0.15, 0.05)
    beta = 1.0 / model.correlation_time
    at = (np.arange(3000) + 0.5) * duration / 3000
    apart = np.abs(at[:, None] - at[None, :])
    covariance = (np.exp(-beta * apart) - beta / RATE * np.exp(-RATE * apart)) * (0.15 / KA) ** 2 / (RATE**2 - beta**2)
    exact = float(covariance.mean())
    assert model.speed_variance(np.array([duration]), LAG)[0] == pytest.approx(exact, rel=2e-3)


def test_equal_rates_are_no_pole() -> None:
    near, at = (ErrorModel(0.0, 0.0, 0.15, 1.0 / rate) for rate in (1.01 * RATE, RATE))
    values = [model.speed_variance(np.array([0.1]), LAG)[0] for model in (near, at)]
    assert values[0] == pytest.approx(values[1], rel=0.02)
