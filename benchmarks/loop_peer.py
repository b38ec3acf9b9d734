"""What ROS alone costs a controller: a bare node that answers each sample with the controller's two messages.

With `--quick` on the executor that the controller has, else on the one that rclpy gives everybody.
"""

import sys

from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

from motor_msgs.msg import ControlState, MotorSpeed, MotorVoltage
from motor_ros import qos
from motor_ros.run import quick_executor, run


class Echo(Node):
    """Takes samples; sends a voltage and a state, always the same."""

    def __init__(self) -> None:
        super().__init__("echo")
        self._voltage = self.create_publisher(MotorVoltage, "motor/voltage", qos.VOLTAGE)
        self._state = self.create_publisher(ControlState, "motor/control_state", qos.CONTROL_STATE)
        self.create_subscription(MotorSpeed, "motor/speed", self._on_speed, qos.SPEED)

    def _on_speed(self, message: MotorSpeed) -> None:
        self._voltage.publish(MotorVoltage(header=message.header, voltage=7.3))
        self._state.publish(ControlState(header=message.header, state="running", reference=100.0, voltage=7.3))


if __name__ == "__main__":
    sys.exit(run(Echo, sys.argv, quick_executor if "--quick" in sys.argv else SingleThreadedExecutor))
