"""Publish what the controller answers: the voltage, its terms, once a second a diagnostic, and lines of the log."""

import time
from collections import Counter

from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.duration import Duration
from rclpy.node import Node
from std_msgs.msg import Header

from motor_control.announcements import Told, announce
from motor_control.controller.controller import WAITING
from motor_control.controller.output import Output
from motor_control.controller.reference.demand import Demand, Kind, Source
from motor_control.controller.run import Config
from motor_control.messages import control_state_message, diagnostics_message
from motor_msgs.msg import ControlState, MotorVoltage
from motor_ros import qos
from motor_ros.graph.publishers import count_publishers, publishers_of
from motor_ros.messages import voltage_message

FAREWELL = Duration(seconds=0.3)  # what the last 0 V may take to arrive


class Answers:
    """The publishers of a node, and what they have said so far."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._header = Header()  # of the latest sample
        self._output, self._told = WAITING, Told()
        self._missing, self._warned = "", ""  # who was missing at the latest diagnostic, as a sentence; what was logged
        self._answered, self._worst = 0, 0.0  # samples since the last diagnostic, and their largest latency [s]
        self._voltage = node.create_publisher(MotorVoltage, "motor/voltage", qos.VOLTAGE)
        self._control_state = node.create_publisher(ControlState, "motor/control_state", qos.CONTROL_STATE)
        self._diagnostics = node.create_publisher(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)

    def answer(self, output: Output, header: Header, config: Config, demand: Demand | None) -> None:
        """Publish the answer to a sample with this header."""
        self._header = header
        self._answered, self._worst = self._answered + 1, max(self._worst, output.latency)
        self._publish(output, config, demand)

    def announce_silence(self, output: Output, config: Config, demand: Demand | None) -> None:
        """Publish what is said while no sample comes."""
        self._header.stamp = self._now()
        self._publish(output, config, demand)

    def diagnose(self, config: Config, demand: Demand | None, missing: str, unheard: str) -> None:
        """Publish the diagnostic of the second that is over; demand: what is obeyed; missing: who is, a sentence.

        unheard: who asks for a motion and cannot be heard, likewise; the log has it already.
        """
        if missing and missing == self._missing and missing != self._warned:  # for a second: not only just discovered
            self._node.get_logger().warning(missing)
            self._warned = missing
        self._missing, self._warned = missing, self._warned if missing else ""
        name = f"{self._node.get_fully_qualified_name()}: {self._header.frame_id or 'no motor yet'}"
        rivals = count_publishers(self._node, "motor/voltage")
        referrers = self._referrers() if demand is not None and demand.source is Source.REFERENCE else []
        counted = self._answered, self._worst, rivals, referrers
        told = diagnostics_message(self._output, config, *counted, missing, unheard, name, self._now())
        self._diagnostics.publish(told)
        self._answered, self._worst = 0, 0.0

    def close(self) -> None:
        """Leave the motor at 0 V, and see that it arrives."""
        self._send(0.0, self._now())
        self._voltage.wait_for_all_acked(FAREWELL)

    def _referrers(self) -> list[str]:
        """Name the nodes that publish references; one that publishes both kinds counts once."""
        speeds, angles = (publishers_of(self._node, f"motor/{name}") for name in ("reference", "position_reference"))
        return sorted((Counter(speeds) | Counter(angles)).elements())

    def _publish(self, output: Output, config: Config, demand: Demand | None) -> None:
        stamp = self._header.stamp
        if output.begins:
            self._send(0.0, stamp)
        if output.drives:
            self._send(output.terms.voltage, stamp)
        self._output = output
        self._control_state.publish(control_state_message(output, self._header))
        speed = demand.value if demand is not None and demand.kind is Kind.SPEED else None
        lines, self._told = announce(self._told, output, speed, config, time.monotonic())
        say = self._node.get_logger()
        for line in lines:
            say.warning(line.text) if line.severe else say.info(line.text)

    def _send(self, voltage: float, stamp: Time) -> None:
        self._voltage.publish(voltage_message(voltage, stamp, self._header.frame_id))

    def _now(self) -> Time:
        return self._node.get_clock().now().to_msg()
