"""Which column is which."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.columns.roles import find_roles
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.csv.table import Table
from motor_model.errors import RecordingError

TIME = np.arange(200) * 0.01
DRIVE = np.repeat([3.0, -2.0, 5.0, 1.0], 50)
MOVED = np.cumsum(DRIVE) * 0.1 + np.sin(TIME * 9.0)
KINDS = {
    "n": np.sin(TIME * 31.0),
    "t": TIME,
    "u": DRIVE,
    "y": MOVED,
    "b": 12.0 - 0.01 * np.abs(DRIVE),
    "r": 2.0 * DRIVE,
    "0": np.zeros(200),
}


def table(**columns: str) -> Table:
    """Columns by name, each with the numbers of a kind."""
    return Table(Path("log.csv"), np.arange(2, 202), {name: KINDS[kind] for name, kind in columns.items()})


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


def test_what_was_counted_comes_before_what_was_computed() -> None:
    assert find_roles(table(t="t", speed="y", ticks="y", angle="y", pwm="u"), Said()).pairs[0].motion == "ticks"
    assert find_roles(table(t="t", speed="y", angle="y", pwm="u"), Said()).pairs[0].motion == "angle"
    assert find_roles(table(t="t", speed="y", angle="y", pwm="u"), Said(motion="speed")).pairs[0].motion == "speed"


def test_a_voltage_beside_a_duty_may_be_the_supply() -> None:
    supplied = find_roles(table(t="t", pwm="u", voltage="b", speed="y"), Said())
    assert (supplied.pairs[0].voltage, supplied.supply) == ("pwm", "voltage")
    driven = find_roles(table(t="t", pwm="u", voltage="u", speed="y"), Said())
    assert (driven.pairs[0].voltage, driven.supply) == ("voltage", None)
    named = find_roles(table(t="t", pwm="u", battery="b", speed="y"), Said())
    assert (named.pairs[0].voltage, named.supply) == ("pwm", "battery")


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
    columns = {"t": "t", "velR": "y", "velL": "y", "pwmR": "u", "pwmL": "u"}
    (pair,) = find_roles(table(**columns), said).pairs
    assert (pair.voltage, pair.motion) == ("pwmL", "velL")


def test_without_names_by_how_numbers_behave() -> None:
    roles = find_roles(table(**{"column 1": "t", "column 2": "y", "column 3": "u", "column 4": "0"}), Said())
    assert (roles.time, roles.pairs) == ("column 1", (Pair("", "column 3", "column 2"),))


def test_without_names_a_position_and_its_speed() -> None:
    """A log of one step: the drive is constant, and the position is the integral of the speed."""
    KINDS.update(c=np.full(200, 100.0), v=np.round(1.0 - np.exp(-TIME), 2), p=np.floor(np.cumsum(1.0 - np.exp(-TIME))))
    roles = find_roles(table(**{"column 1": "c", "column 2": "t", "column 3": "v", "column 4": "p"}), Said())
    assert (roles.time, roles.pairs) == ("column 2", (Pair("", "column 1", "column 4"),))
    with pytest.raises(
        RecordingError, match="voltage or duty\\? Say --voltage and one of column 1, column 3, column 4"
    ):
        find_roles(table(**{"column 1": "c", "column 2": "t", "column 3": "v", "column 4": "u"}), Said())
    with pytest.raises(RecordingError, match="--voltage and one of c0, .*, c11 and 2 more"):
        find_roles(table(t="t", **{f"c{k}": "y" for k in range(14)}), Said())


def test_the_outputs_of_one_input() -> None:
    both = find_roles(table(t="t", input="u", outputL="y", outputR="y"), Said())
    assert both.pairs == (Pair("left", "input", "outputL"), Pair("right", "input", "outputR"))
    loop = find_roles(table(t="t", setpoint="r", input="y", output="u"), Said())
    assert loop.pairs == (Pair("", "output", "input"),)
    spanish = find_roles(table(Tiempo="t", Referencia="r", Entrada="y", Salida="u"), Said())
    assert spanish.pairs == (Pair("", "Salida", "Entrada"),)
    plant = find_roles(table(Zeit="t", Eingang="u", Ausgang="y"), Said())
    assert plant.pairs == (Pair("", "Eingang", "Ausgang"),)


def test_an_output_beside_what_drives_is_the_motors() -> None:
    effort = find_roles(table(Tempo="t", Saída="y", Erro="r", Esforço="u"), Said())
    assert effort.pairs == (Pair("", "Esforço", "Saída"),)
    assert find_roles(table(t="t", ref="r", output="y", pwm="u"), Said()).pairs == (Pair("", "pwm", "output"),)
    assert find_roles(table(t="t", output="u", speed="y"), Said()).pairs == (Pair("", "output", "speed"),)
    with pytest.raises(RecordingError, match="the duty\\? Say --voltage and one of output, pwm"):
        find_roles(table(t="t", output="u", pwm="u", speed="y"), Said())


def test_motors_by_number_where_drives_and_motions_have_the_same() -> None:
    both = find_roles(table(t="t", pwm1="u", pwm2="r", enc1="y", enc2="y"), Said())
    assert both.pairs == (Pair("1", "pwm1", "enc1"), Pair("2", "pwm2", "enc2"))
    for columns in ({"pwm1": "u", "enc1": "y", "enc2": "y"}, {"pwm1": "u", "pwm3": "r", "enc1": "y", "enc2": "y"}):
        one = find_roles(table(t="t", **columns), Said())
        assert (one.pairs, one.left_out) == ((Pair("", "pwm1", "enc1"),), ("enc2",))


def test_what_is_called_a_supply_and_swings_drives() -> None:
    assert find_roles(table(t="t", Vin="u", speed="y"), Said()).pairs == (Pair("", "Vin", "speed"),)
    with pytest.raises(RecordingError, match="no column is the voltage or duty"):
        find_roles(table(t="t", Vin="b", speed="y"), Said())
    assert find_roles(table(t="t", Vin="b", pwm="u", speed="y"), Said()).supply == "Vin"


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


def test_current_beside_a_target_is_what_is_present() -> None:
    roles = find_roles(table(t="t", target="r", current="y", pwm="u"), Said())
    assert (roles.pairs, roles.current) == ((Pair("", "pwm", "current"),), None)
    four = find_roles(table(t="t", CURRENT_M1="y", CURRENT_M2="y", PWM_M1="u", PWM_M2="r", DESIRED_M1="r"), Said())
    assert four.pairs == (Pair("1", "PWM_M1", "CURRENT_M1"), Pair("2", "PWM_M2", "CURRENT_M2"))
    measured = find_roles(table(t="t", target="r", current="y", pwm="u", speed="y"), Said())
    assert (measured.pairs[0].motion, measured.current) == ("speed", "current")
    for columns in ({"current": "y", "loop": "r"}, {"target": "r", "current_mA": "y"}):
        with pytest.raises(RecordingError, match="which column is the motion"):
            find_roles(table(t="t", pwm="u", **columns), Said())


@pytest.mark.parametrize(("changes", "told"), [(10, True), (9, False)])
def test_a_motion_changes_more_than_a_few_times(changes: int, told: bool) -> None:
    KINDS.update(c=np.full(200, 1520.0), m=np.minimum(np.arange(200) // 4, changes))
    if told:
        assert find_roles(table(t="t", a="c", b="m"), Said()).pairs == (Pair("", "a", "b"),)
        return
    with pytest.raises(RecordingError, match="voltage or duty"):
        find_roles(table(t="t", a="c", b="m"), Said())


@pytest.mark.parametrize(
    ("columns", "complaint"),
    [
        ({"t": "t", "speed_a": "y", "speed_b": "y", "u": "u"}, "the speed? Say --speed and one of speed_a, speed_b."),
        ({"t": "t", "w1": "y", "w2": "n", "pwm": "u"}, "w1, w2. For a motor of each: --motor 1:pwm,w1 --motor 2:"),
        ({"t": "t", "Enc1": "y", "Enc2": "n", "pwm": "u"}, "the motion? Say --speed or --position and one of Enc1,"),
        ({"t": "t", "x": "y", "z": "y", "u": "u"}, "one of x, z. For a motor of each: --motor 1:u,x --motor 2:u,z"),
        ({"t": "t", "speed": "y"}, "is the voltage or duty: say which one of t, speed is (--voltage COL), or --c"),
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


def test_a_column_that_is_not_there() -> None:
    for said in (Said(time="x"), Said(voltage="x"), Said(motion="x")):
        with pytest.raises(RecordingError, match="log.csv has no column x: name one of t, u, speed"):
            find_roles(table(t="t", u="u", speed="y"), said)


def test_a_log_of_one_step_that_has_no_drive_is_told_of_the_option() -> None:
    """Time and position, or these and the speed, a file for each voltage: no column is offered as the voltage."""
    angle = np.floor(300.0 * (TIME + 0.1 * np.exp(-10.0 * TIME) - 0.1))
    KINDS.update(a=angle, w=300.0 * (1.0 - np.exp(-10.0 * TIME)))
    for columns in ({"column 1": "a", "column 2": "t"}, {"column 1": "t", "column 2": "a", "column 3": "w"}):
        with pytest.raises(RecordingError, match="no column is the voltage or duty: .* --constant-voltage V for a log"):
            find_roles(table(**columns), Said())


def test_v_beside_a_drive_is_the_velocity() -> None:
    """`vLeft` beside `powerPctLeft`: it changes while the drive stays; a voltage that was measured does not."""
    both = find_roles(
        table(t="t", powerPctLeft="u", powerPctRight="r", vLeft="y", vMouse="y", vRight="y"), Said()
    ).pairs
    assert both == (Pair("left", "powerPctLeft", "vLeft"), Pair("right", "powerPctRight", "vRight"))
    assert find_roles(table(t="t", u="u", v="y"), Said()).pairs == (Pair("", "u", "v"),)
    assert find_roles(table(t="t", pwm="u", v="u", x="y"), Said()).pairs == (Pair("", "v", "x"),)
    assert find_roles(table(t="t", pwm="u", v="u", omega="y"), Said()).pairs == (Pair("", "v", "omega"),)
    with pytest.raises(RecordingError, match="which column is the motion"):
        find_roles(table(t="t", pwm="u", v="r"), Said())
    with pytest.raises(RecordingError, match="which column is the motion"):
        find_roles(table(t="t", pwm="u", v="b"), Said())


def test_a_side_that_nothing_drives_is_left_out() -> None:
    roles = find_roles(table(t="t", pwm_left="u", speed_left="y", speed_right="y"), Said())
    assert (roles.pairs, roles.left_out) == ((Pair("", "pwm_left", "speed_left"),), ("speed_right",))
    shared = find_roles(table(t="t", pwm="u", speed_left="y", speed_right="y"), Said())
    assert (len(shared.pairs), shared.left_out) == (2, ())
    other = find_roles(table(t="t", pwm_left="u", speed_right="y"), Said())
    assert (other.pairs, other.left_out) == ((Pair("", "pwm_left", "speed_right"),), ())


def answer(drive: np.ndarray) -> np.ndarray:
    moved = np.zeros(len(drive))
    for k in range(len(drive) - 1):
        moved[k + 1] = moved[k] + (drive[k] - moved[k]) * 0.3
    return moved + np.random.default_rng(0).normal(0.0, 0.002, len(drive))


@pytest.mark.parametrize("order", [("column 2", "column 4"), ("column 4", "column 2")])
def test_of_two_columns_without_names_one_follows_the_other(order: tuple[str, str]) -> None:
    """Each channel with an X of its own, both noisy, as a measurement card records them."""
    drive = DRIVE + np.random.default_rng(1).normal(0.0, 0.002, 200)
    both = dict(zip(order, (drive, answer(DRIVE)), strict=True))
    cells = {"column 1": TIME, "column 2": both["column 2"], "column 3": TIME + 1e-3, "column 4": both["column 4"]}
    roles = find_roles(Table(Path("log.csv"), np.arange(2, 202), cells), Said())
    assert (roles.time, roles.pairs) == ("column 1", (Pair("", *order),))
    said = f"{order[0]} drives and {order[1]} moves, as that follows it (assumed; otherwise: --voltage)."
    assert roles.findings == (said,)


def test_neither_of_two_that_go_together_is_said_to_follow() -> None:
    wave = np.sin(TIME * 3.0)
    cells = {"column 1": TIME, "column 2": wave, "column 3": TIME + 1e-3, "column 4": answer(wave)}
    with pytest.raises(RecordingError, match="one of column 2, column 4"):  # and not of times
        find_roles(Table(Path("log.csv"), np.arange(2, 202), cells), Said())


def test_of_two_channels_in_volts_one_follows_the_other() -> None:
    cells = {"Second": TIME - 1.0, "CH1 [Volt]": answer(DRIVE), "CH2 [Volt]": DRIVE}
    roles = find_roles(Table(Path("log.csv"), np.arange(2, 202), cells), Said())
    assert (roles.time, roles.pairs) == ("Second", (Pair("", "CH2 [Volt]", "CH1 [Volt]"),))
    assert "CH2 [Volt] drives and CH1 [Volt] moves" in roles.findings[0]
    with pytest.raises(RecordingError, match=r"one of CH1 \[Volt\], CH2 \[Volt\]"):  # both the same
        find_roles(Table(Path("log.csv"), np.arange(2, 202), {**cells, "CH1 [Volt]": DRIVE}), Said())


def columns(**numbers: np.ndarray) -> Table:  # type: ignore[type-arg]
    return Table(Path("log.csv"), np.arange(2, 202), numbers)


FOLLOWS = np.convolve(DRIVE, np.exp(-np.arange(60) / 8.0) / 8.0)[:200]


def test_numbered_motors_share_the_one_drive_where_each_follows_it() -> None:
    speeds = {f"Enc{k}": np.round(4.1 * FOLLOWS + 0.01 * k, 2) for k in (1, 2, 3)}
    roles = find_roles(columns(t=TIME, PWM=50.0 * DRIVE, **speeds), Said())
    assert roles.pairs == tuple(Pair(str(k), "PWM", f"Enc{k}") for k in (1, 2, 3))
    counts = {f"enc{k}": np.floor(90.0 * k + 7.3 * np.cumsum(FOLLOWS)) for k in (1, 2)}
    assert [pair.label for pair in find_roles(columns(t=TIME, pwm=50.0 * DRIVE, **counts), Said()).pairs] == ["1", "2"]


def test_a_pendulums_encoder_shares_no_drive() -> None:
    swings = np.floor(300.0 * np.sin(TIME * 31.0))
    with pytest.raises(RecordingError, match="For a motor of each: --motor 1:pwm,enc1"):
        find_roles(columns(t=TIME, pwm=50.0 * DRIVE, enc1=np.floor(7.3 * np.cumsum(FOLLOWS)), enc2=swings), Said())


def test_what_is_raw_comes_before_what_was_made_of_it() -> None:
    named = find_roles(columns(t=TIME, pwm=DRIVE, **{"VEL": FOLLOWS, "RAW VEL": 1.1 * FOLLOWS}), Said())
    assert named.pairs[0].motion == "RAW VEL"


@pytest.mark.parametrize(("least", "battery"), [(22.0, True), (2.0, False)])
def test_a_voltage_that_stays_while_the_motor_turns_both_ways_drives_nothing(least: float, battery: bool) -> None:
    volts = np.where(np.arange(200) < 4, 0.0, np.linspace(25.0, least, 200))
    table = columns(t=TIME, VOLT=volts, vel=FOLLOWS)
    if battery:
        with pytest.raises(RecordingError, match="no column is the voltage or duty"):
            find_roles(table, Said())
        directed = columns(t=TIME, VOLT=volts, vel=FOLLOWS, dir=np.sign(DRIVE))  # a pin says which way
        assert find_roles(directed, Said()).pairs[0].voltage == "VOLT"
    else:
        assert find_roles(table, Said()).pairs[0].voltage == "VOLT"
    one_way = columns(t=TIME, VOLT=volts, vel=np.abs(FOLLOWS))
    assert find_roles(one_way, Said()).pairs[0].voltage == "VOLT"


@pytest.mark.parametrize("told", [True, False])
def test_a_battery_of_few_levels_drives_nothing_where_a_set_point_is_told(told: bool) -> None:
    volts = np.select([np.arange(200) < 4, np.arange(200) < 90], [0.0, 25.1], 24.9)
    table = columns(t=TIME, setpoint=np.sign(DRIVE) if told else np.ones(200), VOLT=volts, vel=FOLLOWS)
    if told:
        with pytest.raises(RecordingError, match="no column is the voltage or duty"):
            find_roles(table, Said())
    else:
        assert find_roles(table, Said()).pairs[0].voltage == "VOLT"


@pytest.mark.parametrize("first", [0.0, 1.0])
def test_the_numbers_of_the_rows_drive_nothing(first: float) -> None:
    numbers = first + np.arange(200.0)
    with pytest.raises(RecordingError, match="no column is the voltage or duty"):
        find_roles(columns(**{"column 1": numbers, "time": TIME, "value": MOVED}), Said())
    assert (
        find_roles(columns(**{"": numbers, "time": TIME, "u": DRIVE, "value": MOVED}), Said()).pairs[0].motion
        == "value"
    )


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


@pytest.mark.parametrize(("notes", "taken"), [(150, False), (40, True)])
def test_a_column_of_few_numbers_holds_notes(notes: int, taken: bool) -> None:
    cells = [*["63.2% vmax"] * notes, *["12.0"] * (200 - notes)]
    table = Table(Path("log.csv"), np.arange(2, 202), {"t": TIME, "pwm": DRIVE, "speed": FOLLOWS, "V_max": cells})
    if taken:
        with pytest.raises(RecordingError, match="column V_max: '63.2% vmax' is not a number"):
            find_roles(table, Said())
    else:
        assert find_roles(table, Said()).pairs == (Pair("", "pwm", "speed"),)


def test_a_pulse_of_two_levels_drives_and_counts_nothing() -> None:
    pulse = np.where(np.sin(TIME * 3.0) > 0.0, 12.0, 0.0)
    cells = {"t": TIME, "pulse": pulse, "rad": answer(pulse)}
    assert find_roles(Table(Path("log.csv"), np.arange(2, 202), cells), Said()).pairs == (Pair("", "pulse", "rad"),)
    counted = {**cells, "pulse": np.arange(200.0)}
    with pytest.raises(RecordingError):
        find_roles(Table(Path("log.csv"), np.arange(2, 202), counted), Said())


def test_a_bare_input_beside_a_control_signal_is_what_the_controller_is_told() -> None:
    loop = find_roles(table(time="t", encoder="y", inputSignal="r", controlSignal="u"), Said())
    assert loop.pairs == (Pair("", "controlSignal", "encoder"),)
    assert find_roles(table(time="t", encoder="y", inputSignal="u"), Said()).pairs[0].voltage == "inputSignal"
    volts = find_roles(table(time="t", encoder="y", **{"input voltage": "u"}, control="r"), Said())
    assert volts.pairs[0].voltage == "input voltage"
    still = find_roles(table(time="t", encoder="y", input="u", control="0"), Said())
    assert still.pairs[0].voltage == "input"


def test_a_signal_that_is_listed_twice_is_one() -> None:
    twice = find_roles(table(t="t", u="u", **{"pos [deg]": "y", "pos [deg] #4": "y"}), Said())
    assert twice.pairs == (Pair("", "u", "pos [deg]"),)
    with pytest.raises(RecordingError, match="--position and one of"):
        find_roles(table(t="t", u="u", **{"pos [deg]": "y", "pos [deg] #4": "n"}), Said())


def test_y_is_what_u_drives() -> None:
    assert find_roles(table(t="t", u="u", x="n", y="y"), Said()).pairs == (Pair("", "u", "y"),)
    with pytest.raises(RecordingError, match="--speed, --position or --count and one of x, y"):
        find_roles(table(t="t", pwm="u", x="n", y="y"), Said())


def test_a_way_without_times_is_no_clock() -> None:
    """As a model prints voltage, angle and speed of a step; a clock that jitters, or whose rows are late, stays one."""
    speed = 6.0 - 6.0 * np.exp(-np.arange(200) / 40.0)
    KINDS.update(g=0.01 * np.cumsum(speed), s=speed, k=np.full(200, 12.0))
    assert find_roles(table(**{"column 1": "k", "column 2": "g", "column 3": "s"}), Said()).time is None
    jitter = 0.002 * np.random.default_rng(3).normal(size=200)
    for late in (np.zeros(200), 0.05 * (np.arange(200) % 50 == 7)):
        KINDS.update(j=np.cumsum(0.01 + jitter + late))
        assert find_roles(table(**{"column 1": "j", "column 2": "u", "column 3": "y"}), Said()).time == "column 1"


def test_of_several_speeds_the_one_with_a_unit_is_taken() -> None:
    vesc = find_roles(table(ms="t", duty_cycle="u", erpm="y", tachometer="n"), Said())
    assert vesc.pairs == (Pair("", "duty_cycle", "erpm"),)
    with pytest.raises(RecordingError, match="the speed\\? Say --speed and one of rpm_a, rpm_b"):
        find_roles(table(t="t", u="u", rpm_a="y", rpm_b="n"), Said())
