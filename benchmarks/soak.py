"""Minutes on end: driver and emulated board as processes, their CPU time and memory, and what became of every frame.

A listener sends a voltage after a sample, as a controller would, and keeps every sample. Beside them, in the same run,
a bare rclpy node sends the same two messages at the same rate and takes the same commands: what ROS alone costs here.
Where others load the machine: `nice -n -5 python benchmarks/soak.py`, and all processes inherit that.
"""

import argparse
import os
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import rclpy
from machine import machine
from soak_listener import Listener, lost_samples, stamp_errors
from soak_peer import PEER
from soak_process import DOMAIN, Process, program

from motor_model.errors import MotorError
from motor_ros.loopback import stay_on_this_machine

RESULTS = Path(__file__).with_name("results")
BARE = Path(__file__).with_name("soak_peer.py")
LONG, FAST = 200, 1000  # [Hz]
SHORT = 2.0  # [min] at most, all rates but LONG if there are several
SETTLING = 5.0  # [s] before anything is measured
PATIENCE = 30.0  # [s] for the first samples
FLAT = 1024  # [KiB] that a process may grow by
FAULTS = ("lost frames", "CRC errors", "frames damaged on the way to the board", "samples the board could not send")


def spin(listener: Listener, seconds: float) -> None:
    """Hear messages for so long."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        rclpy.spin_once(listener, timeout_sec=0.1)


@dataclass(frozen=True)
class Soak:
    """One run."""

    rate: int
    seconds: float
    listener: Listener
    begin: int  # samples heard before measuring
    shares: dict[str, float]  # of one core, by process
    first: float  # [s] after which memory is looked at first
    early: dict[str, tuple[int, int]]  # [KiB]
    late: dict[str, tuple[int, int]]
    peers: int  # messages of the peer's that were heard
    load: float  # average of the machine, last minute


def soak(rate: int, minutes: float) -> Soak:
    """Run everything at this rate for so long."""
    rclpy.init(domain_id=int(DOMAIN))
    processes: dict[str, Process] = {}
    with tempfile.TemporaryDirectory() as folder:
        port = f"{folder}/board"
        listener = Listener(rate, port)
        try:
            processes["emulator"] = program("motor_board", "board_emulator", f"link:={port}")
            processes["driver"] = program("motor_driver", "motor_driver", f"port:={port}", f"sample_rate:={rate}.0")
            processes[PEER] = Process(sys.executable, BARE, "--ros-args", "-p", f"rate:={rate}.0")
            return _measured(rate, 60.0 * minutes, listener, processes)
        finally:
            for process in reversed(processes.values()):
                process.end()
            listener.destroy_node()
            rclpy.try_shutdown()


def _measured(rate: int, seconds: float, listener: Listener, processes: dict[str, Process]) -> Soak:
    patience = time.monotonic() + PATIENCE
    while not listener.hears_all:
        if time.monotonic() > patience:
            raise MotorError("driver, board or peer are not heard: see what they say above.")
        spin(listener, 0.1)
    spin(listener, SETTLING)
    listener.warnings.clear()
    begin, peers, began = len(listener.stamps), listener.peers, time.monotonic()
    before = {name: process.cpu() for name, process in processes.items()}
    first = min(60.0, seconds / 2.0)
    spin(listener, first)
    early = {name: process.memory() for name, process in processes.items()}
    spin(listener, seconds - first)
    elapsed = time.monotonic() - began
    shares = {name: (process.cpu() - before[name]) / elapsed for name, process in processes.items()}
    late = {name: process.memory() for name, process in processes.items()}
    peers = listener.peers - peers
    spin(listener, 2.0)  # the last second's diagnostics
    return Soak(rate, elapsed, listener, begin, shares, first, early, late, peers, os.getloadavg()[0])


def holds(claim: str, number: str, true: bool) -> str:
    """One claim's row."""
    return f"| {claim} | {number} | {'holds' if true else '**does not hold**'} |"


