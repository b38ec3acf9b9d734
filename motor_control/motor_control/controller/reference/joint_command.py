"""Read one motor's command out of a message for several joints, as ros2_control's topic-based hardware sends them.

Such a system lists all its joints by name, and beside them an array of velocities or of efforts, in the same order. It
leaves out of an array the joints that have no such interface: where an array is not as long as the names, nobody can
tell whose a value is.
"""

from collections.abc import Sequence
from math import isfinite

from motor_control.controller.reference.demand import UNITS, Demand, Kind, Source

TWICE = "motor/joint_command names the joint {} {} times: give every joint a name of its own."
UNCLEAR = (
    "motor/joint_command has {} names and {} values of {}, so that nobody can tell whose they are: give all joints of "
    "that system the same command interface."
)
NO_VALUE = "motor/joint_command has no {} for the joint {}: give it that command interface."
NOT_A_NUMBER = "motor/joint_command asks for {} {}: send a finite number."


class Unreadable(Exception):
    """A command for this motor that cannot be obeyed; its text is the sentence for people."""


def read_joint_command(
    names: Sequence[str], velocity: Sequence[float], effort: Sequence[float], joint: str, effort_as_voltage: bool
) -> Demand | None:
    """Find what is asked of a joint: its velocity [rad/s], or its effort [V]; None: it is not named.

    Raises:
        Unreadable: it is named, and what is asked of it cannot be told or done.
    """
    if joint not in names:
        return None
    if (count := list(names).count(joint)) > 1:
        raise Unreadable(TWICE.format(joint, count))
    kind, word, values = Kind.SPEED, "velocity", velocity
    if effort_as_voltage:
        kind, word, values = Kind.VOLTAGE, "effort", effort
    if len(values) == 0:
        raise Unreadable(NO_VALUE.format(word, joint))
    if len(values) != len(names):
        raise Unreadable(UNCLEAR.format(len(names), len(values), word))
    value = float(values[list(names).index(joint)])
    if not isfinite(value):
        raise Unreadable(NOT_A_NUMBER.format(value, UNITS[kind]))
    return Demand(value, kind, Source.JOINT)
