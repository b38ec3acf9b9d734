"""Control a motor's speed as a ROS node: answer the newest motor/speed, and leave the motor at 0 V in the end."""

import time
from dataclasses import replace

from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray
from rcl_interfaces.msg import SetParametersResult
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.parameter import Parameter
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Header
from std_srvs.srv import Trigger

from motor_control.announcements import Told, announce, describe_start
from motor_control.controller import controller
from motor_control.controller.output import Output
from motor_control.controller.reference.demand import Kind
from motor_control.messages import control_state_message, diagnostics_message, joint_demand_of
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
        self._header = Header()  # of the latest sample
        self._output, self._told = controller.WAITING, Told()
        self._answered, self._worst, self._speakers = 0, 0.0, 0  # since the last diagnostics; who publishes motor/speed
        self._voltage = self.create_publisher(MotorVoltage, "motor/voltage", qos.VOLTAGE)
        self._control_state = self.create_publisher(ControlState, "motor/control_state", qos.CONTROL_STATE)
        self._diagnostics = self.create_publisher(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
        self.create_subscription(MotorSpeed, "motor/speed", self._on_speed, qos.newest(qos.SPEED))
        self.create_subscription(MotorInfo, "motor/info", self._on_info, qos.INFO)
        self.create_subscription(Float64, "motor/reference", self._on_reference, qos.REFERENCE)
        self.create_subscription(Float64, "motor/position_reference", self._on_position_reference, qos.REFERENCE)
        self.create_subscription(JointState, "motor/joint_command", self._on_joint_command, qos.REFERENCE)
        self.create_service(Trigger, "motor/reset", lambda _, response: self._serve(controller.reset, response))
        self.create_service(Trigger, "motor/release", lambda _, response: self._serve(controller.release, response))
        steady = Clock(clock_type=ClockType.STEADY_TIME)  # goes on under use_sim_time and when the clock is set
        self.create_timer(WATCH_EVERY, self._on_watch, clock=steady)
        self.create_timer(1.0, self._on_second, clock=steady)
        self.add_on_set_parameters_callback(self._on_parameters)
        self.get_logger().info(describe_start(self._settings.config))

    def close(self) -> None:
        """Leave the motor at 0 V, and see that it arrives."""
        self._send(0.0, self._now())
        self._voltage.wait_for_all_acked(FAREWELL)

    def _on_speed(self, message: MotorSpeed) -> None:
        sample, now = sample_of(message), time.monotonic()
        output, self._state = controller.update(self._settings.config, self._state, sample, None, now)
        self._header = message.header
        self._answered, self._worst = self._answered + 1, max(self._worst, output.latency)
        self._publish(output, message.header.stamp)

    def _on_watch(self) -> None:
        self._settings.refresh()
        if (count := self.count_publishers("motor/speed")) != self._speakers:
            self._speakers, self._state = count, replace(self._state, speakers=self._name_senders("motor/speed"))
        several = self.count_publishers("motor/joint_command") > 1
        if several != bool(self._state.joint_senders):
            names = self._name_senders("motor/joint_command") if several else ""
            self._state = replace(self._state, joint_senders=names)
        output, self._state = controller.watch(self._settings.config, self._state, time.monotonic())
        if output is not None:
            self._header.stamp = self._now()
            self._publish(output, self._header.stamp)

    def _name_senders(self, topic: str) -> str:
        found = self.get_publishers_info_by_topic(self.resolve_topic_name(topic))
        return "(" + ", ".join(sorted(f"{one.node_namespace.rstrip('/')}/{one.node_name}" for one in found)) + ")"

    def _now(self) -> Time:
        return self.get_clock().now().to_msg()

    def _send(self, voltage: float, stamp: Time) -> None:
        self._voltage.publish(voltage_message(voltage, stamp, self._header.frame_id))

    def _publish(self, output: Output, stamp: Time) -> None:
        if output.begins:
            self._send(0.0, stamp)
        if output.drives:
            self._send(output.terms.voltage, stamp)
        self._output = output
        self._control_state.publish(control_state_message(output, self._header))
        say, config = self.get_logger(), self._settings.config
        demand = self._state.demand
        speed = demand.value if demand is not None and demand.kind is Kind.SPEED else None
        lines, self._told = announce(self._told, output, speed, config, time.monotonic())
        for line in lines:
            say.warning(line.text) if line.severe else say.info(line.text)

    def _on_reference(self, message: Float64) -> None:
        self._state = controller.refer(self._state, message.data, time.monotonic())

    def _on_position_reference(self, message: Float64) -> None:
        self._state = controller.refer(self._state, message.data, time.monotonic(), Kind.POSITION)

    def _on_joint_command(self, message: JointState) -> None:
        demand = joint_demand_of(message, self._settings.config)
        if demand is not None:
            self._state = controller.command_joint(self._settings.config, self._state, demand, time.monotonic())

    def _serve(self, change: controller.Change, response: Trigger.Response) -> Trigger.Response:
        response.success, (response.message, self._state) = True, change(self._state)
        return response

    def _on_info(self, message: MotorInfo) -> None:
        try:
            self._settings.meet(info_of(message))
        except MotorError as error:
            self._settings.refuse(f"{error} The motor gets 0 V until then.")

    def _on_parameters(self, changed: list[Parameter]) -> SetParametersResult:
        try:
            self._settings.change({parameter.name: parameter.value for parameter in changed})
        except MotorError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _on_second(self) -> None:
        name = f"{self.get_fully_qualified_name()}: {self._header.frame_id or 'no motor yet'}"
        rivals, config = self.count_publishers("motor/voltage"), self._settings.config
        message = diagnostics_message(self._output, config, self._answered, self._worst, rivals, name)
        message.header.stamp = self._now()
        self._diagnostics.publish(message)
        self._answered, self._worst = 0, 0.0


def main(args: list[str] | None = None) -> int:
    """`ros2 run motor_control motor_control`."""
    return run(MotorControl, args, quick_executor, PROGRAM)
