"""Kind and unit of a motion: as said, by its name, by its numbers; what nothing tells is asked for."""

from pathlib import Path

import numpy as np
import pytest
from log_forms import ROWS, form

from motor_identification.logs.columns.guess import guess_forms
from motor_identification.logs.columns.motor_form import Notes, Rows, make_form
from motor_identification.logs.columns.roles.roles import Roles
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import Kind
from motor_model.errors import RecordingError


@pytest.mark.parametrize(
    ("motion", "said", "kind", "unit", "asked"),
    [
        ("speed [rpm]", Said(), Kind.SPEED, "rpm", ""),
        ("speed [rpm]", Said(unit="deg/s"), Kind.SPEED, "deg/s", ""),
        ("angle", Said(unit="rpm"), Kind.SPEED, "rpm", ""),  # the unit says what it is
        ("ticks", Said(), Kind.COUNT, "count", "--edges-per-revolution"),
        ("ticks", Said(edges_per_revolution=48), Kind.COUNT, "count", ""),
        ("pos [m]", Said(), Kind.POSITION, "m", ""),
        ("pos [m]", Said(edges_per_revolution=48), Kind.POSITION, "m", "--units-per-revolution"),
        ("pos [m]", Said(units_per_revolution=0.2), Kind.POSITION, "m", ""),
        ("speed", Said(), Kind.SPEED, "rad/s", "--unit"),
        ("pot_V", Said(), Kind.POSITION, "rad", "is a voltage: of a potentiometer, say --unit rad,"),
        ("tacho [V]", Said(unit="rad/s"), Kind.SPEED, "rad/s", ""),
        ("speed", Said(motion="speed", kind=Kind.SPEED), Kind.SPEED, "rad/s", "rad/s, deg/s or rpm"),  # tells no unit
        ("speed", Said(motion="speed", kind=Kind.SPEED, unit="rad/s"), Kind.SPEED, "rad/s", ""),
        ("speed [rpm]", Said(motion="speed [rpm]", kind=Kind.SPEED), Kind.SPEED, "rpm", ""),
        ("angle", Said(motion="angle", kind=Kind.POSITION), Kind.POSITION, "rad", "do not tell: say --unit"),
        ("angle", Said(motion="angle", kind=Kind.POSITION, unit="rad"), Kind.POSITION, "rad", ""),
    ],
)
def test_kind_and_unit_of_the_motion(motion: str, said: Said, kind: Kind, unit: str, asked: str) -> None:
    notes = Notes([], [])
    made = form(Said(**{**said.__dict__, "supply_voltage": 12.0}), notes, motion)
    assert (made.kind, made.unit) == (kind, unit)
    assert (asked in notes.questions[0][1]) if asked else notes.questions == []


@pytest.mark.parametrize(("name", "volts"), [("Tacho Voltage (V)", 1), ("encoder_V", 1), ("left_v", 0), ("V", 0)])
def test_a_tachogenerators_volts_are_no_counts_whatever_their_steps(name: str, volts: int) -> None:
    """Steps of 0.1122 rad/s are 2,800 counts a turn over 20 ms, and of volts those of a converter."""
    steps = 0.1122 * np.rint(np.repeat([100.0, -50.0, 100.0, -50.0], 25) + np.arange(100) % 7)
    cells = {"t": np.arange(100) * 0.02, "pwm": np.repeat([100.0, -50.0, 100.0, -50.0], 25), name: steps}
    notes, pair = Notes([], []), Pair("", "pwm", name)
    said = Said(supply_voltage=12.0, unit="rad/s" if volts else None)
    make_form(Table(Path("log.csv"), np.arange(100), cells), pair, Roles("t", (), None, None), said, ROWS, notes)
    assert ("1 V of it is taken for 1 rad/s" in notes.findings[-1]) == bool(volts)
    asked = Notes([], [])
    make_form(Table(Path("log.csv"), np.arange(100), cells), pair, Roles("t", (), None, None), Said(), ROWS, asked)
    assert any("is a voltage" in question for _, question in asked.questions) == bool(volts)


@pytest.mark.parametrize(
    ("said", "kind", "unit"),
    [(Said(), Kind.SPEED, "rad/s"), (Said(motion="rad", kind=Kind.POSITION), Kind.POSITION, "rad")],
)
def test_a_speed_called_by_a_unit_of_angles(said: Said, kind: Kind, unit: str) -> None:
    """`rad` beside a voltage, as a Simulink signal is called: it follows the voltage and forgets what was."""
    rows, steps = 0.01 * np.arange(1, 401), np.repeat([6.0, 0.0, 12.0, 3.0, 9.0, -6.0, 0.0, 6.0], 50)
    speed = np.zeros(400)
    for k in range(399):
        speed[k + 1] = speed[k] + 0.2 * (20.0 * steps[k] - speed[k])
    for motion, named in ((speed, kind), (np.cumsum(speed) * 0.01, Kind.POSITION)):
        table = Table(Path("log.csv"), np.arange(400), {"t": rows, "u": steps, "rad": motion})
        made = make_form(table, Pair("", "u", "rad"), Roles("t", (), None, None), said, ROWS, Notes([], []))
        assert (made.kind, made.unit) == (named, unit if named is kind else "rad")


