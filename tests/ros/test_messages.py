"""What comes over a topic is checked where it becomes a plain value."""

import pytest

from motor_model.errors import MotorError
from motor_model.sample import Info
from motor_ros.messages import info_message, info_of, time_message


def test_an_info_comes_back() -> None:
    for info in (Info(name="wheel"), Info(source="import", voltage_assumed=True, rows_said=True, speed_said=True)):
        assert info_of(info_message(info, time_message(5))) == info


@pytest.mark.parametrize(
    ("name", "value"),
    [("sample_period", 1e-9), ("sample_period", float("nan")), ("max_voltage", 1e300), ("edge_resolution", -1.0)],
)
def test_a_plant_that_cannot_be_is_refused(name: str, value: float) -> None:
    """A sample period of a nanosecond took 24 GB of `experiment`."""
    message = info_message(Info(), time_message(0))
    setattr(message, name, value)
    with pytest.raises(MotorError, match=f"^motor/info says {name} "):
        info_of(message)


def test_a_name_steers_no_terminal() -> None:
    message = info_message(Info(), time_message(0))
    message.name = "\x1b[2Jwheel"
    assert info_of(message).name == r"\x1b[2Jwheel"
