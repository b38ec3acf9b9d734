"""The controller as a ROS node: it answers each message of motor/speed, and leaves the motor at 0 V when it goes."""

import time

from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray
from rcl_interfaces.msg import SetParametersResult
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_msgs.msg import Float64, Header
from std_srvs.srv import Trigger

from motor_control.controller import controller
from motor_control.messages import control_state_message, diagnostics_message
from motor_control.parameters import PROGRAM, ROWS
from motor_control.settings import Settings
from motor_model.errors import MotorError
from motor_msgs.msg import ControlState, MotorInfo, MotorSpeed, MotorVoltage
from motor_ros import qos
from motor_ros.messages import info_of, sample_of, voltage_message
from motor_ros.parameters import declare
from motor_ros.run import quick_executor, run

WATCH_EVERY = 0.02  # [s]
FAREWELL = Duration(seconds=0.3)  # what the last 0 V may take to arrive


class MotorControl(Node):
    """Speed in, voltage out."""

    def __init__(self) -> None:
        super().__init__("motor_control")
        self._settings = Settings(declare(self, ROWS))
        self._state = controller.State(since=time.monotonic())
        self._reference: float | None = None
        self._header = Header()  # of the latest sample
        self._output = controller.WAITING
        self._answered = 0  # samples since the last diagnostics
        self._voltage = self.create_publisher(MotorVoltage, "motor/voltage", qos.VOLTAGE)
        self._control_state = self.create_publisher(ControlState, "motor/control_state", qos.CONTROL_STATE)
        self._diagnostics = self.create_publisher(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
        self.create_subscription(MotorSpeed, "motor/speed", self._on_speed, qos.SPEED)
        self.create_subscription(MotorInfo, "motor/info", self._on_info, qos.INFO)
        self.create_subscription(Float64, "motor/reference", self._on_reference, qos.REFERENCE)
        self.create_service(Trigger, "motor/reset", self._on_reset)
        self.create_timer(WATCH_EVERY, self._on_watch)
        self.create_timer(1.0, self._on_second)
        self.add_on_set_parameters_callback(self._on_parameters)

    def close(self) -> None:
        """Leave the motor at 0 V, and see that it arrives."""
        self._send(0.0, self._now())
        self._voltage.wait_for_all_acked(FAREWELL)

    def _on_speed(self, message: MotorSpeed) -> None:
        sample, now = sample_of(message), time.monotonic()
        output, self._state = controller.update(self._settings.config, self._state, sample, self._reference, now)
        self._header = message.header
        self._answered += 1
        if self._reference is not None:  # without one the motor is left to others, such as an experiment
            self._send(output.terms.voltage, message.header.stamp)
        self._show(output)

    def _on_watch(self) -> None:
        self._settings.refresh()
        first = self._state.silent is None
        output, self._state = controller.watch(self._settings.config, self._state, time.monotonic())
        if output is None:
            return
        self._header.stamp = self._now()
        if first and self._reference is not None:
            self._send(0.0, self._header.stamp)
        self._show(output)

    def _now(self) -> Time:
        return self.get_clock().now().to_msg()

    def _send(self, voltage: float, stamp: Time) -> None:
        self._voltage.publish(voltage_message(voltage, stamp, self._header.frame_id))

    def _show(self, output: controller.Output) -> None:
        self._output = output
        self._control_state.publish(control_state_message(output, self._header))

    def _on_reference(self, message: Float64) -> None:
        self._reference = message.data

    def _on_info(self, message: MotorInfo) -> None:
        try:
            self._settings.meet(info_of(message))
        except MotorError as error:
            self.get_logger().error(f"motor/info is not usable and left aside: {error}")

    def _on_reset(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        response.success = True
        response.message = f"Cleared: {self._state.latched}" if self._state.latched else "No stop was latched."
        self._state = controller.reset(self._state)
        return response

    def _on_parameters(self, changed: list[Parameter]) -> SetParametersResult:
        try:
            self._settings.change({parameter.name: parameter.value for parameter in changed})
        except MotorError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _on_second(self) -> None:
        name = f"{self.get_fully_qualified_name()}: {self._header.frame_id or 'no motor yet'}"
        rivals = self.count_publishers("motor/voltage")
        message = diagnostics_message(self._output, self._settings.config, self._answered, rivals, name)
        message.header.stamp = self._now()
        self._diagnostics.publish(message)
        self._answered = 0


def main(args: list[str] | None = None) -> int:
    """`ros2 run motor_control motor_control`."""
    return run(MotorControl, args, quick_executor, PROGRAM)
