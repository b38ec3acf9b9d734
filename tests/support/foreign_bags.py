"""Bags of robots that are not ours: joint states and commands, of types that are installed here and of one that is not.

The motor in them is the tests' own first-order one with Coulomb friction, stepped finely.
"""

from dataclasses import dataclass
from functools import cache
from math import copysign
from pathlib import Path
from typing import Any

import numpy as np
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

KV, KA, KS = 0.35, 0.02, 0.3  # [V·s/rad], [V·s²/rad], [V]
DRIVER = "example_control_msgs/msg/DriverState"
DRIVER_DEFINITION = """\
std_msgs/Header header
string[] interface_names
example_control_msgs/WheelState[] wheels
================================================================================
MSG: example_control_msgs/WheelState
float32 duty
float64 omega
uint16 ticks
float32 battery
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
"""


@dataclass(frozen=True)
class Motion:
    """Arrays of shape (K,) at 200 Hz, and commands at 50 Hz."""

    time: np.ndarray[Any, np.dtype[np.float64]]  # [s]
    voltage: np.ndarray[Any, np.dtype[np.float64]]  # [V] that held from here
    speed: np.ndarray[Any, np.dtype[np.float64]]  # [rad/s]
    angle: np.ndarray[Any, np.dtype[np.float64]]  # [rad]


@cache
def move(seconds: float = 20.0, seed: int = 1) -> Motion:
    """A motor under random levels, both ways."""
    generator = np.random.default_rng(seed)
    count, fine = int(seconds * 200), 20
    levels = generator.uniform(-6.0, 6.0, count // 40 + 1)
    voltage = np.repeat(levels, 40)[:count]
    speed, angle, rows = 0.0, 0.0, []
    for volts in voltage.tolist():
        rows.append((speed, angle))
        for _ in range(fine):
            drive = volts - KV * speed
            friction = copysign(KS, speed) if speed != 0.0 else min(max(drive, -KS), KS)
            step = (drive - friction) / KA * 0.005 / fine
            moved = speed + step
            speed = 0.0 if speed * moved < 0.0 and abs(volts) <= KS else moved
            angle += speed * 0.005 / fine
    speeds, angles = np.array(rows).T
    return Motion(np.arange(count) * 0.005, voltage, speeds, angles)


def stamp(store: Any, nanoseconds: int) -> Any:
    """A header."""
    kinds = store.types
    time = kinds["builtin_interfaces/msg/Time"](int(nanoseconds // 10**9), int(nanoseconds % 10**9))
    return kinds["std_msgs/msg/Header"](time, "")


def write_joint_states(
    path: Path,
    motion: Motion,
    storage: StoragePlugin = StoragePlugin.MCAP,
    seed: int = 2,
    compression: CompressionMode = CompressionMode.NONE,
) -> None:
    """`/joint_states` of two wheels, of which the second turns, and `/wheels/commands` in shares of 12 V.

    Speeds are those at the instant of the stamp, with a noise of 0.05 rad/s.
    """
    store, start = get_typestore(Stores.ROS2_JAZZY), 1_760_000_000_000_000_000
    joint, array = store.types["sensor_msgs/msg/JointState"], store.types["std_msgs/msg/Float64MultiArray"]
    layout = store.types["std_msgs/msg/MultiArrayLayout"]([], 0)
    generator = np.random.default_rng(seed)
    late = generator.uniform(2e5, 6e5, len(motion.time)).astype(np.int64)  # [ns]
    speed = motion.speed + generator.normal(0.0, 0.05, len(motion.time))
    writer = Writer(path, version=9, storage_plugin=storage)
    if compression is not CompressionMode.NONE:
        writer.set_compression(compression, CompressionFormat.ZSTD)
    with writer as bag:
        states = bag.add_connection("/joint_states", joint.__msgtype__, typestore=store)
        commands = bag.add_connection("/wheels/commands", array.__msgtype__, typestore=store)
        for k, now in enumerate(start + np.rint(motion.time * 1e9).astype(np.int64)):
            if k % 4 == 0:
                share = np.array([0.0, motion.voltage[k] / 12.0])
                message = array(layout, share)
                bag.write(commands, int(now), store.serialize_cdr(message, array.__msgtype__))
            message = joint(
                stamp(store, now),
                ["left_wheel", "right_wheel"],
                np.array([0.5, motion.angle[k]]),
                np.array([0.0, speed[k]]),
                np.zeros(0),
            )
            bag.write(states, int(now + late[k]), store.serialize_cdr(message, joint.__msgtype__))


def write_driver_states(path: Path, motion: Motion, storage: StoragePlugin = StoragePlugin.MCAP) -> None:
    """`/driver`, of a type that is not installed here: duty, counts (1440 a turn, 16 bits) and a battery."""
    store, start = get_typestore(Stores.ROS2_JAZZY), 1_760_000_000_000_000_000
    store.register(get_types_from_msg(DRIVER_DEFINITION, DRIVER))
    state, wheel = store.types[DRIVER], store.types["example_control_msgs/msg/WheelState"]
    ticks = np.floor(motion.angle / (2 * np.pi) * 1440).astype(np.int64) % 65536
    with Writer(path, version=9, storage_plugin=storage) as bag:
        topic = bag.add_connection("/driver", DRIVER, typestore=store)
        for k, now in enumerate(start + np.rint(motion.time * 1e9).astype(np.int64)):
            wheels = [
                wheel(0.0, 0.0, 0, 11.9),
                wheel(motion.voltage[k] / 12.0 * 255.0, motion.speed[k], int(ticks[k]), 11.9),
            ]
            message = state(stamp(store, now), ["left", "right"], wheels)
            bag.write(topic, int(now) + 300_000, store.serialize_cdr(message, DRIVER))