@pytest.mark.parametrize(("least", "units"), [(1.0, "count or deg"), (0.0173, "rad, deg, rev or count")])
def test_a_named_position_in_whole_numbers_is_asked_for_as_it_is_no_angle_in_radians(least: float, units: str) -> None:
    """Who names the column says nothing of its unit: of fractions all are asked for, too."""
    time = 0.01 * np.arange(1, 101)
    moved = least * np.floor(300.0 * np.sin(time))
    notes = Notes([], [])
    table = Table(Path("log.csv"), np.arange(100), {"t": time, "u": np.repeat([5.0, -5.0], 50), "Position": moved})
    said = Said(motion="Position", kind=Kind.POSITION)
    make_form(table, Pair("", "u", "Position"), Roles("t", (), None, None), said, ROWS, notes)
    question = notes.questions[0][1]
    assert question.startswith(f"in {units}, ") and "which the numbers do not tell: say --unit" in question


@pytest.mark.parametrize(("edges", "unit"), [(334, "count/s"), (360, ""), (60, ""), (None, "")])
@pytest.mark.parametrize("named", [False, True])
def test_speeds_of_whole_counts_over_a_row_are_no_radians(edges: int | None, unit: str, named: bool) -> None:
    """As where a program divides what it counted by the row's 10 ms: all are multiples of 100."""
    time = 0.01 * np.arange(1, 101)
    speed = 100.0 * np.floor(13.0 * np.sin(time) + 2.0 * np.sin(40.0 * time))
    notes = Notes([], [])
    table = Table(Path("log.csv"), np.arange(100), {"t": time, "u": np.repeat([5.0, -5.0], 50), "Speed": speed})
    said = Said(edges_per_revolution=edges, **({"motion": "Speed", "kind": Kind.SPEED} if named else {}))
    made = make_form(table, Pair("", "u", "Speed"), Roles("t", (), None, None), said, ROWS, notes)
    assert (made.unit == "count/s" and notes.questions == []) == bool(unit)
    asked = "in count/s, deg/s or rpm, which the numbers do not tell: say --unit"
    assert unit or notes.questions[0][1] == asked


@pytest.mark.parametrize(("edges", "unit"), [(256, "count"), (360, ""), (None, "")])
def test_whole_positions_are_counts_where_those_of_a_turn_are_said(edges: int | None, unit: str) -> None:
    time = 0.01 * np.arange(1, 101)
    numbers = {"t": time, "u": np.repeat([5.0, -5.0], 50), "Position": np.floor(300.0 * np.sin(time))}
    notes, table = Notes([], []), Table(Path("log.csv"), np.arange(100), numbers)
    said = Said(edges_per_revolution=edges)
    made = make_form(table, Pair("", "u", "Position"), Roles("t", (), None, None), said, ROWS, notes)
    assert (made.kind is Kind.COUNT) == bool(unit) and (notes.questions == []) == bool(unit)


@pytest.mark.parametrize(("rows", "motion", "either"), [(25, "x", True), (1000, "x", False), (25, "speed", False)])
def test_units_of_both_kinds_are_asked_for_where_the_numbers_tell_neither(rows: int, motion: str, either: bool) -> None:
    drive = np.tile(np.repeat([3.0, -2.0, 5.0, 0.0], 25), 10)[:rows]
    speed = np.zeros(rows)
    for k in range(1, rows):
        speed[k] = speed[k - 1] + 0.154 * (20.1 * drive[k - 1] - speed[k - 1])
    numbers = {"t": 0.01 * np.arange(1, rows + 1), "u": drive, motion: speed}
    notes, table = Notes([], []), Table(Path("log.csv"), np.arange(rows), numbers)
    make_form(table, Pair("", "u", motion), Roles("t", (), None, None), Said(), ROWS, notes)
    (question,) = [text for column, text in notes.questions if column == motion]
    assert ("rad/s" in question and "rev" in question) == either
    assert ", or of a slide in mm" in question


@pytest.mark.parametrize(("edges", "said"), [(None, True), (360, False)])
@pytest.mark.parametrize("motion", ["angle", "speed"])
def test_who_is_asked_for_a_unit_hears_that_counts_need_those_of_a_turn(
    edges: int | None, said: bool, motion: str
) -> None:
    """`--unit count` alone was refused then. Of 360 counts a turn, nothing tells them from degrees."""
    notes = Notes([], [])
    form(Said(supply_voltage=12.0, edges_per_revolution=edges), notes, motion)
    (question,) = [text for _, text in notes.questions]
    assert ("say --unit (count with --edges-per-revolution N)" in question) is (said and motion == "angle")


