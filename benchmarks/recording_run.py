"""What a recording came to: what its bag holds and lacks, what it took, and how `play` plays it."""

import os
import re
import struct
import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from ament_index_python.packages import get_package_prefix
from soak_process import DOMAIN

from motor_identification.bag import contents, messages, read_recording
from motor_model.errors import MotorError

PLAYED = 60.0  # [s] at most, of the recording's end, for the spacing of `play`
LATE = re.compile(r"(\d+) messages played, 99 % of them within ([\d.]+) ms")


@dataclass(frozen=True)
class Run:
    """What one recording came to."""

    rate: int
    samples: int  # on motor/speed, in the bag
    missing: int  # between the first and the last of them
    messages: int  # on all topics
    unlike: int  # samples whose joint state is missing
    seconds: float
    size: int  # [bytes] of the bag
    shares: dict[str, float]  # of one core, by process
    grown: int  # [KiB] of the recorder's own memory
    played: int
    late: float  # [ms] 99 % of the played messages
    load: float


def executable(name: str) -> Path:
    """One of motor_identification's commands."""
    return Path(get_package_prefix("motor_identification")) / "lib/motor_identification" / name


def looked_at(rate: int, bag: Path, shares: dict[str, float], grown: int, load: float) -> Run:
    """Read the bag, and play its end."""
    recording, inside = read_recording(bag), contents(bag)
    stamps: dict[str, list[int]] = {"/motor/speed": [], "/joint_states": []}
    for topic, _, _, data in messages(bag, stamps):
        seconds, nanoseconds = struct.unpack_from("<iI", data, 4)  # the header's, which the two share
        stamps[topic].append(seconds * 10**9 + nanoseconds)
    joints = stamps["/joint_states"]
    between = {stamp for stamp in stamps["/motor/speed"] if joints[0] <= stamp <= joints[-1]}
    steps = np.rint(np.diff(recording.sample_time) * (rate * 1e-9))
    played, late = _played(bag, max(inside.duration - PLAYED, 0.0))
    return Run(
        rate=rate,
        samples=len(recording),
        missing=int(np.sum(steps - 1)),
        messages=inside.message_count,
        unlike=len(between - set(joints)),
        seconds=inside.duration,
        size=sum(file.stat().st_size for file in bag.iterdir()),
        shares=shares,
        grown=grown,
        played=played,
        late=late,
        load=load,
    )


def _played(bag: Path, offset: float) -> tuple[int, float]:
    """How many messages `play` sends from there on, and within how many ms of their time 99 % of them."""
    command = [executable("play"), bag, "--start-offset", f"{offset:.3f}", "--topics", "motor/speed"]
    environment = {**os.environ, "ROS_DOMAIN_ID": DOMAIN}
    said = subprocess.run(command, env=environment, capture_output=True, text=True, check=True).stdout
    found = LATE.search(said)
    if found is None:
        raise MotorError(f"play said something else: {said}")
    return int(found[1]), float(found[2])
