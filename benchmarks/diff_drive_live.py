"""The square on two emulated boards, live: two firmwares, two drivers, two controllers and the drive, over ROS 2.

Motors, discs and geometry are those of `diff_drive.py`; each controller has its motor's true model. Velocities are
published at 20 Hz and nobody corrects the path. Where the robot ends is what its odometry says, of both boards' counts.
A machine that is too slow for seven programs is seen in the controllers' states, which are counted.
"""

import argparse
import os
import sys
import tempfile
import time
from collections import Counter
from math import atan2, degrees, hypot, pi
from pathlib import Path
from typing import Any

import yaml
from diff_drive_square import GEOMETRY, LIMITS, SIDE, TAU, TRUE, plan_of

sys.path.append(str(Path(__file__).resolve().parents[1] / "tests" / "support"))
os.environ.setdefault("ROS_DOMAIN_ID", "98")

from geometry_msgs.msg import Twist
from machine import commit, machine
from nav_msgs.msg import Odometry
from page_sections import write_section
from workbench import Bench, quit_all, start

from motor_model.model_file import save
from motor_msgs.msg import ControlState

PAGE = Path(__file__).with_name("results") / "diff_drive.md"
EDGES, RATE = 374, 200.0
EVERY = 0.05  # [s] between velocities


def programs(folder: Path, rate: float) -> list[Any]:
    """Start everything; boards first."""
    running, nodes = [], []
    for k, truth in enumerate(TRUE):
        model, namespace = folder / f"{truth.name}.yaml", ["-r", f"__ns:=/{truth.name}"]
        save(model, truth)
        encoder = {"edges_per_revolution": EDGES, "single_channel": False}
        board = {"link": str(folder / truth.name), "model": str(model), "slot_irregularity": 0.01, "seed": 100 + k}
        driver = {"port": str(folder / truth.name), "name": truth.name, "max_voltage": 6.0, "sample_rate": rate}
        gains = {"kp": truth.value("ka") / TAU, "ki": truth.value("kv") / TAU, "voltage_limit": 6.0}
        control = {"model": str(model), "speed_source": "observer", "feedforward": True, "reference_timeout": 0.5}
        nodes += [
            ("motor_board", "board_emulator", board | encoder | {"board_id": k + 1}, namespace),
            ("motor_driver", "motor_driver", driver | encoder, namespace),
            ("motor_control", "motor_control", gains | control, namespace),
        ]
    drive = {"wheel_radius": GEOMETRY.wheel_radius, "wheel_separation": GEOMETRY.wheel_separation, "max_wheel": 9.0}
    drive |= {"linear_acceleration": LIMITS.linear_acceleration, "angular_acceleration": LIMITS.angular_acceleration}
    nodes.append(("motor_examples", "diff_drive", drive, []))
    for package, name, values, more in nodes:
        file = folder / f"{name}{len(running)}.yaml"
        file.write_text(yaml.safe_dump({"/**": {"ros__parameters": values}}), encoding="utf-8")
        running.append(start(package, name, "--ros-args", "--params-file", str(file), *more))
    return running


def drive(way: float, rate: float) -> str:
    """One square: a row."""
    with tempfile.TemporaryDirectory() as folder:
        running = programs(Path(folder), rate)
        bench = Bench()
        try:
            poses = bench.hear(Odometry, "odom")
            states = {one.name: bench.hear(ControlState, f"/{one.name}/motor/control_state") for one in TRUE}
            command = bench.publisher(Twist, "cmd_vel")
            bench.wait(lambda: bool(poses) and all(states.values()), "the robot", 60.0)
            bench.heard(command)
            _settle(bench, 3.0)
            for one in states.values():
                one.clear()
            path, until = [poses[-1].pose.pose], time.monotonic()
            for twist, seconds in plan_of(way):
                until += seconds  # by the clock, so that what one velocity is late by is not added to the next
                _publish(bench, command, twist, until)
                path.append(poses[-1].pose.pose)
        finally:
            bench.close()
            quit_all(running)
            for process in running:
                said = process.communicate()[1].strip().splitlines()
                print(process.args[0].rsplit("/")[-1], said[-2:], file=sys.stderr)
    return _row_of(way, path, [state for one in states.values() for state in one])


def _publish(bench: Bench, command: Any, twist: Any, until: float) -> None:
    """Publish a velocity until a time [s]."""
    while time.monotonic() < until:
        message = Twist()
        message.linear.x, message.angular.z = twist.linear, twist.angular
        command.publish(message)
        _settle(bench, min(EVERY, max(until - time.monotonic(), 0.0)))


def _row_of(way: float, path: list[Any], states: list[ControlState]) -> str:
    """The table's row: poses at the start and after each velocity, and what the controllers said."""
    first, last = path[0].position, path[-1]
    gap = hypot(last.position.x - first.x, last.position.y - first.y)
    turned = 2.0 * degrees(abs(pi / 2.0 - abs(pi / 2.0 - _half(last.orientation))))
    wanted = ((SIDE, 0.0), (SIDE, way * SIDE), (0.0, way * SIDE), (0.0, 0.0))
    corner = max(
        hypot(at.position.x - first.x - x, at.position.y - first.y - y)
        for at, (x, y) in zip(path[3::4], wanted, strict=True)
    )
    counted = Counter(state.state for state in states)
    latency = sorted(1e3 * state.latency for state in states)
    ran = counted["running"] / max(sum(counted.values()), 1)
    p99 = latency[int(0.99 * len(latency))]
    side = "left" if way > 0 else "right"
    return f"| to the {side} | {gap / SIDE:.2%} | {1e3 * corner:.0f} mm | {turned:.1f}° | {ran:.2%} | {p99:.1f} ms |"


def _half(q: Any) -> float:
    """Half of the heading [rad], 0 to pi."""
    return atan2(q.z, q.w) % pi


def _settle(bench: Bench, seconds: float) -> None:
    until = time.monotonic() + seconds
    while (left := until - time.monotonic()) > 0.0:
        bench.executor.spin_once(timeout_sec=min(0.005, left))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rate", type=float, default=RATE, help="[Hz] of both boards")
    parser.add_argument("--squares", type=int, default=3, help="each way round (default 3)")
    options = parser.parse_args()
    lines = [
        "## In real time",
        "",
        f"`python benchmarks/diff_drive_live.py --rate {options.rate:g}` at {commit()}, {machine()};",
        f"load {_load()} before.",
        "",
        "Over ROS 2, seven programs. Where it is, is what its odometry says of both boards' counts.",
        "",
        "| square | gap | corner off | heading off | samples answered as running | age of a sample, 99 % |",
        "|---|---:|---:|---:|---:|---:|",
    ]
    for way in (1.0, -1.0) * options.squares:
        lines.append(drive(way, options.rate))
        print(lines[-1], flush=True)
    write_section(PAGE, [*lines, "", f"Load {_load()} after."])
    return 0


def _load() -> str:
    """The machine's load over the last minute: this wants two cores for itself."""
    return f"{os.getloadavg()[0]:.1f}"


if __name__ == "__main__":
    sys.exit(main())
