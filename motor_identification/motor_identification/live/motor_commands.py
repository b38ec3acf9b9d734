"""Tell which topics of a bag command a motor when they are played, and what leaves it at rest afterwards."""

from collections.abc import Callable, Mapping
from copy import deepcopy
from typing import Any

Rest = Callable[[Any], Any]  # of the last message: one that asks for no motion


def _no_voltage(message: Any) -> Any:
    message.voltage = 0.0
    return message


def _no_joint_motion(message: Any) -> Any:
    message.velocity, message.effort = [0.0] * len(message.velocity), [0.0] * len(message.effort)
    return message


def _nothing(message: Any) -> Any:
    return type(message)()


def _hold(message: Any) -> Any:
    return message  # an angle: any other one would be a motion


# By type, and by how the topic's name ends. Who hears them holds the last one for ever, or for a timeout that may be 0.
COMMANDS: Mapping[str, tuple[tuple[str, Rest], ...]] = {
    "motor_msgs/msg/MotorVoltage": (("", _no_voltage),),
    "std_msgs/msg/Float64": (("/motor/reference", _nothing), ("/motor/position_reference", _hold)),
    "sensor_msgs/msg/JointState": (("/motor/joint_command", _no_joint_motion),),
    "geometry_msgs/msg/Twist": (("/cmd_vel", _nothing),),
    "geometry_msgs/msg/TwistStamped": (("/cmd_vel", _nothing),),
}


def find_rest(type_name: str, topic: str) -> Rest | None:
    """Find what makes a topic's last message one that asks for no motion; None: it commands no motor."""
    return next((rest for ending, rest in COMMANDS.get(type_name, ()) if topic.endswith(ending)), None)


def message_of_rest(rest: Rest, last: Any) -> Any | None:
    """Make the message that leaves the motor at rest after the last one; None: that one does."""
    message = rest(deepcopy(last))
    return None if rest is _hold or message == last else message
