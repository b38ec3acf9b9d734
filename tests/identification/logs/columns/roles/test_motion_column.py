"""Which column is the motion."""

from pathlib import Path

import numpy as np
import pytest
from log_columns import DRIVE, FOLLOWS, MOVED, TIME, columns, table

from motor_identification.logs.columns.roles.roles import find_roles
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.csv.table import Table
from motor_model.errors import RecordingError


def test_what_was_counted_comes_before_what_was_computed() -> None:
    assert find_roles(table(t="t", speed="y", ticks="y", angle="y", pwm="u"), Said()).pairs[0].motion == "ticks"
    assert find_roles(table(t="t", speed="y", angle="y", pwm="u"), Said()).pairs[0].motion == "angle"
    assert find_roles(table(t="t", speed="y", angle="y", pwm="u"), Said(motion="speed")).pairs[0].motion == "speed"


def test_a_filtered_motion_comes_after_the_one_it_was_made_of() -> None:
    assert find_roles(table(t="t", pwm="u", rpm="y", rpm_filtered="y"), Said()).pairs[0].motion == "rpm"
    assert find_roles(table(t="t", pwm="u", speed_filt="y", speed_raw="y"), Said()).pairs[0].motion == "speed_raw"
    assert find_roles(table(t="t", pwm="u", speed_filt="y"), Said()).pairs[0].motion == "speed_filt"
    with pytest.raises(RecordingError, match="speed_a, speed_b"):
        find_roles(table(t="t", pwm="u", speed_a="y", speed_b="y", speed_avg="y"), Said())


def test_what_is_called_measured_is_the_motion() -> None:
    loop = find_roles(table(t="t", ref="r", meas="y", u="u", e="r", P="r", D="y"), Said())
    assert loop.pairs == (Pair("", "u", "meas"),)
    with pytest.raises(RecordingError, match="which column is the motion"):
        find_roles(table(t="t", meas_a="y", meas_b="y", u="u"), Said())


def test_the_unit_that_is_said_picks_its_column() -> None:
    columns = {"t": "t", "angle": "y", "omega": "y", "u": "u"}
    for unit, motion in (("rpm", "omega"), ("rad/s", "omega"), ("deg", "angle"), (None, "angle")):
        assert find_roles(table(**columns), Said(unit=unit)).pairs[0].motion == motion
    both = {"t": "t", "angleL": "y", "velL": "y", "angleR": "y", "velR": "y", "u": "u"}
    assert {pair.motion for pair in find_roles(table(**both), Said(unit="rpm")).pairs} == {"velL", "velR"}


def test_what_is_raw_comes_before_what_was_made_of_it() -> None:
    named = find_roles(columns(t=TIME, pwm=DRIVE, **{"VEL": FOLLOWS, "RAW VEL": 1.1 * FOLLOWS}), Said())
    assert named.pairs[0].motion == "RAW VEL"


def test_a_speed_in_two_units_is_one_motion() -> None:
    rounded = np.rint(MOVED * 60.0 / (2.0 * np.pi))
    cells = {"t": TIME, "u": DRIVE, "pps": MOVED * 1303.8, "speed rpm": rounded, "omega [rad/s]": MOVED}
    both = Table(Path("log.csv"), np.arange(2, 202), cells)
    assert find_roles(both, Said()).pairs == (Pair("", "u", "speed rpm"),)
    for other in (
        MOVED + np.random.default_rng(0).normal(0.0, 0.1 * np.std(MOVED), 200),
        MOVED[::-1],
    ):  # another motor's
        apart = Table(Path("log.csv"), np.arange(2, 202), {**cells, "omega [rad/s]": other})
        with pytest.raises(RecordingError, match="which column is the speed"):
            find_roles(apart, Said())
    twins = {"t": TIME, "u": DRIVE, "speed a [rpm]": MOVED, "speed b [rpm]": MOVED}  # two wheels of one unit
    with pytest.raises(RecordingError, match="which column is the speed"):
        find_roles(Table(Path("log.csv"), np.arange(2, 202), twins), Said())


def test_counts_and_those_of_each_row_are_one_motors_position() -> None:
    each = np.floor(3.0 + 4.0 * np.sin(TIME))
    counts = {"Delta (u) count": each, "Position (x) count": np.cumsum(each)}
    assert find_roles(columns(t=TIME, pwm=DRIVE, **counts), Said()).pairs[0].motion == "Position (x) count"


