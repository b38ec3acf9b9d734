"""A drive and a motion without telling names."""

from pathlib import Path

import numpy as np
import pytest
from log_columns import DRIVE, KINDS, TIME, answer, table

from motor_identification.logs.columns.guess import guess_forms
from motor_identification.logs.columns.roles.roles import find_roles
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.csv.table import Table
from motor_model.errors import RecordingError


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


@pytest.mark.parametrize(("changes", "told"), [(10, True), (9, False)])
def test_a_motion_changes_more_than_a_few_times(changes: int, told: bool) -> None:
    KINDS.update(c=np.full(200, 1520.0), m=np.minimum(np.arange(200) // 4, changes))
    if told:
        assert find_roles(table(t="t", a="c", b="m"), Said()).pairs == (Pair("", "a", "b"),)
        return
    with pytest.raises(RecordingError, match="voltage or duty"):
        find_roles(table(t="t", a="c", b="m"), Said())


def test_a_log_of_one_step_that_has_no_drive_is_told_of_the_option() -> None:
    """Time and position, or these and the speed, a file for each voltage: no column is offered as the voltage."""
    angle = np.floor(300.0 * (TIME + 0.1 * np.exp(-10.0 * TIME) - 0.1))
    KINDS.update(a=angle, w=300.0 * (1.0 - np.exp(-10.0 * TIME)))
    for columns in ({"column 1": "a", "column 2": "t"}, {"column 1": "t", "column 2": "a", "column 3": "w"}):
        with pytest.raises(RecordingError, match="no column is the voltage or duty: .* --constant-voltage V for a log"):
            find_roles(table(**columns), Said())


def test_of_two_channels_in_volts_one_follows_the_other() -> None:
    cells = {"Second": TIME - 1.0, "CH1 [Volt]": answer(DRIVE), "CH2 [Volt]": DRIVE}
    roles = find_roles(Table(Path("log.csv"), np.arange(2, 202), cells), Said())
    assert (roles.time, roles.pairs) == ("Second", (Pair("", "CH2 [Volt]", "CH1 [Volt]"),))
    assert "CH2 [Volt] drives and CH1 [Volt] moves" in roles.findings[0]
    with pytest.raises(RecordingError, match=r"one of CH1 \[Volt\], CH2 \[Volt\]"):  # both the same
        find_roles(Table(Path("log.csv"), np.arange(2, 202), {**cells, "CH1 [Volt]": DRIVE}), Said())


@pytest.mark.parametrize(("turn", "told"), [(2.0 * np.pi, True), (6.0, False)])
def test_an_encoders_angle_is_no_drive_however_seldom_it_changes(turn: float, told: bool) -> None:
    """A loop holds an angle of 1,000 counts a turn: what its controller puts out changes in nearly every row."""
    time = np.arange(4000) * 0.001
    counts = np.rint(5000.0 * (time % 2.0 > 1.0) * (1.0 - np.exp(-20.0 * (time % 1.0))))
    angle, output = counts * turn / 1000.0, np.random.default_rng(1).normal(0.0, 5.0, len(time)).round(3)
    cells = {"t": time, "Data": output, "Data2": angle}
    (pair,) = find_roles(Table(Path("log.csv"), np.arange(2, 4002), cells), Said()).pairs
    assert pair == (Pair("", "Data", "Data2") if told else Pair("", "Data2", "Data"))
    untimed = Table(Path("log.csv"), np.arange(2, 4002), {"Data": output, "Data2": angle})
    with pytest.raises(RecordingError, match="Data2 is a position, and no column is its times" if told else "--unit"):
        guess_forms(untimed, Said())
