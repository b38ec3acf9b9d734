"""A plant that a test owns, and a user beside it: what the tests of the controller node share."""

import subprocess
from collections.abc import Iterator

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from patience import PATIENCE
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from rclpy.duration import Duration
from std_msgs.msg import Float64
from workbench import Bench, end, start

from motor_control.settings import UNHEARD
from motor_model.sample import Info, Sample
from motor_msgs.msg import ControlState, MotorInfo, MotorSpeed, MotorVoltage
from motor_ros import qos
from motor_ros.messages import info_message, speed_message, time_message

SAMPLE_NS = 5_000_000
# A busy machine does not interrupt, nor a plant whose time is slower than ours.
PATIENT = ("--ros-args", "-p", "sample_timeout:=5.0", "-p", "latency_limit:=10.0")


class FakePlant(Bench):
    """Speaks `motor/speed` and `motor/info`, hears everything the controller says, and is a user at the same time."""

    def __init__(self, namespace: str = "") -> None:
        super().__init__(namespace)
        self._speed = self.publisher(MotorSpeed, "motor/speed", qos.SPEED)
        self._info = self.publisher(MotorInfo, "motor/info", qos.INFO)
        self._reference = self.publisher(Float64, "motor/reference", qos.REFERENCE)
        self.voltages: list[MotorVoltage] = self.hear(MotorVoltage, "motor/voltage", qos.VOLTAGE)
        self.states: list[ControlState] = self.hear(ControlState, "motor/control_state", qos.CONTROL_STATE)
        self.diagnostics: list[DiagnosticArray] = self.hear(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
        self.time = 0  # [ns]
        self.enabled = True
        self.told = False  # it has said on motor/info what it is

    def meet(self) -> None:
        """Send samples until the controller hears everything and is heard."""
        self.heard(self._speed, self._info, self._reference)
        if not self.told:
            self.tell(Info(name="wheel"), measurement="speed")  # it has no edges
        self.await_controller()
        self.answer(0.0)

    def await_controller(self) -> None:
        """Send samples until a controller answers that has heard `motor/info`: before that it is stopped, and silent.

        Whoever comes late gets that message once more, and may get the first samples before it.
        """

        def heard() -> bool:
            self.say(0.0)
            return any(one.state != "no_samples" and one.reason != UNHEARD for one in self.states)

        self.wait(heard, "an answer")

    def start_again(self) -> None:
        """Publish samples as another process would, which goes on with the board's clock."""
        self.node.destroy_publisher(self._speed)
        self._speed = self.publisher(MotorSpeed, "motor/speed", qos.SPEED)
        self.heard(self._speed)

    def refer(self, reference: float) -> None:
        """One message on `motor/reference`, and the first sample that is answered with it in force."""
        self._reference.publish(Float64(data=reference))
        same = (lambda shown: shown != shown) if reference != reference else (lambda shown: shown == reference)
        self.wait(lambda: same(self.answer(0.0).reference), f"reference {reference}")

    def refer_anew(self, reference: float) -> None:
        """The same where an earlier reference has ended just now: they begin again with 0."""
        self.refer(0.0)
        self.refer(reference)

    def say(self, speed: float) -> None:
        """One sample, 5 ms after the last, that applies what was asked for."""
        voltage = self.voltages[-1].voltage if self.voltages and self.enabled else 0.0
        self.send(Sample(self.time + SAMPLE_NS, speed, voltage))

    def send(self, sample: Sample) -> None:
        """A sample of the test's own."""
        self.time = sample.sample_time
        self._speed.publish(speed_message(sample, time_message(self.time), "wheel"))

    def answer(self, speed: float) -> ControlState:
        """What the controller answers to one more sample; without a reference it leaves the voltage to others."""
        count = len(self.voltages)
        self.say(speed)
        return self.heard_back(count)

    def ask(self, speed: float) -> ControlState:
        """What the controller says of one more sample, whether or not it sends a voltage."""
        self.say(speed)
        stamp = time_message(self.time)
        self.wait(lambda: bool(self.states) and self.states[-1].header.stamp == stamp, "an answer to a sample")
        return self.states[-1]

    def heard_back(self, count: int) -> ControlState:
        """The answer to the latest sample; `count` voltages had come before it."""
        stamp = time_message(self.time)
        self.wait(lambda: bool(self.states) and self.states[-1].header.stamp == stamp, "an answer to a sample")
        if self.states[-1].state == "disabled":
            assert all(message.voltage == 0.0 for message in self.voltages[count:])
            return self.states[-1]
        self.wait(lambda: len(self.voltages) > count and self.voltages[-1].header.stamp == stamp, "a voltage")
        assert self.voltages[-1].voltage == self.states[-1].voltage
        return self.states[-1]

    def assign(self, name: str, value: str | bool) -> tuple[bool, str]:
        """Set a parameter that is no number; see `set`."""
        kind = ParameterType.PARAMETER_BOOL if isinstance(value, bool) else ParameterType.PARAMETER_STRING
        held = ParameterValue(type=kind, bool_value=value is True, string_value=value if isinstance(value, str) else "")
        request = SetParameters.Request(parameters=[Parameter(name=name, value=held)])
        result = self.call(SetParameters, "motor_control/set_parameters", request, keep=True).results[0]
        return result.successful, result.reason

    def tell(self, info: Info, measurement: str = "edges") -> None:
        """What `motor/info` says, in whatever words for the kind of measurement."""
        message = info_message(info, time_message(self.time))
        message.measurement = measurement
        self.told = True
        self._info.publish(message)
        self._info.wait_for_all_acked(Duration(seconds=PATIENCE))  # before the next sample is


@pytest.fixture
def plant() -> Iterator[FakePlant]:
    plant = FakePlant()
    yield plant
    plant.close()


@pytest.fixture
def process(plant: FakePlant) -> Iterator[subprocess.Popen[str]]:
    """A controller that hears the plant and is heard."""
    process = start("motor_control", "motor_control", *PATIENT)
    try:
        plant.meet()
        yield process
    finally:
        if process.poll() is None:
            end(process)
            assert process.returncode == 0
