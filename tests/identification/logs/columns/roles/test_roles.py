"""Which column is which."""

import numpy as np
import pytest
from log_columns import DRIVE, FOLLOWS, KINDS, MOVED, TIME, columns, table

from motor_identification.logs.columns.drive import leave_out_idle_efforts
from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.columns.roles.roles import find_roles
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.rows.drive.constant_voltage import CONSTANT
from motor_model.errors import RecordingError


def test_by_their_names() -> None:
    roles = find_roles(table(time="t", target="r", speed="y", voltage="u", current="y"), Said())
    assert (roles.time, roles.pairs, roles.supply, roles.current) == (
        "time",
        (Pair("", "voltage", "speed"),),
        None,
        "current",
    )


def test_an_effort_that_is_zero_all_the_time_gives_way_to_what_drives() -> None:
    """Joint states have an effort, which most robots leave at zero, beside the command on another topic."""
    assert find_roles(table(t="t", velocity="y", effort="0", command="u"), Said()).pairs == (
        Pair("", "command", "velocity"),
    )
    assert find_roles(table(t="t", velocity="y", effort="0"), Said()).pairs == (Pair("", "effort", "velocity"),)
    with pytest.raises(RecordingError, match="Say --voltage and one of effort, command"):
        find_roles(table(t="t", velocity="y", effort="r", command="u"), Said())


def test_idle_efforts_of_joints_give_way_to_a_command_that_is_called_an_effort() -> None:
    """As PlotJuggler exports a bag: /joint_states has fields of each joint, the command is on /effort_control."""
    joint = {"/joint_states/arm/position": "y", "/joint_states/arm/effort": "0"}
    pairs = find_roles(table(t="t", **{"/effort_control/data.0": "u"}, **joint), Said()).pairs
    assert pairs == (Pair("", "/effort_control/data.0", "/joint_states/arm/position"),)
    told = table(t="t", **{"/effort_control/data.0": "u"}, **(joint | {"/joint_states/arm/effort": "r"}))
    headings = [read_heading(name) for name in told.names]
    assert leave_out_idle_efforts(told, headings) == headings  # an effort that is there may be the drive


@pytest.mark.parametrize("name", ["pwm_left pwm_right", "pwm1 pwm2", "effort_left effort_right"])
def test_a_motor_that_stands_keeps_its_drive(name: str) -> None:
    """Zeros that are the drive of one motor beside another one's."""
    still, other = name.split()
    moving = {f"speed{one.removeprefix('pwm').removeprefix('effort')}": "y" for one in (still, other)}
    pairs = find_roles(table(t="t", **{still: "0", other: "u"}, **moving), Said()).pairs
    assert [pair.voltage for pair in pairs] == [still, other]


def test_efforts_of_two_wheels_give_way_to_their_commands() -> None:
    columns = {"effort_left": "0", "effort_right": "0", "command_left": "u", "command_right": "r"}
    pairs = find_roles(table(t="t", **columns, speed_left="y", speed_right="y"), Said()).pairs
    assert [pair.voltage for pair in pairs] == ["command_left", "command_right"]


def test_two_sides_are_two_motors() -> None:
    both = find_roles(table(t="t", leftCommand="u", rightCommand="u", leftSpeed="y", rightSpeed="y"), Said())
    assert both.pairs == (Pair("left", "leftCommand", "leftSpeed"), Pair("right", "rightCommand", "rightSpeed"))
    shared = find_roles(table(t="t", command="u", l_speed="y", r_speed="y"), Said())
    assert shared.pairs == (Pair("left", "command", "l_speed"), Pair("right", "command", "r_speed"))
    one = find_roles(
        table(t="t", leftCommand="u", rightCommand="r", leftSpeed="y", rightSpeed="y"),
        Said(motion="leftSpeed", voltage="leftCommand"),
    )
    assert one.pairs == (Pair("", "leftCommand", "leftSpeed"),)
    said = Said(motors=(Pair("a", "x1", "x2"),))
    assert find_roles(table(t="t", x1="u", x2="y", x3="y"), said).pairs == said.motors


@pytest.mark.parametrize("said", [Said(motion="velL"), Said(voltage="pwmL"), Said(motion="velL", voltage="pwmL")])
def test_of_two_motors_the_one_that_was_named(said: Said) -> None:
    sides = {"t": "t", "velR": "y", "velL": "y", "pwmR": "u", "pwmL": "u"}
    (pair,) = find_roles(table(**sides), said).pairs
    assert (pair.voltage, pair.motion) == ("pwmL", "velL")


