"""Runs that begin with a motor that stands."""

import numpy as np
import pytest

from motor_identification.logs.columns.behaviour.standing_start import begins_at_rest, can_have_stood, rise_alike

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


@pytest.mark.parametrize(
    ("begin", "early", "alike"),
    [
        (0.0, 0.01, True),
        (0.6, 0.01, True),  # counts are coarse, and one run has more of them than another
        (1.0, 0.01, False),  # it turned already, at the voltage that it has
        (1.0, 0.005, False),
        (1.0, 0.02, True),  # it may have come so far by then
    ],
)
def test_runs_that_begin_alike(begin: float, early: float, alike: bool) -> None:
    rising = 20.0 * (1.0 - np.exp(-TIME / 0.2))
    other = -12.0 * (1.0 - (1.0 - begin) * np.exp(-TIME / 0.2))
    assert rise_alike([0.01, early], [rising, other]) == alike
    assert rise_alike([0.01, early], [rising, 0.1 * other])  # too slow to tell
    assert rise_alike([0.01, early], [rising, other[:12]])  # too short
    stamps = np.concatenate((TIME + 0.01, TIME + early))
    speeds = np.concatenate((rising, other))
    volts = np.repeat([5.0, -3.0], len(TIME))
    assert begins_at_rest(stamps, volts, speeds, is_speed=True) == alike
