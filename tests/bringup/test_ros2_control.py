"""The files for ros2_control name our topics and joints, and what its topic-based hardware needs to send at all."""

import xml.etree.ElementTree as Tree
from pathlib import Path

import yaml
from bringup_tables import NODES

from motor_bringup.diff_drive import SIDES
from motor_ros.topics import TOPICS

FOLDER = Path(__file__).resolve().parents[2] / "motor_bringup" / "ros2_control"
XACRO = "{http://www.ros.org/wiki/xacro}"
ROBOT = Tree.parse(FOLDER / "two_wheels.urdf.xacro").getroot()
CONTROLLERS = yaml.safe_load((FOLDER / "controllers.yaml").read_text(encoding="utf-8"))


def test_each_motor_is_a_component_on_its_own_topics() -> None:
    params = {str(param.get("name")): param.text for param in ROBOT.iter("param")}
    topics = {topic.name for topic in TOPICS}
    for name in ("motor/joint_command", "joint_states"):
        assert name in topics and f"/${{name}}/{name}" in params.values()
    assert params["trigger_joint_command_threshold"] == "-1"  # else nothing is sent to a wheel at 0 rad
    assert [one.get("name") for one in ROBOT.iter("command_interface")] == ["velocity"]
    assert [one.get("name") for one in ROBOT.findall(f"{XACRO}wheel")] == list(SIDES)


def test_the_controllers_drive_those_joints_of_the_same_robot() -> None:
    drive = CONTROLLERS["diff_drive_controller"]["ros__parameters"]
    assert (drive["left_wheel_names"], drive["right_wheel_names"]) == ([SIDES[0]], [SIDES[1]])
    ours = {row.name: row.default for row in NODES["diff_drive"][1]}
    said = {str(one.get("name")): one.get("default") for one in ROBOT.iter(f"{XACRO}arg")}
    for name in ("wheel_radius", "wheel_separation"):
        assert drive[name] == ours[name] == float(str(said[name]))
    assert drive["linear"]["x"]["max_velocity"] == ours["max_linear"]
    assert drive["cmd_vel_timeout"] == ours["cmd_vel_timeout"]
