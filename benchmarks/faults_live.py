"""Faults that come between programs, injected live: the simulated plant's shell, and others as processes over ROS 2.

One motor (174 rad/s, 12 V) at 200 Hz. Time is the wall clock's, as a listener hears it, so that what a busy machine is
late by is in it; speeds are those that the plants report.
"""

import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

sys.path.append(str(Path(__file__).resolve().parents[1] / "tests" / "support"))

from diagnostic_msgs.msg import DiagnosticArray
from faults_loop import Moment, Outcome, outcome
from faults_motor import MOTORS
from geometry_msgs.msg import Twist
from std_msgs.msg import Float64
from workbench import Bench, program, quit_all, start

from motor_model.model_file import save
from motor_msgs.msg import ControlState, MotorSpeed, MotorVoltage
from motor_ros import qos
from motor_ros.messages import time_message, voltage_message

MOTOR = MOTORS[2]
KNOWN = 0.15  # [s] from when it could be known
WATCHED, STOOD, PATIENCE = 3.0, 1.5, 60.0  # [s]
Program = "subprocess.Popen[str]"


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

    def __post_init__(self) -> None:
        self.model = self.folder / "model.yaml"
        save(self.model, MOTOR.parameters())
        self.bench.node.create_subscription(DiagnosticArray, "/diagnostics", self._on_diagnostics, qos.DIAGNOSTICS)
        self._voltage: Any = None
        self._topics: set[str] = set()

    def plant(self, name: str = "motor", namespace: str = "") -> None:
        """Start a simulated motor, and listen to it."""
        topic = f"{namespace}/motor/speed" if namespace else "motor/speed"
        if topic not in self._topics:
            self._topics.add(topic)
            self.bench.node.create_subscription(MotorSpeed, topic, self._on_speed, qos.SPEED)
        self.names.add(name)
        options = ["-r", f"__ns:=/{namespace}"] if namespace else []
        values = ("-p", f"name:={name}", "-p", f"model:={self.model}", "-p", "single_channel:=false")
        self.run("motor_sim", "motor_sim", "--ros-args", *options, *values)

    def controller(self, namespace: str = "") -> None:
        """Start a controller, and listen to it."""
        topic = f"{namespace}/motor/control_state" if namespace else "motor/control_state"
        self.bench.node.create_subscription(ControlState, topic, self._on_state, qos.CONTROL_STATE)
        options = ["-r", f"__ns:=/{namespace}"] if namespace else []
        values = ("-p", "latency_limit:=0.5", "-p", "reference_timeout:=2.0")
        self.run("motor_control", "motor_control", "--ros-args", *options, *values)

    def run(self, package: str, command: str, *arguments: object) -> Any:
        """Start a program."""
        self.programs.append(start(package, command, *arguments))
        return self.programs[-1]

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
        if message.header.frame_id in self.names:
            self.moments.append(Moment(time.monotonic(), message.voltage, message.speed, ""))

    def _on_state(self, message: ControlState) -> None:
        if message.reason:
            self.said.append(message.reason)

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        self.said += [status.message for status in message.status]

    def _send(self) -> None:
        self._voltage.publish(voltage_message(self.sent or 0.0, time_message(0), "user"))


def recorded(stage: Stage) -> Path:
    """A recording of the same motor under steps of 12 V."""
    bag = stage.folder / "bag"
    words = [program("motor_identification", "experiment"), "rich", "--model", stage.model, "--output", bag]
    subprocess.run(list(map(str, words)), check=True, capture_output=True)
    return bag


def play_bag(stage: Stage) -> None:
    """All topics of a recording are played onto a plant that stands."""
    bag = recorded(stage)
    stage.plant("live")
    stage.until(lambda: len(stage.moments) > 50, "the plant")
    heard = stage.bench.hear(MotorVoltage, "motor/voltage")
    stage.run("motor_identification", "play", bag, "--rate", "1")
    stage.until(lambda: any(message.voltage for message in heard), "a voltage of the recording")


def start_second_plant(stage: Stage) -> None:
    """A second plant of the same names comes up beside one that is driven."""
    stage.plant()
    stage.until(lambda: len(stage.moments) > 50, "the plant")
    stage.send(6.0)
    infos = stage.bench.hear(MotorSpeed, "motor/speed")
    stage.plant("second")
    stage.until(lambda: any(message.header.frame_id == "second" for message in infos), "the second plant")


