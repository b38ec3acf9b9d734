"""Who drives the motor during a soak, and keeps every sample's times and what /diagnostics says."""

from array import array
from collections import Counter
from dataclasses import dataclass
from itertools import pairwise
from math import sin, tau
from statistics import median

import numpy as np
from diagnostic_msgs.msg import DiagnosticArray
from numpy.typing import NDArray
from rclpy.node import Node
from rclpy.qos import QoSProfile
from soak_peer import PEER
from std_srvs.srv import SetBool

from motor_driver.clock.board_clock import POWER_UP
from motor_driver.clock.clock_fit import WINDOW
from motor_msgs.msg import MotorSpeed, MotorVoltage
from motor_ros import qos
from motor_ros.messages import time_message, voltage_message

COMMANDS = 200  # [Hz] at most
PLENTY = QoSProfile(depth=5000)  # whoever measures loses nothing because he is late
FORGETS = WINDOW // 1_000_000_000 + 1  # [s] the driver's fit of the board's clock; truths come once a second


@dataclass(frozen=True)
class Truth:
    """What the emulator said of its clock."""

    samples: int  # heard before
    zero: float  # [ns] ROS time at which the board's clock was at 0
    rate: float  # of the board's clock beside the computer's
    held_up: int  # times that the emulator did not keep up


class Listener(Node):
    """Sends a voltage after a sample, as a controller would."""

    def __init__(self, rate: int, port: str) -> None:
        super().__init__("listener")
        self._every, self._port = max(rate // COMMANDS, 1), port
        self.sample_times, self.stamps = array("q"), array("q")  # [ns]
        self.driver: dict[str, str] = {}  # what it said last
        self.truths: list[Truth] = []
        self.warnings: Counter[str] = Counter()
        self.stops, self.peers, self.fastest = 0, 0, 0.0
        self._voltages = [
            self.create_publisher(MotorVoltage, f"{name}/voltage", qos.VOLTAGE) for name in ("motor", PEER)
        ]
        self._enable = self.create_client(SetBool, "motor/enable")
        self.create_subscription(MotorSpeed, "motor/speed", self._on_speed, PLENTY)
        self.create_subscription(MotorSpeed, f"{PEER}/speed", self._on_peer, PLENTY, raw=True)
        self.create_subscription(DiagnosticArray, "/diagnostics", self._on_diagnostics, qos.DIAGNOSTICS)

    @property
    def hears_all(self) -> bool:
        """Whether driver, board and peer have all been heard."""
        return bool(self.stamps and self.driver and self.truths and self.peers)

    def _on_speed(self, message: MotorSpeed) -> None:
        stamp = message.header.stamp
        self.sample_times.append(message.sample_time)
        self.stamps.append(1_000_000_000 * stamp.sec + stamp.nanosec)
        self.fastest = max(self.fastest, message.speed)
        if len(self.stamps) % self._every == 0:
            voltage = 7.0 + 5.0 * sin(tau * message.sample_time * 1e-9 / 20.0)
            for publisher in self._voltages:
                publisher.publish(voltage_message(voltage, time_message(self.stamps[-1]), "soak"))

    def _on_peer(self, message: bytes) -> None:
        self.peers += 1

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        status = message.status[0]
        values = {pair.key: pair.value for pair in status.values}
        if "clock rate" in values:
            zero, rate = float(values["board clock zero [ns, ROS time]"]), float(values["clock rate"])
            self.truths.append(Truth(len(self.stamps), zero, rate, int(values["held up"])))
            return
        self.driver = values
        if status.level != b"\0":
            self.warnings[status.message.replace(self._port, "the port")] += 1
        if "until motor/enable" in status.message:
            self.stops += 1
            self._enable.call_async(SetBool.Request(data=True))


def lost_samples(sample_times: "array[int]", rate: int) -> int:
    """How many should lie between those that were heard, at this rate [Hz]."""
    return int(np.sum(np.rint(np.diff(np.array(sample_times)) * (rate * 1e-9)) - 1))


def stamp_errors(listener: Listener, begin: int) -> NDArray[np.float64]:
    """[ms] header stamps less the emulator's truth, while the emulated board's clock runs.

    It stands still when the machine holds the emulator up, which no board's does: what the driver's fit still holds of
    the time before is left out.
    """
    truths = listener.truths
    zeros = {
        held_up: int(median(truth.zero for truth in truths if truth.held_up == held_up))
        for held_up in {truth.held_up for truth in truths}
    }
    stamps, times = np.array(listener.stamps), np.array(listener.sample_times) - POWER_UP
    parts: list[NDArray[np.float64]] = [np.empty(0)]
    for k, (one, other) in enumerate(pairwise(truths)):
        if truths[max(k - FORGETS, 0)].held_up == other.held_up and one.samples >= begin:
            part = slice(one.samples, other.samples)
            parts.append((stamps[part] - zeros[one.held_up] - times[part] / one.rate) * 1e-6)
    return np.concatenate(parts)
