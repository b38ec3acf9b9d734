"""What faults are told by."""

import pytest

from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.motion import Motion
from motor_model.errors import MotorError
from motor_model.sample import Sample


@pytest.mark.parametrize(("voltage", "full"), [(11.8, True), (-11.8, True), (11.7, False), (0.0, False)])
def test_full_is_all_that_the_motor_may_get(voltage: float, full: bool) -> None:
    assert Seen(Sample(0, 0.0, voltage), 0.0, Motion(), 0.0, 0.005, 12.0).full == full


def test_a_time_is_not_negative() -> None:
    with pytest.raises(MotorError):
        Config(stall_time=-1.0)
