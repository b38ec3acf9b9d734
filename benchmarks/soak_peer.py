"""What ROS alone costs: a bare node that sends and takes what the driver does, and does nothing else."""

import sys
import time

from rclpy.node import Node
from sensor_msgs.msg import JointState

from motor_msgs.msg import MotorSpeed, MotorVoltage
from motor_ros import qos
from motor_ros.run import run

PEER = "peer"


class Peer(Node):
    """`rate` samples a second; takes voltages."""

    def __init__(self) -> None:
        super().__init__(PEER)
        rate = float(self.declare_parameter("rate", 200.0).value)
        self._speed = self.create_publisher(MotorSpeed, f"{PEER}/speed", qos.SPEED)
        self._joint = self.create_publisher(JointState, f"{PEER}/joint_states", qos.JOINT_STATES)
        self.create_subscription(MotorVoltage, f"{PEER}/voltage", lambda message: None, qos.VOLTAGE)
        self.create_timer(1.0 / rate, self._send)

    def _send(self) -> None:
        stamp, now = self.get_clock().now().to_msg(), time.monotonic_ns()
        speed = MotorSpeed(
            sample_time=now,
            speed=1.0,
            voltage=1.0,
            edge_count=1,
            edge_time=now,
            edge_period=1e-3,
            supply_voltage=1.0,
            current=1.0,
        )
        joint = JointState(name=["motor"], position=[1.0], velocity=[1.0])
        speed.header.stamp = joint.header.stamp = stamp
        speed.header.frame_id = "motor"
        self._speed.publish(speed)
        self._joint.publish(joint)


if __name__ == "__main__":
    sys.exit(run(Peer, sys.argv))
