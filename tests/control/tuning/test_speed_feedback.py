"""The encoder: its slots, its noise, and what is refused."""

from math import nan, sqrt, tau

import numpy as np
import pytest
from tuning_bench import BARE

from motor_control.tuning.speed_feedback import Encoder, cancelling
from motor_model.errors import MotorError


def test_an_edges_noise_is_the_discs_and_the_timers() -> None:
    encoder = Encoder(edges_per_revolution=48, slot_irregularity=0.01, edge_resolution=1e-4)
    assert encoder.slot == pytest.approx(tau / 48)
    rounding = np.random.default_rng(1).uniform(-0.5e-4, 0.5e-4, 100_000) * 80.0
    assert encoder.edge_noise(80.0) == pytest.approx(sqrt((0.01 * tau / 48) ** 2 + np.var(rounding)), rel=0.01)
    assert encoder.edge_noise(0.0) == pytest.approx(0.01 * tau / 48)


def test_gains_cancel_the_motors_pole() -> None:
    gains = cancelling(BARE, 0.3)
    assert gains.kp == 0.3 and gains.ki / gains.kp == pytest.approx(BARE.kv / BARE.ka)


@pytest.mark.parametrize(
    "changes", [{"edges_per_revolution": 0}, {"slot_irregularity": -0.1}, {"edge_resolution": nan}]
)
def test_nonsense_is_refused(changes: dict[str, float]) -> None:
    with pytest.raises(MotorError, match=next(iter(changes))):
        Encoder(**changes)  # type: ignore[arg-type]