def claims(run: Soak) -> list[str]:
    """What is promised at this rate, each with its number."""
    said = run.listener.driver
    faults = {name: int(said.get(name, -1)) for name in FAULTS}
    errors = stamp_errors(run.listener, run.begin)
    rms = float(np.sqrt(np.mean(errors**2))) if len(errors) else float("nan")
    stamps = run.listener.stamps[run.begin :]
    achieved = (len(stamps) - 1) / (stamps[-1] - stamps[0]) * 1e9
    rows = [holds(f"0 {name}", f"{count} of {said['good frames']}", count == 0) for name, count in faults.items()]
    lost = lost_samples(run.listener.sample_times[run.begin :], run.rate)
    rows += [
        holds("0 samples missing at the listener (gaps in `sample_time`)", f"{lost} of {len(stamps)}", lost == 0),
        holds(f"{run.rate} samples/s sustained", f"{achieved:.1f}", achieved > 0.99 * run.rate),
        holds("driver below 50 % of one core", f"{run.shares['driver']:.1%}", run.shares["driver"] < 0.5),
        holds(
            "header stamps within 0.5 ms RMS of the truth",
            f"{rms:.3f} ms, at most {np.abs(errors).max(initial=0.0):.3f} ms, of {len(errors)}",
            rms < 0.5,
        ),
    ]
    grown = {name: run.late[name][1] - run.early[name][1] for name in run.early}
    flat = f"memory of its own grows by less than {FLAT} KiB after {run.first:.0f} s"
    rows += [holds(f"{name}: {flat}", f"{grown[name]:+d} KiB", grown[name] < FLAT) for name in ("driver", "emulator")]
    return ["| claim | measured | |", "|---|---:|---|", *rows, ""]


def report(run: Soak) -> list[str]:
    """A section."""
    listener = run.listener
    lines = [f"## {run.rate} Hz for {run.seconds / 60.0:.1f} minutes", "", *claims(run)]
    lines += [
        f"| process | of one core | beside the peer | resident after {run.first:.0f} s | at the end |",
        "|---|---:|---:|---:|---:|",
    ]
    for name, share in run.shares.items():
        memory = f"{run.early[name][0] / 1024:.1f} MiB | {run.late[name][0] / 1024:.1f} MiB"
        lines.append(f"| {name} | {share:.1%} | {share / max(run.shares[PEER], 1e-9):.2f} | {memory} |")
    held = listener.truths[-1].held_up
    lines += [
        "",
        f"The peer sent {run.peers / run.seconds:.1f} samples/s. The motor went up to {listener.fastest:.0f} rad/s. "
        f"The emulated board was delayed {held} times by more than 40 ms; its output switched off "
        f"{listener.stops} times. Load average of the last minute {run.load:.1f}.",
    ]
    if held:
        lines += ["", "The board's clock stood still each time, so its rate is not valid: repeat on a quiet machine."]
    said = [f"- The driver said {count} times: {text}" for text, count in listener.warnings.most_common(5)]
    return [*lines, "", *said, *([""] if said else [])]


def main() -> int:
    """`python benchmarks/soak.py [--minutes M] [--rate HZ …]`."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--minutes", type=float, default=10.0, help=f"of several rates only for {LONG} Hz; else {SHORT:.0f}"
    )
    parser.add_argument("--rate", type=int, nargs="+", default=[LONG, FAST], help="[Hz] one run after the other")
    options = parser.parse_args()
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    stay_on_this_machine()
    lines = ["# Soak", "", f"{machine()}; niceness {os.nice(0)}.", ""]
    for rate in options.rate:
        whole = rate == LONG or len(options.rate) == 1
        lines += report(soak(rate, options.minutes if whole else min(options.minutes, SHORT)))
        print("\n".join(lines), flush=True)
    RESULTS.mkdir(exist_ok=True)
    (RESULTS / "soak.md").write_text("\n".join(lines), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
