"""A command for several joints: ours by its name, or nothing, or a sentence why nobody can tell."""

from math import inf, nan

import pytest

from motor_control.controller.reference.demand import Demand, Kind, Source
from motor_control.controller.reference.joint_command import Unreadable, read_joint_command

BOTH = ["left", "right"]


def test_the_value_beside_our_name_is_ours() -> None:
    assert read_joint_command(BOTH, [1.0, 2.0], [], "right", False) == Demand(2.0, Kind.SPEED, Source.JOINT)
    assert read_joint_command(["right"], [-2.0], [], "right", False) == Demand(-2.0, Kind.SPEED, Source.JOINT)
    assert read_joint_command(BOTH, [], [3.0, 4.0], "left", True) == Demand(3.0, Kind.VOLTAGE, Source.JOINT)
    assert read_joint_command(BOTH, [1.0, 2.0], [3.0, 4.0], "left", False) == Demand(1.0, Kind.SPEED, Source.JOINT)


@pytest.mark.parametrize("names", [[], ["arm"], ["Left"], ["left "], [""]])
def test_what_does_not_name_us_is_nothing(names: list[str]) -> None:
    assert read_joint_command(names, [nan] * len(names), [], "left", False) is None


@pytest.mark.parametrize(
    ("names", "velocity", "effort", "as_voltage", "words"),
    [
        (["left", "left"], [1.0, 1.0], [], False, "names the joint left 2 times"),
        (BOTH, [1.0], [], False, "2 names and 1 values of velocity"),  # a joint without that interface is left out
        (BOTH, [1.0, 2.0, 3.0], [], False, "2 names and 3 values"),
        (BOTH, [], [1.0, 2.0], False, "no velocity for the joint left"),
        (BOTH, [1.0, 2.0], [], True, "no effort for the joint left"),
        (BOTH, [nan, 2.0], [], False, "asks for nan rad/s"),
        (BOTH, [], [inf, 2.0], True, "asks for inf V"),
    ],
)
def test_what_cannot_be_told_is_a_sentence(
    names: list[str], velocity: list[float], effort: list[float], as_voltage: bool, words: str
) -> None:
    with pytest.raises(Unreadable, match=words):
        read_joint_command(names, velocity, effort, "left", as_voltage)
