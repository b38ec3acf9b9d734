"""A motor of another robot: joint states and a command topic recorded over DDS, identified by command and by node."""

import time
from pathlib import Path

import foreign_bags
import numpy as np
import pytest
from bags_over_dds import Start
from foreign_bags import KS, KV
from rclpy.qos import QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray
from workbench import Bench, end

from motor_identification.bag import messages
from motor_msgs.srv import Identify
from motor_ros import qos
from motor_ros.messages import time_message

MAPPING = """\
voltage: {from: '/wheels/commands:data[1]', scale: 12.0}
position: {from: '/joint_states:position[right_wheel]'}
"""


@pytest.mark.long
def test_what_record_wrote_of_other_topics_is_identified_by_the_node(
    bench: Bench, start: Start, tmp_path: Path
) -> None:
    motion = foreign_bags.move(12.0)
    deep = QoSProfile(depth=5000)
    states, commands = (
        bench.publisher(JointState, "joint_states", deep),
        bench.publisher(Float64MultiArray, "wheels/commands", deep),
    )
    names = [f"{bench.node.get_namespace().rstrip('/')}/{name}" for name in ("joint_states", "wheels/commands")]
    record = start("motor_identification", "record", tmp_path / "bag", *names)
    bench.heard(states, commands)
    begin = time.monotonic_ns()
    for k, now in enumerate(motion.time[::2]):  # 100 Hz of joint states, as fast as the motor moves
        while time.monotonic_ns() - begin < now * 1e9:
            time.sleep(0.0005)
        commands.publish(Float64MultiArray(data=[0.0, motion.voltage[2 * k] / 12.0]))
        state = JointState(name=["left_wheel", "right_wheel"], position=[0.0, float(motion.angle[2 * k])])
        state.header.stamp = time_message(time.time_ns())
        states.publish(state)
    bench.wait(lambda: sum(1 for _ in messages(tmp_path / "bag")) >= 2 * len(motion.time[::2]), "all in the bag")
    end(record)
    mapping = MAPPING.replace("/wheels/commands", names[1]).replace("/joint_states", names[0])
    (tmp_path / "mapping.yaml").write_text(mapping)
    parameters = ["-p", f"bag_directory:={tmp_path}", "-p", f"mapping:={tmp_path / 'mapping.yaml'}"]
    start("motor_identification", "motor_identification", "--ros-args", *parameters)
    request = Identify.Request(bag_uris=["bag"], effects=["coulomb_friction"])
    bench.wait(bench.node.create_client(Identify, "motor/identify", qos_profile=qos.REQUESTS).service_is_ready, "it")
    response = bench.call(Identify, "motor/identify", request)
    assert response.success, response.message
    found = dict(zip(response.model.parameter_names, response.model.parameter_values, strict=True))
    assert found["kv"] == pytest.approx(KV, rel=0.02) and found["ks"] == pytest.approx(KS, abs=0.1)
    assert np.isfinite(list(found.values())).all()


def test_a_mapping_that_is_none_ends_the_start_with_a_sentence(start: Start, tmp_path: Path) -> None:
    (tmp_path / "mapping.yaml").write_text("voltage: /a:x\n")
    node = start(
        "motor_identification", "motor_identification", "--ros-args", "-p", f"mapping:={tmp_path}/mapping.yaml"
    )
    _, err = node.communicate(timeout=60)
    assert node.returncode == 1 and "it needs voltage, and one of speed, position or count" in err
    assert "Traceback" not in err