@pytest.mark.parametrize("first", [0.0, 1.0])
def test_the_numbers_of_the_rows_drive_nothing(first: float) -> None:
    numbers = first + np.arange(200.0)
    with pytest.raises(RecordingError, match="no column is the voltage or duty"):
        find_roles(columns(**{"column 1": numbers, "time": TIME, "value": MOVED}), Said())
    named = columns(**{"": numbers, "time": TIME, "u": DRIVE, "value": MOVED})
    assert find_roles(named, Said()).pairs[0].motion == "value"


@pytest.mark.parametrize(
    ("columns", "complaint"),
    [
        ({"t": "t", "speed_a": "y", "speed_b": "y", "u": "u"}, "the speed? Say --speed and one of speed_a, speed_b."),
        ({"t": "t", "w1": "y", "w2": "n", "pwm": "u"}, "w1, w2. For a motor of each: --motor 1:pwm,w1 --motor 2:"),
        ({"t": "t", "Enc1": "y", "Enc2": "n", "pwm": "u"}, "the motion? Say --speed or --position and one of Enc1,"),
        ({"t": "t", "x": "y", "z": "y", "u": "u"}, "one of x, z. For a motor of each: --motor 1:u,x --motor 2:u,z"),
        ({"t": "t", "speed": "y"}, "is the voltage or duty: t is a time, speed is a speed. Log what drives the"),
        ({"t": "t", "u": "u", "b": "0"}, "log.csv: b is 0 in every row: the motor never moves in it."),
        ({"t": "t", "a": "u", "b": "0"}, "b is 0 in every row: the motor never moves in it, or a is its motion and"),
        ({"a": "y", "b": "y", "c": "t"}, "which column is the voltage or duty? Say --voltage and one of a, b."),
        ({"a": "y", "b": "y", "d": "t"}, "Where it is none of them, as in a log of one step: --constant-voltage V."),
    ],
)  # fmt: skip
def test_what_cannot_be_told_is_asked(columns: dict[str, str], complaint: str) -> None:
    with pytest.raises(RecordingError) as caught:
        find_roles(table(**columns), Said())
    assert complaint in str(caught.value)


@pytest.mark.parametrize(("said", "time"), [(Said(), "a"), (Said(voltage="a"), None), (Said(voltage="b"), "a")])
def test_a_column_that_was_said_to_drive_is_no_clock(said: Said, time: str | None) -> None:
    """A voltage that rises evenly all the time goes on as a clock does."""
    log = table(a="t", b="u", speed="y")
    assert find_roles(log, said).time == time


def test_a_column_that_is_not_there() -> None:
    for said in (Said(time="x"), Said(voltage="x"), Said(motion="x")):
        with pytest.raises(RecordingError, match="log.csv has no column x: name one of t, u, speed"):
            find_roles(table(t="t", u="u", speed="y"), said)


def test_a_side_that_nothing_drives_is_left_out() -> None:
    roles = find_roles(table(t="t", pwm_left="u", speed_left="y", speed_right="y"), Said())
    assert (roles.pairs, roles.left_out) == ((Pair("", "pwm_left", "speed_left"),), ("speed_right",))
    shared = find_roles(table(t="t", pwm="u", speed_left="y", speed_right="y"), Said())
    assert (len(shared.pairs), shared.left_out) == (2, ())
    other = find_roles(table(t="t", pwm_left="u", speed_right="y"), Said())
    assert (other.pairs, other.left_out) == ((Pair("", "pwm_left", "speed_right"),), ())


def test_a_way_without_times_is_no_clock() -> None:
    """As a model prints voltage, angle and speed of a step; a clock that jitters, or whose rows are late, stays one."""
    speed = 6.0 - 6.0 * np.exp(-np.arange(200) / 40.0)
    KINDS.update(g=0.01 * np.cumsum(speed), s=speed, k=np.full(200, 12.0))
    assert find_roles(table(**{"column 1": "k", "column 2": "g", "column 3": "s"}), Said()).time is None
    jitter = 0.002 * np.random.default_rng(3).normal(size=200)
    for late in (np.zeros(200), 0.05 * (np.arange(200) % 50 == 7)):
        KINDS.update(j=np.cumsum(0.01 + jitter + late))
        assert find_roles(table(**{"column 1": "j", "column 2": "u", "column 3": "y"}), Said()).time == "column 1"


def test_dates_without_a_name_are_the_clock() -> None:
    """A board's clock beside them, which goes with them, is the better one; a way is none."""
    dates = np.array([f"2026-03-14T15:09:{26 + k // 100}.{k % 100:02d}" for k in range(200)])
    logged = {"column 1": dates, "column 2": DRIVE, "column 3": MOVED}
    assert find_roles(columns(**logged), Said()).time == "column 1"
    assert find_roles(columns(**logged, **{"column 4": TIME}), Said()).time == "column 4"
    of_both = Said(voltage="column 2")
    speed = np.gradient(MOVED, TIME)
    assert find_roles(columns(**logged, **{"column 4": speed}), of_both).time == "column 1"
    way = np.cumsum(1.0 + 0.15 * np.sin(np.arange(200.0) / 30.0))
    of_way = Said(voltage="column 2", motion="column 4")
    assert find_roles(columns(**logged, **{"column 4": way}), of_way).time == "column 1"


