"""The shell that simulated and real motor share, so that they swap: topics, QoS, services, parameters."""

import time
from collections.abc import Callable
from math import tau

from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.node import Node
from sensor_msgs.msg import JointState
from std_srvs.srv import SetBool

from motor_model.sample import Info, Sample
from motor_msgs.msg import MotorInfo, MotorSpeed, MotorVoltage
from motor_ros import qos
from motor_ros.gate import Gate
from motor_ros.messages import info_message, speed_message
from motor_ros.parameters import Row

SHARED_PARAMETERS = (
    Row("name", "motor", "the motor's name: frame_id of its samples, joint of joint_states", read_only=True),
    Row("sample_rate", 200.0, "samples per second", "Hz", 10.0, 1000.0, read_only=True),
    Row("edges_per_revolution", 96, "encoder edges of one polarity per turn", "", 1, 100_000, read_only=True),
    Row("single_channel", True, "the encoder has one channel and does not measure direction", read_only=True),
    Row("command_timeout", 0.1, "without a command for this long the motor gets 0 V", "s", 0.005, 10.0, read_only=True),
    Row("enabled_at_start", True, "false: the output stays off until motor/enable", read_only=True),
)


def max_voltage_row(default: float = 12.0) -> Row:
    """The shared parameter whose default a model file may set."""
    return Row(
        "max_voltage", default, "voltage at full duty; commands are limited to it", "V", 0.1, 100.0, read_only=True
    )


class Plant:
    """Topics, services and the gate of one motor, on a node that says when to sample."""

    def __init__(
        self,
        node: Node,
        info: Info,
        gate: Gate,
        refusal: Callable[[], str] = str,
        changed: Callable[[], None] = lambda: None,
    ) -> None:
        """`refusal` says why the output cannot be switched on now, `changed` is called after a command or a switch."""
        self._node, self.info, self.gate = node, info, gate
        self._refusal, self._changed = refusal, changed
        self._angle, self._count = 0.0, 0
        self._speed = node.create_publisher(MotorSpeed, "motor/speed", qos.SPEED)
        self._info = node.create_publisher(MotorInfo, "motor/info", qos.INFO)
        self._joint = node.create_publisher(JointState, "joint_states", qos.JOINT_STATES)
        self._diagnostics = node.create_publisher(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
        node.create_subscription(MotorVoltage, "motor/voltage", self._on_voltage, qos.VOLTAGE)
        node.create_service(SetBool, "motor/enable", self._on_enable)
        self.publish_info()

    def now(self) -> int:
        """[ns] ROS time."""
        return int(self._node.get_clock().now().nanoseconds)

    def voltage(self) -> float:
        """[V] to apply now; the age of commands is judged by a clock that is never set."""
        return self.gate.voltage(time.monotonic_ns())

    def recount(self) -> None:
        """The board has started anew and counts edges from 0 again."""
        self._count = 0

    def publish_info(self) -> None:
        """Say how the samples are to be read; call again when that changes."""
        self._info.publish(info_message(self.info, self._node.get_clock().now().to_msg()))

    def publish(self, sample: Sample, stamp: Time) -> None:
        """Send one sample, and the joint state that viewers draw."""
        self._speed.publish(speed_message(sample, stamp, self.info.name))
        turned = sample.edge_count - self._count
        if self.info.single_channel and sample.speed < 0.0:
            turned = -turned
        self._angle += turned * tau / self.info.edges_per_revolution
        self._count = sample.edge_count
        joint = JointState(name=[self.info.name], position=[self._angle], velocity=[sample.speed])
        joint.header.stamp = stamp
        self._joint.publish(joint)

    def diagnose(self, problem: str, values: dict[str, str]) -> None:
        """Send one diagnostic status: OK if `problem` is empty, with the gate's state and these values."""
        status = DiagnosticStatus(
            level=DiagnosticStatus.WARN if problem else DiagnosticStatus.OK,
            name=f"{self._node.get_fully_qualified_name()}: {self.info.name}",
            hardware_id=self.info.name,
            message=problem or self.gate.state(time.monotonic_ns()),
            values=[KeyValue(key=key, value=value) for key, value in values.items()],
        )
        array = DiagnosticArray(status=[status])
        array.header.stamp = self._node.get_clock().now().to_msg()
        self._diagnostics.publish(array)

    def _on_voltage(self, message: MotorVoltage) -> None:
        refused = self.gate.refused
        self.gate = self.gate.take(message.voltage, time.monotonic_ns())
        if self.gate.refused > refused:
            self._node.get_logger().error(
                f"a voltage of {message.voltage} on motor/voltage stops the motor: send numbers.",
                throttle_duration_sec=1.0,
            )
        self._changed()

    def _on_enable(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        refusal = self._refusal() if request.data else ""
        if refusal:
            response.success, response.message = False, f"the output stays off: {refusal}"
            return response
        self.gate = self.gate.enable(request.data)
        self._changed()
        response.success = True
        response.message = "output on" if request.data else "output off until motor/enable is called with data: true"
        return response
