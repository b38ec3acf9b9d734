"""Whoever drives may be killed, or told to end, at any time: the plant's pins are at 0 V within its command_timeout."""

import signal
import time
from collections.abc import Callable
from pathlib import Path
from subprocess import Popen

import pytest
from std_msgs.msg import Float64
from workbench import Bench

from motor_msgs.msg import MotorSpeed
from motor_ros import qos

Start = Callable[..., "Popen[str]"]
TIMEOUT, SLACK = 0.1, 0.05  # [s] command_timeout; a command on its way, and samples
HEARS = 0.3  # [s] that a program takes at most to hear of a signal and to send its last 0 V


class Pins:
    """The voltages at the pins, on the plant's clock and on ours."""

    def __init__(self, bench: Bench) -> None:
        self.bench, self.samples = bench, list[MotorSpeed]()
        self._behind = float("inf")  # [s] least lateness of a sample here, and the difference of the clocks
        bench.node.create_subscription(MotorSpeed, "motor/speed", self._on_sample, qos.SPEED)

    def _on_sample(self, sample: MotorSpeed) -> None:
        self.samples.append(sample)
        self._behind = min(self._behind, time.monotonic() - sample.sample_time * 1e-9)

    def driven_for(self, at: float) -> float:
        """[s] from an instant of ours until the last sample with a voltage, once there are many without."""
        enough = 60
        self.bench.wait(lambda: all(one.voltage == 0.0 for one in self.samples[-enough:]), "0 V for good")
        last = max(one.sample_time for one in self.samples if one.voltage != 0.0)
        return last * 1e-9 + self._behind - at


def begin(who: str, bench: Bench, start: Start, tmp_path: Path) -> "Popen[str]":
    """Start who drives."""
    if who == "experiment":
        return start("motor_identification", "experiment", "staircase", "--output", tmp_path / "bag")
    if who == "explore":
        return start("motor_identification", "explore", tmp_path / "found", "--profile", "staircase")
    process = start("motor_control", "motor_control", "--ros-args", "-p", "latency_limit:=0.5")
    reference = bench.publisher(Float64, "motor/reference", qos.REFERENCE)
    bench.heard(reference)
    reference.publish(Float64(data=60.0))
    return process


@pytest.mark.on_time
@pytest.mark.parametrize(
    ("who", "number", "most"),
    [
        ("motor_control", signal.SIGKILL, TIMEOUT + SLACK),
        ("experiment", signal.SIGKILL, TIMEOUT + SLACK),
        ("explore", signal.SIGKILL, TIMEOUT + SLACK),
        ("motor_control", signal.SIGTERM, HEARS),
        ("experiment", signal.SIGTERM, HEARS),
    ],
)
def test_the_motor_gets_0_volt_in_time(
    bench: Bench, start: Start, tmp_path: Path, who: str, number: signal.Signals, most: float
) -> None:
    start("motor_sim", "motor_sim")
    pins = Pins(bench)
    bench.wait(lambda: len(pins.samples) > 20, "the plant")
    process = begin(who, bench, start, tmp_path)
    bench.wait(lambda: pins.samples[-1].speed > 40.0, "motion")
    at = time.monotonic()
    process.send_signal(number)
    assert -0.05 < pins.driven_for(at) < most
    bench.wait(lambda: pins.samples[-1].speed == 0.0, "rest")
    assert process.wait(10.0) == (-number if number == signal.SIGKILL else process.returncode)
