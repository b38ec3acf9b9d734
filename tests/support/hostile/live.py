"""Living nodes that hear garbled messages on all their topics, and parameters that no node has."""

import time
from contextlib import suppress
from random import Random
from typing import Any

import workbench
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.serialization import serialize_message
from std_msgs.msg import Float64

from hostile.kind import ROOT
from hostile.mcap_mutation import changed_bytes
from motor_msgs.msg import ControlState, MotorHealth, MotorInfo, MotorSpeed, MotorVoltage
from motor_ros import qos

NODES = (
    ("motor_sim", "motor_sim"),
    ("motor_control", "motor_control"),
    (
        "motor_identification",
        "monitor",
        "--ros-args",
        "-p",
        f"model:={ROOT / 'bags' / 'paper.yaml'}",
        "-p",
        "window:=1.0",
    ),
)
TOPICS: tuple[tuple[Any, str, Any], ...] = (
    (MotorVoltage, "motor/voltage", qos.VOLTAGE),
    (Float64, "motor/reference", qos.REFERENCE),
    (MotorSpeed, "motor/speed", qos.SPEED),
    (MotorInfo, "motor/info", qos.INFO),
)


def garbled_messages(count: int, seed: int) -> str:
    """Send so many garbled messages on each topic to a plant, a controller and a monitor; what became of them.

    Raises:
        AssertionError: one of them has died, or has said more than a sentence at its end.
    """
    random, bench = Random(seed), workbench.Bench()
    nodes = [workbench.start(*words) for words in NODES]
    try:
        samples = bench.hear(MotorSpeed, "motor/speed")
        states = bench.hear(ControlState, "motor/control_state")
        health = bench.hear(MotorHealth, "motor/health", qos.HEALTH)
        bench.wait(lambda: bool(samples and states and health), "a plant, a controller and a monitor")
        for kind, topic, profile in TOPICS:
            _send(bench, kind, topic, profile, count, random)
        for node, (_, name, *_) in zip(nodes, NODES, strict=True):
            for value in (float("nan"), float("inf"), -1e308, 0.0):
                bench.set(name, {"motor_sim": "max_voltage", "motor_control": "kp", "monitor": "window"}[name], value)
            assert node.poll() is None, f"{name} has died"
        del samples[:], health[:]
        bench.wait(lambda: bool(samples and health), "a sample and a verdict afterwards")
        for node in nodes:
            _, said = workbench.end(node)
            assert node.returncode == 0 and "mistake of the workbench" not in said, said
    finally:
        workbench.quit_all([node for node in nodes if node.poll() is None])
        bench.close()
    return f"Living nodes: {count * len(TOPICS)} garbled messages to a plant, a controller and a monitor; all lived on."


def _send(bench: workbench.Bench, kind: Any, topic: str, profile: Any, count: int, random: Random) -> None:
    publisher = bench.publisher(kind, topic, profile)
    bench.heard(publisher)
    good = serialize_message(kind())
    for _ in range(count):
        with suppress(rclpy_implementation.RCLError):  # what the middleware does not even send
            publisher.publish(changed_bytes(good, random))
        time.sleep(0.003)
        bench.executor.spin_once(timeout_sec=0.0)
    bench.node.destroy_publisher(publisher)