def test_a_signal_that_is_listed_twice_is_one() -> None:
    twice = find_roles(table(t="t", u="u", **{"pos [deg]": "y", "pos [deg] #4": "y"}), Said())
    assert twice.pairs == (Pair("", "u", "pos [deg]"),)
    with pytest.raises(RecordingError, match="--position and one of"):
        find_roles(table(t="t", u="u", **{"pos [deg]": "y", "pos [deg] #4": "n"}), Said())


def test_y_is_what_u_drives() -> None:
    assert find_roles(table(t="t", u="u", x="n", y="y"), Said()).pairs == (Pair("", "u", "y"),)
    with pytest.raises(RecordingError, match="--speed, --position or --count and one of x, y"):
        find_roles(table(t="t", pwm="u", x="n", y="y"), Said())


def test_of_several_speeds_the_one_with_a_unit_is_taken() -> None:
    vesc = find_roles(table(ms="t", duty_cycle="u", erpm="y", tachometer="n"), Said())
    assert vesc.pairs == (Pair("", "duty_cycle", "erpm"),)
    with pytest.raises(RecordingError, match="the speed\\? Say --speed and one of rpm_a, rpm_b"):
        find_roles(table(t="t", u="u", rpm_a="y", rpm_b="n"), Said())


def test_a_pendulum_is_what_the_motor_moves() -> None:
    """An angle comes before a speed, but for one of another body than the motor's shaft."""
    pendulum = "Pendulum angle [rad]"
    given = table(t="t", u="u", **{"Motor velocity [rad/s]": "y", pendulum: "n"})
    assert find_roles(given, Said()).pairs == (Pair("", "u", "Motor velocity [rad/s]"),)
    assert find_roles(table(t="t", u="u", **{pendulum: "n"}), Said()).pairs == (Pair("", "u", pendulum),)
    furuta = table(t="t", PWM="u", pendAngleZeroUp="n", pendAngleZeroDwn="n", baseAngle="y")
    assert find_roles(furuta, Said()).pairs == (Pair("", "PWM", "baseAngle"),)
    angles = table(t="t", u="u", **{"arm angle [rad]": "y", pendulum: "n"})
    assert find_roles(angles, Said()).pairs == (Pair("", "u", "arm angle [rad]"),)


@pytest.mark.parametrize(("angle", "slide"), [("phi", "z"), ("theta", "x"), ("θ", "s")])
def test_a_carts_place_may_be_meant_beside_an_angle(angle: str, slide: str) -> None:
    """Of a cart with a pendulum the angle was taken, as the place has no telling name."""
    asked = f"which column is the position\\? Say --position and one of {angle}, {slide}"
    with pytest.raises(RecordingError, match=asked):
        find_roles(table(t="t", v="u", **{slide: "y", angle: "n"}), Said())
    said = find_roles(table(t="t", v="u", **{slide: "y", angle: "n"}), Said(motion=slide))
    assert said.pairs == (Pair("", "v", slide),)
    pose = table(t="t", v="u", x="n", z="n", **{angle: "y"})
    assert find_roles(pose, Said()).pairs == (Pair("", "v", angle),)
    assert find_roles(table(t="t", v="u", x="t", **{angle: "y"}), Said()).pairs == (Pair("", "v", angle),), "a clock"
    assert find_roles(table(t="t", v="u", **{f"motor {angle}": "y", slide: "n"}), Said()).pairs[0].motion != slide


def test_a_models_speed_beside_the_measured_one_is_asked_for() -> None:
    """`Wr` is real and `Wm` a model's; only one of them is a word for a speed."""
    with pytest.raises(RecordingError, match="which column is the speed. Say --speed and one of Wm, Wr"):
        find_roles(columns(t=TIME, u=DRIVE, Wr=FOLLOWS, Wm=1.1 * FOLLOWS), Said())
    for others in ({"Wr": DRIVE[::-1].copy()}, {"x": FOLLOWS}):
        assert find_roles(columns(t=TIME, u=DRIVE, Wm=FOLLOWS, **others), Said()).pairs[0].motion == "Wm"
