"""A player of recordings as rosbag2's: publishers of its topics first, and messages as soon as somebody listens.

`ros2 bag play` itself is not to be had from PyPI. A process of its own, so that its messages may come before its name.
"""

import os
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager

from workbench import ENVIRONMENT

RATE = 200.0  # [Hz]
DAY = 86_400_000_000_000  # [ns]


@contextmanager
def play(name: str, topic: str, recorded: bool, clock: bool = False) -> Iterator["subprocess.Popen[bytes]"]:
    """Play 5 V or 50 rad/s on a topic as a node of this name; recorded: with the stamps of yesterday; or its /clock."""
    environment = {**ENVIRONMENT, "PYTHONPATH": os.pathsep.join(sys.path)}
    words = [sys.executable, __file__, name, topic, "clock" if clock else "recorded" if recorded else ""]
    process = subprocess.Popen(words, env=environment)
    try:
        yield process
        assert process.poll() is None, "the player has ended"
    finally:
        process.terminate()
        process.wait()


def call_at_once(name: str, service: str) -> str:
    """Have a new node of this name call a service as soon as it can, and end: what it was answered."""
    environment = {**ENVIRONMENT, "PYTHONPATH": os.pathsep.join(sys.path)}
    words = [sys.executable, __file__, name, service, "calls"]
    return subprocess.run(words, env=environment, check=True, capture_output=True, text=True).stdout.strip()


def _call(name: str, service: str) -> None:
    import rclpy
    from std_srvs.srv import SetBool

    from motor_ros.loopback import stay_on_this_machine

    stay_on_this_machine()
    rclpy.init()
    node = rclpy.create_node(name, enable_rosout=False, start_parameter_services=False)
    client = node.create_client(SetBool, service)
    while not client.service_is_ready():
        time.sleep(1e-4)
    answer = client.call_async(SetBool.Request(data=True))
    rclpy.spin_until_future_complete(node, answer)
    print(answer.result().message)


def _run(name: str, topic: str, recorded: bool, clock: bool) -> None:
    import rclpy
    from rosgraph_msgs.msg import Clock
    from std_msgs.msg import Float64

    from motor_msgs.msg import MotorVoltage
    from motor_ros import qos
    from motor_ros.loopback import stay_on_this_machine
    from motor_ros.messages import time_message, voltage_message

    stay_on_this_machine()
    rclpy.init()
    node = rclpy.create_node(name, enable_rosout=False, start_parameter_services=False)
    voltages = topic.endswith("voltage")
    publisher = node.create_publisher(MotorVoltage if voltages else Float64, topic, qos.VOLTAGE)
    told = node.create_publisher(Clock, "/clock", 10) if clock else None
    while not publisher.get_subscription_count():  # it opens the recording meanwhile
        time.sleep(1e-4)
    while True:
        stamp = time_message(time.time_ns() - DAY if recorded else 0)
        if told is not None:
            told.publish(Clock(clock=stamp))
        publisher.publish(voltage_message(5.0, stamp, "motor") if voltages else Float64(data=50.0))
        time.sleep(1.0 / RATE)


if __name__ == "__main__":
    if sys.argv[3] == "calls":
        _call(sys.argv[1], sys.argv[2])
    else:
        _run(sys.argv[1], sys.argv[2], bool(sys.argv[3]), sys.argv[3] == "clock")
