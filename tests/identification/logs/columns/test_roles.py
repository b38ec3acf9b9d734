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
KINDS = {"t": TIME, "u": DRIVE, "y": MOVED, "b": 12.0 - 0.01 * np.abs(DRIVE), "r": 2.0 * DRIVE, "0": np.zeros(200)}


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


def test_without_names_by_how_numbers_behave() -> None:
    roles = find_roles(table(**{"column 1": "t", "column 2": "y", "column 3": "u", "column 4": "0"}), Said())
    assert (roles.time, roles.pairs) == ("column 1", (Pair("", "column 3", "column 2"),))


@pytest.mark.parametrize(
    ("columns", "complaint"),
    [
        ({"t": "t", "speed_a": "y", "speed_b": "y", "u": "u"}, "the speed? Say --speed and one of speed_a, speed_b."),
        ({"t": "t", "x": "y", "z": "y", "u": "u"}, "the motion? Say --speed, --position or --count and one of x, z."),
        ({"t": "t", "speed": "y"}, "which column is the voltage or duty? Say --voltage and one of"),
        ({"a": "y", "b": "y", "c": "t"}, "which column is the voltage or duty? Say --voltage and one of a, b."),
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