@pytest.mark.parametrize(("name", "kind"), [("vRot", Kind.SPEED), ("rotated", Kind.POSITION), ("v_pot", Kind.POSITION)])
def test_a_motion_called_v_is_a_velocity_where_its_numbers_tell_no_kind(name: str, kind: Kind) -> None:
    """A duty without a sign under which a motor runs both ways, in steps of 6,283 a turn, which any gyro may have."""
    drive = np.tile(np.repeat([10.0, 0.0], 500), 4) * np.repeat([0.5, 1.0, 1.5, 2.0], 1000)
    way, speed = np.repeat([1.0, -1.0, 1.0, -1.0], 1000), np.zeros(4000)
    for k in range(1, 4000):
        speed[k] = speed[k - 1] + 0.06 * (way[k - 1] * 20.0 * drive[k - 1] - speed[k - 1])
    numbers = {"t": 0.002 * np.arange(1, 4001), "pwm": drive, name: np.round(speed / 0.001) * 0.001 * np.pi / 3.141}
    table, rows = Table(Path("log.csv"), np.arange(4000), numbers), Rows("t", "s", 0.002)
    said = Said(supply_voltage=7.4)
    assert make_form(table, Pair("", "pwm", name), Roles("t", (), None, None), said, rows, Notes([], [])).kind is kind


@pytest.mark.parametrize(
    ("beside", "offered"),
    [(("speed",), "speed"), ((), ""), (("speed", "velocity"), ""), (("target_speed",), "")],
)
def test_a_unit_of_a_speed_beside_a_position_is_an_answer_too(beside: tuple[str, ...], offered: str) -> None:
    """Of a tacho and a position nobody may know the position's unit, and everybody that speeds are in rpm."""
    speed = 400.0 * np.arctan(np.arange(200) / 31.0)
    position = np.cumsum(speed) * 0.0013
    volts = np.repeat([5.0, 15.0], 100)
    columns = {"time [s]": 0.01 * np.arange(200), "voltage [V]": volts, "position": position}
    log = Table(
        Path("log.csv"), np.arange(200), {**columns, **{name: speed * (1 + k) for k, name in enumerate(beside)}}
    )
    with pytest.raises(RecordingError, match="position in rad, deg, .*: say --unit") as asked:
        guess_forms(log, Said())
    assert ("or one of rad/s, deg/s, rpm to read speed instead" in str(asked.value)) is bool(offered)
    if offered:
        (made,) = guess_forms(log, Said(unit="rpm")).forms
        assert (made.motion, made.kind, made.unit) == (offered, Kind.SPEED, "rpm")


@pytest.mark.parametrize(
    ("name", "of_position", "whole", "read"),
    [
        ("speed [rpm]", "position", False, "speed [rpm]"),
        ("speed [rpm]", "position", True, ""),
        ("speed", "position", False, ""),
        ("speed [count/s]", "position", False, ""),
        ("speed [rpm]", "position [deg]", False, "position [deg]"),
    ],
)
def test_a_speed_with_a_unit_is_read_where_nothing_tells_that_of_the_position(
    name: str, of_position: str, whole: bool, read: str
) -> None:
    """A motor of 3,500 rpm turned by more than half a turn from row to row, and its position wrapped at 230."""
    speed = 3500.0 * np.arctan(np.arange(200) / 31.0)
    position = np.mod(np.cumsum(speed) * 0.06, 230.4) + np.linspace(0.0, 0.0137, 200)
    position = np.rint(position) if whole else position
    volts = np.repeat([5.0, 15.0], 100)
    columns = {"time [s]": 0.01 * np.arange(200), "voltage [V]": volts, of_position: position, name: speed}
    log = Table(Path("log.csv"), np.arange(200), columns)
    if not read:
        with pytest.raises(RecordingError, match="position in .*: say --unit"):
            guess_forms(log, Said())
        return
    guessed = guess_forms(log, Said())
    assert guessed.forms[0].motion == read
    said = "as nothing tells the unit of position (otherwise: --position position --unit U)"
    assert any(said in finding for finding in guessed.findings) is (read == name)
    (asked,) = guess_forms(log, Said(motion=of_position, kind=Kind.POSITION, unit="deg")).forms
    assert asked.motion == of_position


def test_a_speed_of_zeros_is_none_beside_a_position_that_moves() -> None:
    position, volts = np.linspace(0.0, 80.3, 200), np.repeat([5.0, 15.0], 100)
    columns = {
        "time [s]": 0.01 * np.arange(200),
        "voltage [V]": volts,
        "position": position,
        "speed [rpm]": 0.0 * volts,
    }
    with pytest.raises(RecordingError, match="position in .*: say --unit"):
        guess_forms(Table(Path("log.csv"), np.arange(200), columns), Said())


def test_joint_states_are_in_radians() -> None:
    for motion, unit in (("/joint_states/arm/velocity", "rad/s"), ("/joint_states/arm/position", "rad")):
        notes = Notes([], [])
        made = form(Said(supply_voltage=12.0), notes, motion)
        assert made.unit == unit and not notes.questions and "as ROS's joint states have them" in notes.findings[-1]
        asked = Notes([], [])
        assert form(Said(supply_voltage=12.0, unit="deg"), asked, motion).unit == "deg"
