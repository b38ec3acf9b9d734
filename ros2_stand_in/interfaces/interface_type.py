"""Type names such as `std_msgs/msg/Float64`, and the Python classes they stand for."""

from typing import Any

from motor_model.errors import MotorError
from motor_ros import interface_types
from ros2_stand_in.interfaces import packages


def load(name: str, kind: str) -> Any:
    """The class of a message, service or action type; `kind` is msg, srv or action and may be left out of the name.

    Raises:
        MotorError: there is no such type.
    """
    parts = name.split("/")
    if len(parts) == 2:
        parts.insert(1, kind)
    if len(parts) != 3 or parts[1] != kind:
        raise MotorError(f"'{name}' is not a {kind} type name; one looks like {_EXAMPLES[kind]}.")
    packages.definition("/".join(parts))
    return interface_types.load("/".join(parts))


_EXAMPLES = {"msg": "std_msgs/msg/Float64", "srv": "std_srvs/srv/SetBool", "action": "motor_msgs/action/Diagnose"}
