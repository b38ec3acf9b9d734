"""A motor of another robot: joint states and a command topic recorded over DDS, identified by command and by node."""

import time
from itertools import count
from pathlib import Path

import foreign_bags
import numpy as np
import pytest
from bags_over_dds import Start
from foreign_bags import KS, KV
from plant_user import count_stop
from rclpy.action import ActionClient
from rclpy.qos import QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray
from workbench import Bench, end

from motor_identification.bag import messages
from motor_msgs.action import Diagnose
from motor_msgs.srv import Identify
from motor_ros import qos
from motor_ros.messages import time_message

PERIOD = 0.01  # [s] of the commands
MAPPING = """\
voltage: {from: '/wheels/commands:data[1]', scale: 12.0}
position: {from: '/joint_states:position[right_wheel]'}
"""


PATIENCE = 120.0  # [s] for a diagnosis
LATE = 0.02  # [s] between commands and what a recorder says of when they came: more, and the motor looks slow


def held_up(bag: Path, topic: str) -> bool:
    """Whether the recorder, or who published, was: the commands, which have no stamp of their own, are late then."""
    times = np.array([row[2] for row in messages(bag, {topic})]) * 1e-9
    return bool(np.max(np.diff(times)) > PERIOD + LATE)


def recorded(bench: Bench, start: Start, directory: Path, mapping: Path, *names: str) -> Path:
    """A bag of joint states and commands in real time; again, and counted, where a busy machine was late."""
    motion, deep = foreign_bags.move(6.0), QoSProfile(depth=5000)
    states, commands = (
        bench.publisher(kind, name, deep) for kind, name in zip((JointState, Float64MultiArray), names, strict=True)
    )
    for attempt in count(1):
        bag = directory / f"bag_{attempt}"
        record = start("motor_identification", "record", bag, "--mapping", mapping)
        bench.wait(
            lambda: all(one.get_subscription_count() == 1 for one in (states, commands)), "the recorder"
        )  # and no earlier one
        begin, first = time.monotonic_ns(), time.time_ns()
        for k, now in enumerate(motion.time[::2]):  # 100 Hz of joint states, as fast as the motor moves
            while time.monotonic_ns() - begin < now * 1e9:
                time.sleep(0.0005)
            commands.publish(Float64MultiArray(data=[0.0, motion.voltage[2 * k] / 12.0]))
            state = JointState(name=["left_wheel", "right_wheel"], position=[0.0, float(motion.angle[2 * k])])
            state.header.stamp = time_message(first + round(now * 1e9))
            states.publish(state)
        bench.wait(lambda: sum(1 for _ in messages(bag)) >= 2 * len(motion.time[::2]), "all in the bag")  # noqa: B023
        end(record)
        if not held_up(bag, names[1]):
            return bag
        count_stop(attempt, "a recording in real time")
    raise AssertionError


@pytest.mark.slow
@pytest.mark.long
def test_what_record_wrote_of_other_topics_is_identified_by_the_node(
    bench: Bench, start: Start, tmp_path: Path
) -> None:
    names = [f"{bench.node.get_namespace().rstrip('/')}/{name}" for name in ("joint_states", "wheels/commands")]
    mapping = MAPPING.replace("/wheels/commands", names[1]).replace("/joint_states", names[0])
    (tmp_path / "mapping.yaml").write_text(mapping)
    bag = recorded(bench, start, tmp_path, tmp_path / "mapping.yaml", *names)
    parameters = ["-p", f"bag_directory:={tmp_path}", "-p", f"mapping:={tmp_path / 'mapping.yaml'}"]
    start("motor_identification", "motor_identification", "--ros-args", *parameters)
    request = Identify.Request(bag_uris=[bag.name], effects=["coulomb_friction"])
    bench.wait(bench.node.create_client(Identify, "motor/identify", qos_profile=qos.REQUESTS).service_is_ready, "it")
    response = bench.call(Identify, "motor/identify", request)
    assert response.success, response.message
    found = dict(zip(response.model.parameter_names, response.model.parameter_values, strict=True))
    assert found["kv"] == pytest.approx(KV, rel=0.02) and found["ks"] == pytest.approx(KS, abs=0.1)
    assert np.isfinite(list(found.values())).all()


@pytest.mark.slow
@pytest.mark.long
def test_a_bag_of_other_topics_is_diagnosed_by_the_node(bench: Bench, start: Start, tmp_path: Path) -> None:
    foreign_bags.write_joint_states(tmp_path / "robot", foreign_bags.move(8.0))
    (tmp_path / "mapping.yaml").write_text(MAPPING)
    parameters = ["-p", f"bag_directory:={tmp_path}", "-p", f"mapping:={tmp_path / 'mapping.yaml'}"]
    start("motor_identification", "motor_identification", "--ros-args", *parameters)
    result = diagnosed(bench, "robot")
    assert result.success and result.effects == ["coulomb_friction"], result.message
    assert (tmp_path / "robot_diagnosis.html").exists()


def diagnosed(bench: Bench, bag: str) -> Diagnose.Result:
    """What the action says of a bag."""
    client = ActionClient(bench.node, Diagnose, "motor/diagnose")
    bench.wait(client.server_is_ready, "motor/diagnose")
    bench.known_to("motor_identification")
    sent = client.send_goal_async(Diagnose.Goal(bag_uris=[bag]))
    bench.wait(sent.done, "the goal's acceptance")
    answer = sent.result().get_result_async()
    bench.wait(answer.done, "a result", PATIENCE)
    client.destroy()
    return answer.result().result


def test_a_mapping_that_is_none_ends_the_start_with_a_sentence(start: Start, tmp_path: Path) -> None:
    (tmp_path / "mapping.yaml").write_text("voltage: /a:x\n")
    node = start(
        "motor_identification", "motor_identification", "--ros-args", "-p", f"mapping:={tmp_path}/mapping.yaml"
    )
    _, err = node.communicate(timeout=120.0)
    assert node.returncode == 1 and "it needs voltage, and one of speed, position or count" in err
    assert "Traceback" not in err
