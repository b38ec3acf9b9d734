"""What hearing alone costs: a bare node with the recorder's subscriptions, that counts serialised messages."""

import sys
import time

from rclpy.node import Node
from rclpy.qos import QoSProfile
from sensor_msgs.msg import JointState

from motor_msgs.msg import MotorSpeed, MotorVoltage
from motor_ros.run import run

TOPICS = {"motor/speed": MotorSpeed, "joint_states": JointState, "motor/voltage": MotorVoltage}
PLENTY = QoSProfile(depth=1000)  # as the recorder has


class Peer(Node):
    """Says once, at its end, how many messages it has heard."""

    def __init__(self) -> None:
        super().__init__("recording_peer", enable_rosout=False, start_parameter_services=False)
        self._counts = dict.fromkeys(TOPICS, 0)
        self._began = time.monotonic()
        for topic, kind in TOPICS.items():
            self.create_subscription(kind, topic, lambda data, topic=topic: self._count(topic), PLENTY, raw=True)

    def _count(self, topic: str) -> None:
        self._counts[topic] += 1

    def close(self) -> None:
        """The result."""
        print(", ".join(f"{topic} {count}" for topic, count in self._counts.items()), flush=True)


if __name__ == "__main__":
    sys.exit(run(Peer, sys.argv))
