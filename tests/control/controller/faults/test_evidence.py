"""What faults are told by."""

import pytest

from motor_control.controller.faults.evidence import Config, Seen, find_allowed_voltage
from motor_control.controller.motion import Motion
from motor_model.errors import MotorError
from motor_model.sample import Sample


@pytest.mark.parametrize(("voltage", "full"), [(11.8, True), (-11.8, True), (11.7, False), (0.0, False)])
def test_full_is_all_that_the_motor_may_get(voltage: float, full: bool) -> None:
    assert Seen(Sample(0, 0.0, voltage), 0.0, Motion(), 0.0, 0.005, 12.0).full == full


@pytest.mark.parametrize(("supply", "voltage", "full"), [(5.0, 4.7, True), (5.0, 4.6, False), (14.0, 11.7, False)])
def test_all_that_a_measured_supply_gives_is_full_too(supply: float, voltage: float, full: bool) -> None:
    """A motor of 12 V on a battery of 5 V never got 12 V, and with a lost encoder ran on for ever."""
    sample = Sample(0, 0.0, voltage, supply_voltage=supply)
    assert Seen(sample, 0.0, Motion(), 0.0, 0.005, 12.0).full == full


@pytest.mark.parametrize(
    ("supply", "voltage", "full"),
    [(0.05, 1.0, False), (0.05, 11.8, True), (5.0, 5.4, True), (5.0, 5.6, False), (0.0, 1.0, False)],
)
def test_a_supply_below_what_the_motor_gets_is_not_believed(supply: float, voltage: float, full: bool) -> None:
    """A loose divider read 0.05 V: 1 V that held a shaft at a reference of 0 was all it may get, and a stall."""
    sample = Sample(0, 0.0, voltage, supply_voltage=supply)
    assert Seen(sample, 0.0, Motion(), 0.0, 0.005, 12.0).full == full


@pytest.mark.parametrize(("voltage", "allowed"), [(5.0, 4.5), (-5.0, 7.5), (0.0, 4.5)])
@pytest.mark.parametrize("way", [1, -1])
def test_a_load_that_has_helped_a_motion_is_against_one_the_other_way(voltage: float, allowed: float, way: int) -> None:
    """0.75 of the 2 V that a steady motion took, and a quarter of 12 V for a load, or twice that."""
    motion = Motion(steady_speed=10.0, steady_voltage=2.0, steady_way=way)
    assert find_allowed_voltage(Config(), motion, 12.0, way * voltage) == pytest.approx(allowed)
    model = Config(kv=0.06, friction=0.5)
    assert find_allowed_voltage(model, motion, 12.0, 5.0) == find_allowed_voltage(model, motion, 12.0, -5.0)


def test_a_time_is_not_negative() -> None:
    with pytest.raises(MotorError):
        Config(stall_time=-1.0)