def resume_experiment(stage: Stage) -> None:
    """An experiment is stopped by Ctrl-Z in mid-run, and goes on."""
    stage.plant()
    stage.until(lambda: len(stage.moments) > 50, "the plant")
    one = stage.run("motor_identification", "experiment", "rich", "--output", stage.folder / "new")
    stage.until(lambda: abs(stage.moments[-1].voltage) > 1.0, "motion")
    stage.stand_still(one)


def refer_to_stopped_controller(stage: Stage) -> None:
    """A reference comes while the controller is stopped."""
    stage.plant()
    stage.controller()
    stage.until(lambda: len(stage.said) > 3 and len(stage.moments) > 50, "the loop")
    reference = stage.bench.publisher(Float64, "motor/reference", qos.REFERENCE)
    stage.bench.heard(reference)
    stage.stand_still(stage.programs[-1], lambda: reference.publish(Float64(data=0.5 * MOTOR.top)))


def drive_stopped_robot(stage: Stage) -> None:
    """A velocity comes while `diff_drive` is stopped."""
    for side in ("left", "right"):
        stage.plant(side, side)
        stage.controller(side)
    drive = stage.run("motor_examples", "diff_drive")
    command = stage.bench.publisher(Twist, "cmd_vel", qos.REFERENCE)
    stage.bench.heard(command)
    stage.until(lambda: any("/diff_drive" in one or "cmd_vel" in one for one in stage.said), "the drive")
    twist = Twist()
    twist.linear.x = 0.4
    stage.stand_still(drive, lambda: command.publish(twist))


def resume_play(stage: Stage) -> None:
    """Voltages of a recording are played, stopped by Ctrl-Z in mid-run, and go on."""
    bag = recorded(stage)
    stage.plant()
    stage.until(lambda: len(stage.moments) > 50, "the plant")
    play = stage.run("motor_identification", "play", bag, "--topics", "motor/voltage")
    stage.until(lambda: abs(stage.moments[-1].voltage) > 1.0, "motion")
    stage.stand_still(play)


@dataclass(frozen=True)
class LiveFault:
    """One fault; what is heard after it is judged, and of what is said the sentence with these words."""

    name: str
    apply: Callable[[Stage], None]
    words: str


LIVE_FAULTS = (
    LiveFault("a whole recording is played onto a plant", play_bag, "Another node publishes"),
    LiveFault("a second plant in one namespace, plain voltage", start_second_plant, "Another node publishes"),
    LiveFault("`experiment` stopped for 1.5 s (Ctrl-Z), and goes on", resume_experiment, "No sample was answered"),
    LiveFault("a controller stopped for 1.5 s, a reference meanwhile", refer_to_stopped_controller, "stood still"),
    LiveFault("`diff_drive` stopped for 1.5 s, a velocity meanwhile", drive_stopped_robot, "stood still"),
    LiveFault("`play` of voltages stopped for 1.5 s, and goes on", resume_play, "Playing stood still"),
)


@contextmanager
def stage() -> Iterator[Stage]:
    """A stage that is cleared in the end."""
    with tempfile.TemporaryDirectory() as folder:
        one = Stage(Path(folder))
        try:
            yield one
        finally:
            one.close()


def run_live(fault: LiveFault) -> Outcome:
    """What a fault does to the motors of running programs."""
    with stage() as one:
        fault.apply(one)
        begin = time.monotonic()
        one.hear(WATCHED)
    found = outcome(one.moments, begin)
    said = next((text for text in one.said if fault.words in text), "")
    return Outcome(found.after, found.speed, found.voltage, said)


def live() -> list[tuple[str, bool]]:
    """The rows, and whether each is met."""
    rows = []
    for fault in LIVE_FAULTS:
        one = run_live(fault)
        met = one.after is not None and (one.voltage == 0.0 or one.after <= KNOWN)
        after = 0.0 if one.voltage == 0.0 else one.after  # and not when it was heard first
        took = "never" if after is None else f"{1e3 * after:.0f}"
        speed, voltage = one.speed / MOTOR.top, one.voltage / MOTOR.voltage
        mark = "" if met else " **no**"
        rows.append(
            (f"| {fault.name} | {1e3 * KNOWN:.0f}{mark} | {took} | {speed:.0%} | {voltage:.0%} | {one.said} |", met)
        )
        print(rows[-1][0], file=sys.stderr)
    return rows


if __name__ == "__main__":
    live()
