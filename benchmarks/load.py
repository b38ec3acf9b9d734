"""The loop beside busy programs: simulation on one core, controller and seven endless loops on the other.

Each rate in turn, three times: the loop by itself, then with the loops beside it, then by itself while `model` is set
(which reads the file, and loads or compiles what observer and feed-forward run on). What counts is the speed of the
motor, sample by sample: within 5 % of its unloaded self, or 0 V with a reason, never a swing. A loop that has given up
(at 0 V for more than a second) is asked again before the third phase, as its user would.
"""

import os
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import rclpy
import soak_process
from ament_index_python.packages import get_package_prefix
from machine import commit, machine
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from rclpy.node import Node
from soak_process import Process
from std_msgs.msg import Float64

from motor_control.controller.output import RUNNING
from motor_model.errors import MotorError
from motor_model.model_file import save
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_msgs.msg import ControlState, MotorSpeed
from motor_ros import qos
from motor_ros.loopback import stay_on_this_machine

PAGE = Path(__file__).with_name("results") / "load.md"
SIM_CORE, LOADED_CORE, BUSY, RUNS = 0, 1, 7, 3
REFERENCE, WITHIN = 50.0, 0.05  # [rad/s]; share of it
QUIET, LOADED, PATIENCE = 5.0, 15.0, 30.0  # [s]
AFTER = 0.5  # [s] after a 0 V in which the motor may still be slower
MOTOR = Parameters({"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.4}, ("coulomb_friction",))
soak_process.DOMAIN = "82"  # of this benchmark alone


@dataclass
class Seen:
    """What was heard in one phase."""

    speeds: list[tuple[float, float]] = field(default_factory=list)  # [s] plant's clock, [rad/s]
    states: list[tuple[str, str, float]] = field(default_factory=list)  # state, reason, latency [s]
    pauses: list[float] = field(default_factory=list)  # [s] plant's clock, of samples under 0 V


class Listener(Node):
    """Hears the loop."""

    def __init__(self) -> None:
        super().__init__("listener")
        self.seen = Seen()
        self.create_subscription(MotorSpeed, "motor/speed", self._on_speed, qos.SPEED)
        self.create_subscription(ControlState, "motor/control_state", self._on_state, qos.CONTROL_STATE)
        self._reference = self.create_publisher(Float64, "motor/reference", qos.REFERENCE)
        self._set = self.create_client(SetParameters, "motor_control/set_parameters")

    def _on_speed(self, message: MotorSpeed) -> None:
        self.seen.speeds.append((message.sample_time * 1e-9, message.speed))
        if message.voltage == 0.0:
            self.seen.pauses.append(message.sample_time * 1e-9)

    def _on_state(self, message: ControlState) -> None:
        self.seen.states.append((message.state, message.reason, message.latency))

    def refer(self) -> None:
        """Ask for the speed."""
        self._reference.publish(Float64(data=REFERENCE))

    def set_model(self, path: str) -> None:
        """Set the parameter `model`."""
        value = ParameterValue(type=ParameterType.PARAMETER_STRING, string_value=path)
        self._set.call_async(SetParameters.Request(parameters=[Parameter(name="model", value=value)]))

    def hear(self, seconds: float, until: Callable[[], bool] = lambda: False) -> Seen:
        """Hear a phase of so many seconds."""
        self.seen, end = Seen(), time.monotonic() + seconds
        while time.monotonic() < end and not until():
            rclpy.spin_once(self, timeout_sec=0.05)
        return self.seen


def node(core: int, package: str, *parameters: str) -> Process:
    """One of the workbench's nodes on one core."""
    words = [word for parameter in parameters for word in ("-p", parameter)]
    path = Path(get_package_prefix(package)) / "lib" / package / package
    return Process("taskset", "-c", core, path, "--ros-args", *words)


def phases(rate: float, folder: str) -> dict[str, Seen]:
    """Run the three phases at a rate [Hz].

    Raises:
        MotorError: the motor does not come to its speed.
    """
    model = f"{folder}/model.yaml"
    save(model, MOTOR)
    listener, found = Listener(), {}
    os.sched_setaffinity(0, {SIM_CORE})
    sim = node(SIM_CORE, "motor_sim", f"model:={model}", f"sample_rate:={rate}")
    control = node(LOADED_CORE, "motor_control")
    busy: list[Process] = []
    try:
        end = time.monotonic() + PATIENCE
        while not any(speed > (1.0 - WITHIN) * REFERENCE for _, speed in listener.hear(1.0).speeds):
            if time.monotonic() > end:
                raise MotorError("the motor does not come to its speed: see what the processes say above.")
            if listener.seen.speeds:
                listener.refer()
        listener.hear(2.0)
        found["by itself"] = listener.hear(QUIET)
        busy = [Process("taskset", "-c", LOADED_CORE, sys.executable, "-c", "while True: pass") for _ in range(BUSY)]
        found[f"beside {BUSY} endless loops"] = listener.hear(LOADED)
        while busy:
            busy.pop().end()
        listener.refer()
        listener.hear(2.0)
        listener.set_model(model)
        found["while `model` is set"] = listener.hear(QUIET)
    finally:
        for process in (*busy, control, sim):
            process.end()
        listener.destroy_node()
    return found


def row(rate: float, name: str, seen: Seen, unloaded: float) -> str:
    """A line of the table; unloaded: median speed [rad/s] of the loop by itself."""
    shares = [(time, speed / unloaded - 1.0) for time, speed in seen.speeds]
    apart = [time for time, share in shares if abs(share) > WITHIN]
    fast = sum(share > WITHIN for _, share in shares)
    unexplained = sum(not any(0.0 <= time - pause <= AFTER for pause in seen.pauses) for time in apart)
    late = [latency for _, _, latency in seen.states if latency == latency]
    stopped = [reason for state, reason, _ in seen.states if state != RUNNING]
    low, high = min(share for _, share in shares), max(share for _, share in shares)
    said = max(set(stopped), key=stopped.count) if stopped else ""
    return (
        f"| {rate:.0f} Hz, {name} | {low:+.1%} … {high:+.1%} | {len(apart) / len(shares):.2%} | {fast} | "
        f"{unexplained} | "
        f"{1e3 * sorted(late)[len(late) // 2]:.1f} / {1e3 * max(late):.0f} ms | "
        f"{len(seen.pauses) / len(shares):.2%} | {said} |"
    )


def main() -> int:
    """`python benchmarks/load.py`."""
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    stay_on_this_machine()
    rclpy.init(domain_id=int(soak_process.DOMAIN))
    load = f"load average {os.getloadavg()[0]:.1f} at the beginning"
    lines = [
        "# The loop under load",
        "",
        f"At {commit()}; {machine()}, shared with others; {load}. ",
    ]
    lines[-1] += f"{REFERENCE:g} rad/s, measured speed; {QUIET:g} s, {LOADED:g} s beside the endless loops."
    lines += ["", (__doc__ or "").split("\n\n")[1].strip(), ""]
    lines += [
        "| | speed against the loop by itself | samples more than 5 % apart | too fast | without 0 V before | "
        "age of the sample: median / largest | samples under 0 V | said |",
        "|---|---|---:|---:|---:|---:|---:|---|",
    ]
    try:
        with tempfile.TemporaryDirectory() as folder:
            for rate in [rate for rate in (200.0, 1000.0) for _ in range(RUNS)]:
                found = phases(rate, folder)
                own = sorted(speed for _, speed in found["by itself"].speeds)  # others may hold that up, too
                lines += [row(rate, name, seen, own[len(own) // 2]) for name, seen in found.items()]
    finally:
        rclpy.try_shutdown()
    PAGE.write_text("\n".join([*lines, ""]), encoding="utf-8")
    print(PAGE.read_text(encoding="utf-8"))
    return 0


if __name__ == "__main__":
    sys.exit(main())
