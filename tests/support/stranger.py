"""A node on another machine: what it hears of the motors of several domains, and whether it can turn them.

`python stranger.py SECONDS DOMAIN…` prints a JSON list for each domain: messages heard, highest speed [rad/s] heard. It
ends when the motor of the last domain turns, but not before the seconds are over, nor ten times as late.
"""

import json
import os
import sys
import time

import rclpy
from rclpy.executors import SingleThreadedExecutor

from motor_msgs.msg import MotorSpeed, MotorVoltage

VOLTAGE = 7.0  # [V]
AT_REST = 0.5  # [s] at 0 V first: a plant lets nobody begin otherwise


class Stranger:
    """Listens and drives in one domain."""

    def __init__(self, domain: int) -> None:
        self.context = rclpy.Context()
        rclpy.init(context=self.context, domain_id=domain)
        self.node = rclpy.create_node("stranger", context=self.context)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)
        self.heard: list[float] = []
        self.node.create_subscription(MotorSpeed, "motor/speed", lambda message: self.heard.append(message.speed), 100)
        self.voltage = self.node.create_publisher(MotorVoltage, "motor/voltage", 1)
        self.found = 0.0  # when somebody listened first

    def turns(self) -> bool:
        """Whether the motor does, heard for a while."""
        return len(self.heard) > 100 and max(map(abs, self.heard)) > 50.0

    def act(self) -> None:
        self.executor.spin_once(timeout_sec=0.0)
        now = time.monotonic()
        if self.voltage.get_subscription_count() and not self.found:
            self.found = now
        driving = self.found and now - self.found > AT_REST
        self.voltage.publish(MotorVoltage(voltage=VOLTAGE if driving else 0.0))


def main(seconds: float, domains: list[int]) -> None:
    strangers = [Stranger(domain) for domain in domains]
    begun = time.monotonic()
    while (now := time.monotonic() - begun) < seconds or (not strangers[-1].turns() and now < 10 * seconds):
        for stranger in strangers:
            stranger.act()
        time.sleep(0.005)
    print(json.dumps([[len(stranger.heard), max(map(abs, stranger.heard), default=0.0)] for stranger in strangers]))
    sys.stdout.flush()
    os._exit(0)


if __name__ == "__main__":
    main(float(sys.argv[1]), [int(word) for word in sys.argv[2:]])
