"""A node on another machine hears nothing of our motors and moves none, unless the user has opened the network."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from domains import free_domain, free_domains
from patience import PATIENCE
from workbench import program

ROOT = Path(__file__).resolve().parents[2]
SUPPORT = ROOT / "tests" / "support"
OURS = ("FASTRTPS_DEFAULT_PROFILES_FILE", "ROS_AUTOMATIC_DISCOVERY_RANGE", "SKIP_DEFAULT_XML_FILE")
BARE = {name: value for name, value in os.environ.items() if name not in OURS}  # as if nobody had sourced env.sh
LISTEN = 5.0  # [s] a node without a profile tells of itself every 3 s
PLAIN = """
import sys, time, rclpy
from motor_msgs.msg import MotorSpeed
rclpy.init(domain_id=int(sys.argv[1]))
publisher = rclpy.create_node("plain").create_publisher(MotorSpeed, "motor/speed", 100)
while True:
    publisher.publish(MotorSpeed()); time.sleep(0.01)
"""


def namespaces_missing() -> str:
    """Why two machines cannot be played here; empty where they can."""
    if not all(map(shutil.which, ("unshare", "nsenter", "ip"))):
        return "no unshare, nsenter or ip here"
    done = subprocess.run(
        ["unshare", "-rnm", SUPPORT / "two_machines.sh", ":", "true"], capture_output=True, text=True, timeout=30.0
    )
    return f"the kernel lets us make no network namespace ({done.stderr.strip()})" if done.returncode else ""


def between_two_machines(plants: str, stranger: str) -> str:
    command = ["unshare", "-rnm", SUPPORT / "two_machines.sh", plants, stranger]
    done = subprocess.run(command, env=BARE, capture_output=True, text=True, timeout=3 * PATIENCE, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_a_stranger_hears_nothing_and_moves_nothing() -> None:
    """The plant as a program, as `ros2 run` in a shell with env.sh, a node of the user's own there; and one opened."""
    if why := namespaces_missing():
        pytest.skip(why)
    sim, closed, shell, own, opened = program("motor_sim", "motor_sim"), *free_domains(4)
    sourced = f"source {ROOT}/env.sh &&"
    plants = f"""
        ROS_DOMAIN_ID={closed} {sim} >/dev/null 2>&1 &
        (cd {ROOT} && {sourced} ROS_DOMAIN_ID={shell} exec ros2 run motor_sim motor_sim) >/dev/null 2>&1 &
        (cd {ROOT} && {sourced} exec {sys.executable} -c '{PLAIN}' {own}) >/dev/null 2>&1 &
        ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET ROS_DOMAIN_ID={opened} {sim} >/dev/null 2>&1 &
        sleep 1
    """
    script = f"{sys.executable} {SUPPORT / 'stranger.py'} {LISTEN} {closed} {shell} {own} {opened}"
    heard = json.loads(between_two_machines(plants, script))
    assert heard[:3] == [[0, 0.0]] * 3
    assert heard[3][0] > 100 and heard[3][1] > 50.0  # the same stranger drives the motor whose network was opened


def test_launched_plants_are_closed_too() -> None:
    pytest.importorskip("launch_ros", reason="ROS 2's launch system is not installed here (it is not on PyPI)")
    if why := namespaces_missing():
        pytest.skip(why)
    domain = free_domain()
    launch = f"(source {ROOT}/env.sh && ROS_DOMAIN_ID={domain} exec ros2 launch motor_bringup motor.launch.py)"
    stranger = f"{sys.executable} {SUPPORT / 'stranger.py'} {LISTEN} {domain}"
    heard = between_two_machines(f"{launch} >/dev/null 2>&1 & sleep 3", stranger)
    assert json.loads(heard) == [[0, 0.0]]
