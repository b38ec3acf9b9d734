"""A plant that a test owns, a user beside it, and the controller as a process: what the tests of nodes share here."""

import os
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import rclpy
from ament_index_python.packages import get_package_prefix
from diagnostic_msgs.msg import DiagnosticArray
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from rclpy.executors import SingleThreadedExecutor
from std_msgs.msg import Float64

from motor_model.sample import Info, Sample
from motor_msgs.msg import ControlState, MotorInfo, MotorSpeed, MotorVoltage
from motor_ros import qos
from motor_ros.messages import info_message, speed_message, time_message

PATIENCE = 10.0  # [s] for what is expected; a test that passes never waits so long
SAMPLE_NS = 5_000_000
DOMAIN = os.environ.get("ROS_DOMAIN_ID") or str(10 + os.getpid() % 90)
ENVIRONMENT = {**os.environ, "ROS_DOMAIN_ID": DOMAIN, "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}


class FakePlant:
    """Speaks `motor/speed` and `motor/info`, hears everything the controller says, and is a user at the same time."""

    def __init__(self, namespace: str = "") -> None:
        os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
        self._context = rclpy.Context()
        rclpy.init(context=self._context, domain_id=int(DOMAIN))
        self.node = rclpy.create_node("fake_plant", context=self._context, namespace=namespace or None)
        self.executor = SingleThreadedExecutor(context=self._context)
        self.executor.add_node(self.node)
        self._speed = self.node.create_publisher(MotorSpeed, "motor/speed", qos.SPEED)
        self._info = self.node.create_publisher(MotorInfo, "motor/info", qos.INFO)
        self._reference = self.node.create_publisher(Float64, "motor/reference", qos.REFERENCE)
        self.voltages: list[MotorVoltage] = []
        self.states: list[ControlState] = []
        self.diagnostics: list[DiagnosticArray] = []
        hear = self.node.create_subscription
        hear(MotorVoltage, "motor/voltage", self.voltages.append, qos.VOLTAGE)
        hear(ControlState, "motor/control_state", self.states.append, qos.CONTROL_STATE)
        hear(DiagnosticArray, "/diagnostics", self.diagnostics.append, qos.DIAGNOSTICS)
        self.time = 0  # [ns]

    def close(self) -> None:
        self.executor.shutdown()
        self.node.destroy_node()
        rclpy.shutdown(context=self._context)

    def wait(self, condition: Callable[[], bool], what: str, patience: float = PATIENCE) -> None:
        """Hear messages until the condition holds."""
        end = time.monotonic() + patience
        while not condition():
            assert time.monotonic() < end, f"still waiting for {what}"
            self.executor.spin_once(timeout_sec=0.05)

    def meet(self) -> None:
        """Send samples until the controller hears everything and is heard."""
        publishers = (self._speed, self._info, self._reference)
        self.wait(lambda: all(publisher.get_subscription_count() for publisher in publishers), "the controller")

        def heard() -> bool:
            self.say(0.0)
            return bool(self.states)

        self.wait(heard, "an answer")
        self.answer(0.0)

    def refer(self, reference: float) -> None:
        """One message on `motor/reference`, and the first sample that is answered with it in force."""
        self._reference.publish(Float64(data=reference))
        same = (lambda shown: shown != shown) if reference != reference else (lambda shown: shown == reference)
        self.wait(lambda: same(self.answer(0.0).reference), f"reference {reference}")

    def say(self, speed: float) -> None:
        """One sample, 5 ms after the last."""
        self.time += SAMPLE_NS
        self._speed.publish(speed_message(Sample(self.time, speed, 0.0), time_message(self.time), "wheel"))

    def answer(self, speed: float) -> ControlState:
        """What the controller answers to one more sample; without a reference it leaves the voltage to others."""
        count = len(self.voltages)
        self.say(speed)
        stamp = time_message(self.time)
        self.wait(lambda: bool(self.states) and self.states[-1].header.stamp == stamp, "an answer to a sample")
        if self.states[-1].state == "disabled":
            assert len(self.voltages) == count
            return self.states[-1]
        self.wait(lambda: len(self.voltages) > count and self.voltages[-1].header.stamp == stamp, "a voltage")
        assert self.voltages[-1].voltage == self.states[-1].voltage
        return self.states[-1]

    def tell(self, info: Info, measurement: str = "edges") -> None:
        """What `motor/info` says, in whatever words for the kind of measurement."""
        message = info_message(info, time_message(self.time))
        message.measurement = measurement
        self._info.publish(message)

    def call(self, kind: type, name: str, request: object) -> object:
        """The response of a service."""
        client = self.node.create_client(kind, name)
        self.wait(client.service_is_ready, name)
        future = client.call_async(request)
        self.wait(future.done, f"an answer of {name}")
        self.node.destroy_client(client)
        return future.result()

    def set(self, name: str, value: float) -> tuple[bool, str]:
        """Whether a parameter could be set, and what was said about it."""
        number = ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=value)
        request = SetParameters.Request(parameters=[Parameter(name=name, value=number)])
        result = self.call(SetParameters, "motor_control/set_parameters", request).results[0]  # type: ignore[attr-defined]
        return result.successful, result.reason


def start_controller(*arguments: str) -> subprocess.Popen[str]:
    program = Path(get_package_prefix("motor_control")) / "lib/motor_control/motor_control"
    return subprocess.Popen(
        [program, "--ros-args", *arguments], env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )


def end(process: subprocess.Popen[str]) -> tuple[str, float]:
    """Ctrl-C: what it wrote, and how long it took [s]."""
    begin = time.monotonic()
    process.send_signal(signal.SIGINT)
    try:
        out, err = process.communicate(timeout=PATIENCE)
    finally:
        process.kill()
    return out + err, time.monotonic() - begin
