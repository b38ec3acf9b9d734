"""Parameters that are set to and fro in a running loop; whoever does that blinds the checks that read them."""

from dataclasses import fields, replace

import pytest
from bench_board import DEFAULTS, motor

from motor_control.configuration import Value, config_of
from motor_control.parameters import ROWS
from motor_control.toggles import Toggles
from motor_model.sample import Info

CHECKED = {row.name: row for row in ROWS if row.checked}
# What no check reads: how the law is set, and what is only said. The rest of a configuration has to be in the table.
UNCHECKED = {"gains", "resting", "reference_rate_limit", "gentle", "feedforward", "position", "note"}
UNCHECKED |= {"joint", "effort_as_voltage"}
OTHERS: dict[str, Value] = {"speed_source": "observer", "model": "another.yaml", "feedforward": True, "joint": "wheel"}
OTHERS |= {"effort_as_voltage": True}


def other(name: str) -> Value:
    """Another value than the default."""
    if name in OTHERS:
        return OTHERS[name]
    default = DEFAULTS[name]
    assert isinstance(default, int | float)
    return 0.6 * default + 0.013


def toggle(name: str, every: float, times: int = 4) -> list[str]:
    """What is said at each change."""
    said, (_, toggles) = [], Toggles(CHECKED).see(DEFAULTS, 0.0)
    for k in range(1, times + 1):
        why, toggles = toggles.see({name: other(name) if k % 2 else DEFAULTS[name]}, every * k)
        said.append(why)
    return said


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.name)
def test_what_a_check_reads_is_in_the_table(row: object) -> None:
    """All that a parameter changes in the configuration, but for the law's own settings, some check goes by."""
    name = row.name  # type: ignore[attr-defined]
    model, info = motor(), Info(single_channel=False)
    base = DEFAULTS | {"speed_source": "observer"} if name == "slot_irregularity" else DEFAULTS
    values = base if name == "model" else base | {name: other(name)}
    before, after = config_of(base, info, model), config_of(values, info, None if name == "model" else model)
    changed = {field.name for field in fields(before) if getattr(before, field.name) != getattr(after, field.name)}
    assert bool(changed - UNCHECKED) == (name in CHECKED), changed


@pytest.mark.parametrize("name", CHECKED)
def test_the_third_turn_within_a_second_of_the_one_before_is_said(name: str) -> None:
    for every in (0.001, 0.05, 0.3, 0.99):
        said = toggle(name, every)
        assert said[:3] == ["", "", ""] and said[3].startswith(f"{name} was set to and fro 3 times"), every
    assert toggle(name, 1.01, 40) == [""] * 40


@pytest.mark.parametrize("name", [row.name for row in ROWS if not row.checked])
def test_gains_may_be_set_by_a_program(name: str) -> None:
    assert toggle(name, 0.01, 20) == [""] * 20


def test_a_slider_that_is_drawn_and_a_value_that_is_said_again_are_no_turns() -> None:
    _, toggles = Toggles(CHECKED).see(DEFAULTS, 0.0)
    for k in range(100):
        why, toggles = toggles.see({"voltage_limit": 12.0 - 0.1 * (k // 2), "stall_time": 0.5}, 0.01 * k)
        assert why == ""


def test_each_further_turn_is_said_again() -> None:
    assert [bool(why) for why in toggle("stall_time", 0.1, 7)] == [False, False, False, True, True, True, True]
    _, toggles = Toggles(CHECKED).see(DEFAULTS, 0.0)
    for k in range(1, 6):
        _, toggles = toggles.see({"stall_time": 0.5 * (k % 2)}, 0.1 * k)
    assert toggles.see({"plug_limit": 2.0}, 0.6)[0] == ""  # another one, and for the first time
    assert replace(toggles, checked=()).see({"stall_time": 0.0}, 0.7)[0] == ""
