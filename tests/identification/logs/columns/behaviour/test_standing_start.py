"""Runs that begin with a motor that stands."""

import numpy as np
import pytest

from motor_identification.logs.columns.behaviour.standing_start import can_have_stood

TIME = np.arange(300) * 0.01
SPEED = 20.0 * (1.0 - np.exp(-np.mod(TIME, 1.5) / 0.2)) * np.where(TIME < 1.5, 1.0, -0.6)


@pytest.mark.parametrize(
    ("begin", "voltage", "stood"),
    [
        (0.0, 5.0, True),
        (4.0, 5.0, True),  # within the first row
        (-19.0, 5.0, False),  # it still turned the other way
        (-4.0, 5.0, True),  # noise
        (-9.0, 5.0, False),
        (40.0, 5.0, False),  # it came from a higher voltage
        (0.0, -5.0, True),
    ],
)
def test_a_motor_that_stood(begin: float, voltage: float, stood: bool) -> None:
    way = np.sign(voltage)
    speed = way * 20.0 + (way * begin - way * 20.0) * np.exp(-TIME / 0.2)
    assert can_have_stood(speed, voltage) == stood
    assert can_have_stood(speed[:5], voltage)  # too short to tell


def test_a_run_at_no_voltage() -> None:
    assert can_have_stood(np.zeros(50), 0.0) and not can_have_stood(20.0 * np.exp(-TIME / 0.2), 0.0)