@pytest.mark.parametrize(("changed", "again"), [(0, True), (1, True), (3, False)])
def test_the_motion_under_another_name_does_not_drive_it(changed: int, again: bool) -> None:
    """A matrix of times and speeds beside both as vectors, of which somebody mended a row."""
    copy = np.where(np.arange(len(MOVED)) < 100 + changed, np.abs(MOVED) + 1.0, MOVED)
    motion = np.where(np.arange(len(MOVED)) < 100, copy, MOVED)
    found = columns(t=TIME, speed=motion, x=copy)
    if again:
        with pytest.raises(RecordingError, match="no column is the voltage or duty"):
            find_roles(found, Said())
    else:
        assert find_roles(found, Said()).pairs == (Pair("", "x", "speed"),)


@pytest.mark.parametrize(("back", "time"), [(False, "c"), (True, None)])
def test_the_column_that_is_left_is_the_clock_if_it_always_goes_on(back: bool, time: str | None) -> None:
    """Where the user named drive and motion; rows may come four times as far apart as others."""
    steps = np.random.default_rng(2).choice([0.001, 0.004], 200)
    clock = np.cumsum(steps)
    if back:
        clock[100] = clock[98]
    given = columns(a=FOLLOWS, b=DRIVE, c=clock)
    assert find_roles(given, Said(voltage="b", motion="a")).time == time
    assert find_roles(columns(**given.cells, d=np.sin(TIME)), Said(voltage="b", motion="a")).time is None


def test_what_a_position_went_by_since_the_row_before_is_no_duty() -> None:
    """A student's log of one step, with the differences that he computed beside the counts."""
    counts = np.floor(np.cumsum(np.minimum(np.arange(200.0), 70.0)))
    logged = {"Time": np.arange(200.0), "Position": counts, "Delta": np.diff(counts, prepend=0.0)}
    with pytest.raises(RecordingError, match="no column is the voltage or duty.*--constant-voltage V"):
        find_roles(columns(**logged), Said())
    driven = find_roles(columns(**logged, PWM=np.full(200, 255.0)), Said())
    assert driven.pairs == (Pair("", "PWM", "Position"),)
    with pytest.raises(RecordingError, match="Say --voltage and one of Linearized"):
        find_roles(columns(**logged, Linearized=np.log1p(np.arange(200.0))), Said())
    other = find_roles(columns(**(logged | {"Delta": np.repeat([100.0, 255.0], 100)})), Said())
    assert other.pairs == (Pair("", "Delta", "Position"),), "a column without a telling name may drive"


def test_numbers_of_tests_are_no_times() -> None:
    """A sheet of a test stand, a row a load: 1 ms apart they were read as a recording of 0.15 s."""
    sheet = {"Test #": np.arange(1.0, 201.0), "Applied Voltage (V)": DRIVE, "Tach Reading (RPM)": MOVED}
    assert find_roles(columns(**sheet, **{"Z_Score_Tach Reading (RPM)": MOVED - 3.0}), Said()).time is None
    assert find_roles(columns(**(sheet | {"Test #": DRIVE, "t": TIME})), Said()).time == "t"


def test_numbers_of_samples_are_no_times() -> None:
    """They do not tell how far rows are apart, and 1 ms would be as good as any other guess."""
    number = np.arange(5055.0, 5255.0)
    for name in ("Sample", "sample_no"):
        sheet = {name: number, "PWM": DRIVE, "Motor Speed (RPM)": MOVED}
        assert find_roles(columns(**sheet), Said()).time is None
        assert find_roles(columns(**(sheet | {name: 10.0 * number})), Said()).time == name
    lost = np.delete(np.arange(210.0), np.arange(10, 210, 20))  # a few rows were not logged
    assert find_roles(columns(sample=lost, PWM=DRIVE, rpm=MOVED), Said()).time is None


@pytest.mark.parametrize("time", [None, "a"])
def test_times_of_edges_beside_their_count(time: str | None) -> None:
    """As of a robot whose board logs when each slot came, under one voltage."""
    count = np.arange(200.0)
    of_edges = columns(a=np.rint(40.0 * np.sqrt(count) + 10.0 * count), b=count, **{CONSTANT: np.full(200, 6.0)})
    roles = find_roles(of_edges, Said(time=time))
    assert (roles.time, roles.pairs) == ("a", (Pair("", CONSTANT, "b"),))
    assert [line.startswith("a says when each count in b came") for line in roles.findings] == ([] if time else [True])
