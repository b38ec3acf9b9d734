"""The stage on which programs are started and listened to, for `faults_live.py`: one motor, plants, controllers."""

import signal
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from subprocess import PIPE, Popen
from typing import Any

sys.path.append(str(Path(__file__).resolve().parents[1] / "tests" / "support"))

from diagnostic_msgs.msg import DiagnosticArray
from faults_loop import Moment
from faults_motor import MOTORS
from workbench import ENVIRONMENT, Bench, program, quit_all, start

from motor_model.model_file import save
from motor_msgs.msg import ControlState, MotorSpeed, MotorVoltage
from motor_ros import qos
from motor_ros.messages import time_message, voltage_message

MOTOR = MOTORS[2]
STOOD, PATIENCE = 1.5, 60.0  # [s]


@dataclass
class Stage:
    """Programs, and what is heard of every plant among them."""

    folder: Path
    bench: Bench = field(default_factory=Bench)
    programs: list[Any] = field(default_factory=list)
    moments: list[Moment] = field(default_factory=list)
    said: list[str] = field(default_factory=list)
    names: set[str] = field(default_factory=set)  # of the plants: a recording that is played speaks for another
    sent: float | None = None  # [V] on motor/voltage, every 5 ms
    environment: dict[str, str] = field(default_factory=dict)  # of programs that are started with more than ours
    since: int = 0  # [ns] ROS time before which a sample was made that is not listened to

    def __post_init__(self) -> None:
        self.model = self.folder / "model.yaml"
        save(self.model, MOTOR.parameters())
        self.bench.node.create_subscription(DiagnosticArray, "/diagnostics", self._on_diagnostics, qos.DIAGNOSTICS)
        self._voltage: Any = None
        self._topics: set[str] = set()

    def plant(self, name: str = "motor", namespace: str = "") -> None:
        """Start a simulated motor, and listen to it."""
        self.follow_samples(name, f"{namespace}/motor/speed" if namespace else "motor/speed")
        options = ["-r", f"__ns:=/{namespace}"] if namespace else []
        values = ("-p", f"name:={name}", "-p", f"model:={self.model}", "-p", "single_channel:=false")
        self.run("motor_sim", "motor_sim", "--ros-args", *options, *values)

    def board(self, name: str = "motor") -> None:
        """Start the emulated board and its driver, and listen to that."""
        self.follow_samples(name, "motor/speed")
        link = self.folder / "board"
        self.run("motor_board", "board_emulator", "--ros-args", "-p", f"link:={link}")
        self.until(link.exists, "the board")
        self.run("motor_driver", "motor_driver", "--ros-args", "-p", f"port:={link}", "-p", f"name:={name}")

    def follow_samples(self, name: str, topic: str) -> None:
        """Listen to a plant of a name."""
        self.names.add(name)
        if topic not in self._topics:
            self._topics.add(topic)
            self.bench.node.create_subscription(MotorSpeed, topic, self._on_speed, qos.SPEED)

    def controller(self, namespace: str = "", *others: str) -> None:
        """Start a controller, with other arguments of ROS, and listen to it."""
        topic = f"{namespace}/motor/control_state" if namespace else "motor/control_state"
        self.bench.node.create_subscription(ControlState, topic, self._on_state, qos.CONTROL_STATE)
        options = ["-r", f"__ns:=/{namespace}"] if namespace else []
        values = ("-p", "latency_limit:=0.5", "-p", "reference_timeout:=2.0")
        self.run("motor_control", "motor_control", "--ros-args", *options, *values, *others)

    def run(self, package: str, command: str, *arguments: object) -> Any:
        """Start a program."""
        self.programs.append(self._start(package, command, *arguments))
        return self.programs[-1]

    def _start(self, package: str, command: str, *arguments: object) -> Any:
        """Start a program; where its environment is one of its own, no fork of a process that has another."""
        if not self.environment:
            return start(package, command, *arguments)
        words, environment = [program(package, command), *map(str, arguments)], {**ENVIRONMENT, **self.environment}
        return Popen(words, env=environment, stdout=PIPE, stderr=PIPE, text=True)

    def until(self, condition: Callable[[], bool], what: str) -> None:
        """Hear what comes until it holds."""
        self.bench.wait(condition, what, PATIENCE)

    def hear(self, seconds: float) -> None:
        """Hear what comes, and send what is to be sent."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.bench.executor.spin_once(timeout_sec=0.005)

    def send(self, voltage: float) -> None:
        """Send a voltage [V] from now on, from 0 V on."""
        self._voltage = self.bench.publisher(MotorVoltage, "motor/voltage", qos.VOLTAGE)
        self.bench.heard(self._voltage)
        self.sent = 0.0
        self.bench.node.create_timer(0.005, self._send)
        self.hear(0.2)
        self.sent = voltage
        self.until(lambda: self.moments[-1].voltage == voltage, "motion")

    def stand_still(self, program: Any, meanwhile: Callable[[], None] = lambda: None) -> None:
        """Stop a program as Ctrl-Z does, and let it go on."""
        program.send_signal(signal.SIGSTOP)
        meanwhile()
        self.hear(STOOD)
        program.send_signal(signal.SIGCONT)

    def close(self) -> None:
        """End it all."""
        self.bench.close()
        quit_all(self.programs)
        for one in self.programs:
            self.said += one.communicate()[1].splitlines()

    def _on_speed(self, message: MotorSpeed) -> None:
        stamp = message.header.stamp
        if message.header.frame_id in self.names and stamp.sec * 10**9 + stamp.nanosec >= self.since:
            self.moments.append(Moment(time.monotonic(), message.voltage, message.speed, ""))

    def _on_state(self, message: ControlState) -> None:
        if message.reason:
            self.said.append(message.reason)

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        self.said += [status.message for status in message.status]

    def _send(self) -> None:
        self._voltage.publish(voltage_message(self.sent or 0.0, time_message(0), "user"))


@contextmanager
def stage() -> Iterator[Stage]:
    """A stage that is cleared in the end."""
    with tempfile.TemporaryDirectory() as folder:
        one = Stage(Path(folder))
        try:
            yield one
        finally:
            one.close()
