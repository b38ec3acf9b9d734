"""Ten minutes of a motor at 1 kHz through `record`, beside a bare rclpy subscriber that only counts; then `play`.

The simulated motor publishes `motor/speed` and `joint_states` at the rate, and is driven at 50 Hz. Samples are numbered
by their time on the plant's clock, so that every one that the bag lacks is seen. Where others load the machine:
`nice -n -5 python benchmarks/recording.py`, and all processes inherit that.
"""

import argparse
import os
import sys
import tempfile
import time
from math import sin
from pathlib import Path

import rclpy
from machine import machine
from rclpy.node import Node
from recording_run import Run, executable, looked_at
from soak import holds, spin
from soak_process import DOMAIN, Process, program

from motor_identification.bag import contents
from motor_model.errors import MotorError
from motor_msgs.msg import MotorSpeed, MotorVoltage
from motor_ros import qos
from motor_ros.loopback import stay_on_this_machine
from motor_ros.messages import time_message, voltage_message

RESULTS = Path(__file__).with_name("results")
PEER = Path(__file__).with_name("recording_peer.py")
PATIENCE = 30.0  # [s] for the first samples
SETTLING = 3.0  # [s] before processor time is measured
COMMANDS = 50.0  # [Hz]
MOST = 0.4  # of one core, for the recorder at 1 kHz


class User(Node):
    """Drives the motor, so that the samples differ as those of a real recording do."""

    def __init__(self) -> None:
        super().__init__("user")
        self.samples = 0
        self._voltage = self.create_publisher(MotorVoltage, "motor/voltage", qos.VOLTAGE)
        self.create_subscription(MotorSpeed, "motor/speed", self._on_sample, qos.SPEED, raw=True)
        self.create_timer(1.0 / COMMANDS, self._drive)

    def _on_sample(self, data: bytes) -> None:
        self.samples += 1

    def _drive(self) -> None:
        volts = 8.0 * sin(1.7 * time.monotonic()) + 2.0 * sin(11.0 * time.monotonic())
        self._voltage.publish(voltage_message(volts, time_message(time.time_ns()), "user"))


def measure(rate: int, seconds: float) -> Run:
    """Record for so long, and play the end of it."""
    rclpy.init(domain_id=int(DOMAIN))
    processes: dict[str, Process] = {}
    user = User()
    with tempfile.TemporaryDirectory() as folder:
        bag = Path(folder) / "bag"
        try:
            processes["motor_sim"] = program("motor_sim", "motor_sim", f"sample_rate:={rate}.0")
            processes["peer"] = Process(sys.executable, PEER)
            processes["record"] = Process(executable("record"), bag)
            _wait(user, bag)
            spin(user, SETTLING)  # type: ignore[arg-type]
            before, began = {name: process.cpu() for name, process in processes.items()}, time.monotonic()
            early = processes["record"].memory()[1]
            spin(user, seconds)  # type: ignore[arg-type]
            elapsed = time.monotonic() - began
            shares = {name: (process.cpu() - before[name]) / elapsed for name, process in processes.items()}
            grown, load = processes["record"].memory()[1] - early, os.getloadavg()[0]
        finally:
            for process in reversed(processes.values()):  # the recorder first
                process.end()
            user.destroy_node()
            rclpy.try_shutdown()
        return looked_at(rate, bag, shares, grown, load)


def _wait(user: User, bag: Path) -> None:
    patience = time.monotonic() + PATIENCE
    while not (user.samples and bag.is_dir() and contents(bag).message_count):
        if time.monotonic() > patience:
            raise MotorError("plant or recorder are not heard: see what they say above.")
        spin(user, 0.2)  # type: ignore[arg-type]


def report(run: Run) -> list[str]:
    """A section."""
    record, peer = run.shares["record"], run.shares["peer"]
    per_hour = run.size / run.seconds * 3600.0
    rows = [
        holds("0 samples missing in the bag", f"{run.missing} of {run.samples}", run.missing == 0),
        holds("0 `joint_states`, sent with every sample, missing", f"{run.unlike} of {run.samples}", run.unlike == 0),
        holds(f"recorder below {MOST:.0%} of one core", f"{record:.1%}", record < MOST),
        holds("the recorder's own memory grows by less than 4 MiB", f"{run.grown:+d} KiB", run.grown < 4096),
    ]
    return [
        f"## {run.rate} Hz for {run.seconds / 60.0:.1f} minutes",
        "",
        "| claim | measured | |",
        "|---|---:|---|",
        *rows,
        "",
        "| | |",
        "|---|---:|",
        f"| messages recorded | {run.messages}, {run.messages / run.seconds:.0f}/s |",
        f"| file, an hour of this | {per_hour / 2**20:.0f} MiB |",
        f"| bytes on disk per message | {run.size / run.messages:.1f} |",
        f"| recorder, of one core | {record:.1%} |",
        f"| bare rclpy subscriber that counts the same raw messages | {peer:.1%} |",
        f"| recorder beside it | {record / max(peer, 1e-9):.2f} |",
        f"| `motor_sim` | {run.shares['motor_sim']:.1%} |",
        f"| playback jitter, 99 % of {run.played} messages | {run.late:.2f} ms |",
        "",
        f"Load average of the last minute {run.load:.1f}.",
        "",
    ]


def main() -> int:
    """`python benchmarks/recording.py [--minutes M] [--rate HZ …]`."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=10.0, help="default 10")
    parser.add_argument(
        "--rate", type=int, nargs="+", default=[1000], help="[Hz] one run after the other, default 1000"
    )
    options = parser.parse_args()
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    stay_on_this_machine()
    lines = ["# Recording", "", f"{machine()}; niceness {os.nice(0)}.", ""]
    for rate in options.rate:
        lines += report(measure(rate, 60.0 * options.minutes))
    print("\n".join(lines), flush=True)
    RESULTS.mkdir(exist_ok=True)
    (RESULTS / "recording.md").write_text("\n".join(lines), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
