"""The loop at 1 kHz over DDS: how long a sample waits for its voltage, and what a controller costs beside a bare node.

Sim and controller (observer and feed-forward on), then sim and a node that only echoes the same messages, in turns of
one run. Latency is the time between the two publications, both as DDS stamps them in the processes that send: a raw
listener reads them, and its own delay does not count. Where others load the machine, put `nice -n -5` before it.
"""

import argparse
import os
import struct
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import rclpy
import soak_process
from machine import machine
from rclpy.node import Node
from soak_process import Process, program
from std_msgs.msg import Float64

from motor_model.errors import MotorError
from motor_model.model_file import save
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_msgs.msg import MotorSpeed, MotorVoltage
from motor_ros import qos
from motor_ros.loopback import stay_on_this_machine

RESULTS = Path(__file__).with_name("results")
BARE = Path(__file__).with_name("loop_peer.py")
CONTROLLER, ECHO, QUICK_ECHO = "motor_control", "bare echo", "bare echo on the controller's executor"
FETCH_EVERY = 0.02  # [s]
SETTLING, PATIENCE = 3.0, 30.0  # [s] before anything is measured; for the first voltage
PROMISED = 1.5  # times the echo's latency
MOTOR = Parameters(
    {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.4, "breakaway_voltage": 0.9, "stribeck_speed": 4.0}, ("static_friction",)
)
KP = PAPER_KA / 0.015
soak_process.DOMAIN = "81"  # of this benchmark alone


class Listener(Node):
    """Notes when each sample and each voltage was published [ns], by the sample's stamp.

    It fetches what has come every 20 ms, so that the machine is left to those that are measured.
    """

    def __init__(self) -> None:
        super().__init__("listener")
        self.samples: dict[tuple[int, int], int] = {}
        self.voltages: dict[tuple[int, int], int] = {}
        self._heard = [
            (self.create_subscription(kind, topic, lambda _: None, qos.SPEED, raw=True), kind, times)  # deep
            for kind, topic, times in (
                (MotorSpeed, "motor/speed", self.samples),
                (MotorVoltage, "motor/voltage", self.voltages),
            )
        ]
        self._reference = self.create_publisher(Float64, "motor/reference", qos.REFERENCE)

    def refer(self) -> None:
        """Ask for 100 rad/s."""
        self._reference.publish(Float64(data=100.0))

    def hear(self, seconds: float) -> None:
        """Fetch messages for so long."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            time.sleep(FETCH_EVERY)
            for subscription, kind, times in self._heard:
                with subscription.handle:
                    while (taken := subscription.handle.take_message(kind, True)) is not None:
                        message, info = taken
                        times[struct.unpack_from("<iI", message, 4)] = info["source_timestamp"]  # the stamp comes first

    def latencies(self) -> np.ndarray:
        """[s] from each answered sample to its voltage, and forget them."""
        both = self.samples.keys() & self.voltages.keys()
        spans = [(self.voltages[stamp] - self.samples[stamp]) * 1e-9 for stamp in both]
        self.samples.clear()
        self.voltages.clear()
        return np.array(spans)


@dataclass
class Turns:
    """What was measured of one answering process, over all its turns."""

    latencies: list[np.ndarray] = field(default_factory=list)  # [s]
    cpu: list[float] = field(default_factory=list)  # share of a core
    answered: list[float] = field(default_factory=list)  # share of the samples


def turn(listener: Listener, process: Process, seconds: float, turns: Turns) -> None:
    """Measure one process for so long, and end it."""
    try:
        patience = time.monotonic() + PATIENCE
        while not listener.voltages:
            if time.monotonic() > patience:
                raise MotorError("no voltage comes: see what the processes say above.")
            listener.refer()
            listener.hear(0.2)
        listener.hear(SETTLING)
        listener.latencies()
        before, begun = process.cpu(), time.monotonic()
        listener.hear(seconds)
        turns.cpu.append((process.cpu() - before) / (time.monotonic() - begun))
        samples = len(listener.samples)
        turns.latencies.append(listener.latencies())
        turns.answered.append(len(turns.latencies[-1]) / max(samples, 1))
    finally:
        process.end()
        listener.hear(0.5)
        listener.latencies()


def measure(rate: float, seconds: float, count: int) -> dict[str, Turns]:
    """Controller and echoes in turns, beside one sim."""
    rclpy.init(domain_id=int(soak_process.DOMAIN))
    found = {CONTROLLER: Turns(), ECHO: Turns(), QUICK_ECHO: Turns()}
    with tempfile.TemporaryDirectory() as folder:
        model = f"{folder}/model.yaml"
        save(model, MOTOR)
        listener = Listener()
        gains = (f"kp:={KP}", f"ki:={KP * PAPER_KV / PAPER_KA}", "sample_timeout:=1.0")
        sim = program("motor_sim", "motor_sim", f"model:={model}", f"sample_rate:={rate}", "slot_irregularity:=0.01")
        try:
            for _ in range(count):
                control = program(
                    CONTROLLER, CONTROLLER, f"model:={model}", "speed_source:=observer", "feedforward:=true", *gains
                )
                turn(listener, control, seconds, found[CONTROLLER])
                turn(listener, Process(sys.executable, BARE), seconds, found[ECHO])
                turn(listener, Process(sys.executable, BARE, "--quick"), seconds, found[QUICK_ECHO])
        finally:
            sim.end()
            listener.destroy_node()
            rclpy.try_shutdown()
    return found


def report(found: dict[str, Turns], rate: float) -> list[str]:
    """The page."""
    lines = [
        "# Loop",
        "",
        f"{machine()}; niceness {os.nice(0)}, load average {os.getloadavg()[0]:.1f}. {rate:g} Hz.",
        "",
    ]
    lines += ["| | sample to voltage: median | p99 | of one core | answered |", "|---|---:|---:|---:|---:|"]
    tails = {}
    for name, turns in found.items():
        spans = np.concatenate(turns.latencies)
        tails[name] = np.median([np.percentile(one, 99) for one in turns.latencies])
        lines.append(
            f"| {name} | {1e3 * np.median(spans):.3f} ms | {1e3 * tails[name]:.3f} ms | {np.mean(turns.cpu):.1%} | "
            f"{np.mean(turns.answered):.2%} |"
        )
    lines += [
        "",
        f"p99 is the median of {len(found[ECHO].cpu)} runs. Required: at most {PROMISED} times the echo's:",
        "",
    ]
    for name in (ECHO, QUICK_ECHO):
        ratio = tails[CONTROLLER] / tails[name]
        lines.append(f"- {name}: {ratio:.2f} times, {'holds' if ratio <= PROMISED else '**does not hold**'}")
    return [*lines, ""]


def main() -> int:
    """`python benchmarks/loop.py [--seconds S] [--turns N] [--rate HZ]`."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=10.0, help="of each turn")
    parser.add_argument("--turns", type=int, default=5)
    parser.add_argument("--rate", type=float, default=1000.0, help="[Hz]")
    options = parser.parse_args()
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    stay_on_this_machine()
    lines = report(measure(options.rate, options.seconds, options.turns), options.rate)
    RESULTS.mkdir(exist_ok=True)
    (RESULTS / "loop.md").write_text("\n".join(lines), encoding="utf-8")
    print("\n".join(lines))
    return 0


if __name__ == "__main__":
    sys.exit(main())
