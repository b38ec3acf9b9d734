"""The speeds at which a loop is looked at follow the motor and its encoder."""

import pytest

from motor_control.tuning.design import Wish, tune
from motor_control.tuning.speed_feedback import Encoder
from motor_control.tuning.speed_range import choose_speeds, default_lowest_speed
from motor_model.errors import MotorError
from motor_model.parameters import Parameters, paper_motor


def motor(top: float, voltage: float = 12.0, lag: float = 0.08) -> Parameters:
    return Parameters({"kv": voltage / top, "ka": voltage / top * lag}, max_voltage=voltage)


@pytest.mark.parametrize("voltage", [1.2, 12.0, 48.0])
@pytest.mark.parametrize("top", [6.0, 174.0, 600.0])
def test_the_lowest_speed_is_a_share_of_the_top_speed(top: float, voltage: float) -> None:
    fine = Encoder(edges_per_revolution=4000)
    assert default_lowest_speed(motor(top, voltage), fine) == pytest.approx(0.06 * top)


@pytest.mark.parametrize(("edges", "lowest"), [(360, 0.36), (340, 0.3696), (96, 1.309), (4, 5.4)])
def test_and_no_slower_than_the_encoder_reports(edges: int, lowest: float) -> None:
    """0.36 rad/s have 20 edges a second at 349 edges a turn; 4 have them nowhere, and the top speed is looked at."""
    assert default_lowest_speed(motor(6.0), Encoder(edges_per_revolution=edges)) == pytest.approx(lowest, rel=1e-3)


def test_gains_scale_with_the_motor() -> None:
    """The same motor in other volts and radians, with an encoder that is as much finer: the same loop."""
    usual, slow = tune(motor(174.0), Encoder(), Wish()), tune(motor(5.8, 1.2), Encoder(96 * 30), Wish())
    assert slow.lowest_speed == pytest.approx(usual.lowest_speed / 30.0)
    assert slow.gains.kp / usual.gains.kp == pytest.approx(0.1 * 30.0, rel=0.02)
    assert slow.time_constant == pytest.approx(usual.time_constant, rel=0.02)


def test_two_speeds_a_decade_lie_between() -> None:
    assert choose_speeds(paper_motor(), 10.0) == pytest.approx((10.0, 30.0, 100.0, 156.67), rel=1e-3)
    assert choose_speeds(motor(0.06), 0.0036) == pytest.approx((0.0036, 0.01, 0.03, 0.054))
    assert choose_speeds(motor(6.0), 5.4) == (pytest.approx(5.4),)


@pytest.mark.parametrize("lowest", [0.0, -1.0, 5.41, float("nan")])
def test_a_lowest_speed_that_is_none(lowest: float) -> None:
    with pytest.raises(
        MotorError, match=r"The lowest speed is .*: give one above 0 and below 5.4 rad/s, 90% of what 12"
    ):
        choose_speeds(motor(6.0), lowest)
