"""`play` as a process over DDS: what is in the bag comes out again, in time and to everybody."""

import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from bags_over_dds import DEEP, INFO, PERIOD, Start, sample
from geometry_msgs.msg import Twist, Vector3
from rclpy.serialization import serialize_message
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64
from workbench import ENVIRONMENT, MANNERS, PATIENCE, Bench, end

from motor_identification.bag import BagWriter
from motor_identification.live.qos_profiles import offered
from motor_msgs.msg import MotorInfo, MotorSpeed, MotorVoltage
from motor_ros import qos
from motor_ros.messages import info_message, speed_message, time_message, voltage_message


def write(path: Path, count: int, period: int = PERIOD, chunk: int = 10**6) -> Path:
    with BagWriter(path) as writer:
        latched = writer.topic("/motor/info", "motor_msgs/msg/MotorInfo", offered(qos.INFO))
        channel = writer.topic("/motor/speed", "motor_msgs/msg/MotorSpeed", offered(qos.SPEED))
        writer.write(latched, 10**18, serialize_message(info_message(INFO, time_message(0))))
        for k in range(count):
            data = serialize_message(speed_message(sample(k), time_message(k * PERIOD), "wheel"))
            writer.write(channel, 10**18 + k * period, data)
            if k % chunk == chunk - 1:
                writer.flush()
    return path


@pytest.mark.on_time
def test_a_bag_comes_out_as_it_went_in_and_in_time(bench: Bench, start: Start, tmp_path: Path) -> None:
    heard: list[tuple[float, MotorSpeed]] = []
    bench.node.create_subscription(
        MotorSpeed, "motor/speed", lambda message: heard.append((time.monotonic(), message)), DEEP
    )
    play = start("motor_identification", "play", write(tmp_path / "bag", 200), "--rate", "1.5", "--loop")

    def begin() -> int:
        """Where the first whole round begins: on a busy machine the very first may be missed."""
        return next((k for k, (_, message) in enumerate(heard) if message.edge_count == 0), len(heard))

    bench.wait(lambda: len(heard) >= begin() + 400, "two rounds")
    rounds = heard[begin() : begin() + 400]
    expected = [(k % 200 * PERIOD, 100.0 + k % 200) for k in range(400)]
    assert [(message.sample_time, message.speed) for _, message in rounds] == expected
    assert rounds[-1][0] - rounds[0][0] == pytest.approx(399 * 0.005 / 1.5, abs=0.1)
    out, err = end(play)
    assert (play.returncode, err) == (0, "")
    assert out.startswith("Playing /motor/info, /motor/speed from ") and " Playback jitter: " in out


def test_without_loop_it_ends_by_itself_and_says_what_was_damaged(start: Start, tmp_path: Path) -> None:
    (file,) = write(tmp_path / "bag", 300, chunk=100).glob("*.mcap")
    data = bytearray(file.read_bytes())
    data[len(data) // 2] ^= 1  # in the second of three chunks
    file.write_bytes(data)
    play = start("motor_identification", "play", tmp_path / "bag", "--rate", "10")
    out, err = play.communicate(timeout=PATIENCE)
    assert play.returncode == 0
    assert err == f"{tmp_path}/bag is damaged: 100 messages cannot be read; what stands behind them is read.\n"
    assert re.search(r"201 messages played\. Playback jitter: \d+\.\d\d ms \(99 %\)\n", out)


def test_what_was_latched_is_latched_again_and_a_loop_ends_by_ctrl_c(
    bench: Bench, start: Start, tmp_path: Path
) -> None:
    speeds: list[MotorSpeed] = []
    bench.node.create_subscription(MotorSpeed, "motor/speed", speeds.append, DEEP)
    play = start("motor_identification", "play", write(tmp_path / "bag", 20), "--loop")
    bench.wait(lambda: len(speeds) >= 45, "the third round")
    infos: list[MotorInfo] = []
    bench.node.create_subscription(MotorInfo, "motor/info", infos.append, qos.INFO)
    bench.wait(lambda: bool(infos), "the latched info")
    assert infos[0].name == "wheel"
    assert [message.edge_count for message in speeds[:45]] == [(speeds[0].edge_count + k) % 20 for k in range(45)]
    out, err = end(play)
    assert (play.returncode, err) == (0, "") and "messages played" in out


@pytest.mark.parametrize("drives", [True, False])
def test_a_motor_is_not_driven_on_after_playing_stood_still(
    bench: Bench, start: Start, tmp_path: Path, drives: bool
) -> None:
    """Ctrl-Z, and fg when nobody thinks of the motor any more; what commands nothing goes on."""
    voltages, speeds = bench.hear(MotorVoltage, "motor/voltage"), bench.hear(MotorSpeed, "motor/speed")
    write(tmp_path / "bag", 600)
    with BagWriter(tmp_path / "driven") as writer:
        channel = writer.topic("/motor/voltage", "motor_msgs/msg/MotorVoltage", offered(qos.VOLTAGE))
        for k in range(600):
            writer.write(channel, 10**18 + k * PERIOD, serialize_message(voltage_message(6.0, time_message(0), "")))
    play = start("motor_identification", "play", tmp_path / ("driven" if drives else "bag"))
    bench.wait(lambda: len(voltages if drives else speeds) > 20, "the first ones")
    play.send_signal(signal.SIGSTOP)
    time.sleep(1.3)
    count = len(voltages)
    play.send_signal(signal.SIGCONT)
    out, err = play.communicate(timeout=PATIENCE)
    assert play.returncode == drives and ("Playing stood still for " in err) is drives
    if drives:
        bench.wait(lambda: bool(voltages) and voltages[-1].voltage == 0.0, "the last voltage")
        assert len(voltages) < count + 150  # what had been sent before, and the last one
    else:
        assert "601 messages played" in out


def test_ctrl_c_in_a_long_pause_ends_at_once(start: Start, tmp_path: Path) -> None:
    play = start("motor_identification", "play", write(tmp_path / "bag", 2, period=600 * 10**9))
    assert play.stdout is not None and play.stdout.readline().startswith("Playing ")
    out, _ = end(play)
    assert play.returncode == 0 and ("nothing played" in out or " 1 message played" in out or " 2 messages" in out)


def test_a_part_is_played_beside_a_plant_under_another_name(bench: Bench, start: Start, tmp_path: Path) -> None:
    live = bench.publisher(MotorSpeed, "motor/speed")
    speeds = bench.hear(MotorSpeed, "motor/speed", DEEP)
    shown = bench.hear(MotorSpeed, "recorded/speed", DEEP)
    infos = bench.hear(MotorInfo, "motor/info", qos.INFO)
    play = start(
        "motor_identification",
        *("play", write(tmp_path / "bag", 100), "--start-offset", "0.4", "--remap", "motor/speed:=recorded/speed"),
    )
    bench.wait(lambda: len(shown) >= 20 and bool(infos), "the rest of the bag")
    out, err = play.communicate(timeout=PATIENCE)
    assert (play.returncode, err) == (0, "")
    assert [message.edge_count for message in shown] == list(range(80, 100)) and speeds == []
    assert infos[0].name == "wheel"  # latched in the part that is left out
    assert out.startswith("Playing /motor/info, /motor/speed as /recorded/speed from ") and "20 messages played" in out
    play = start("motor_identification", "play", tmp_path / "bag", "--topics", "motor/speed")
    _, err = play.communicate(timeout=PATIENCE)
    assert err.startswith("bench publishes /motor/speed too, and listeners cannot tell the two apart: leave it out")
    assert "--remap /motor/speed:=/recorded/motor/speed." in err and err.count("\n") == 1
    assert live.get_subscription_count() == 1


PLAIN = """
import rclpy
from std_msgs.msg import Float64
rclpy.init()
node = rclpy.create_node("plain")
heard = []
node.create_subscription(Float64, "/x", lambda message: heard.append(message.data), 1000)
print("listening", flush=True)
while len(heard) < 3:
    rclpy.spin_once(node)
print(heard)
"""


def test_a_listener_that_tells_of_itself_as_seldom_as_ros_2_does_hears_all_of_it(start: Start, tmp_path: Path) -> None:
    with BagWriter(tmp_path / "bag") as writer:
        channel = writer.topic("/x", "std_msgs/msg/Float64", offered(DEEP))
        for k in range(3):
            writer.write(channel, 10**18 + k * PERIOD, serialize_message(Float64(data=float(k))))
    plain = {name: value for name, value in ENVIRONMENT.items() if name != "FASTRTPS_DEFAULT_PROFILES_FILE"}
    with subprocess.Popen([sys.executable, "-c", PLAIN], env=plain, stdout=subprocess.PIPE, text=True) as listener:
        try:
            assert listener.stdout is not None and listener.stdout.readline() == "listening\n"
            play = start("motor_identification", "play", tmp_path / "bag")  # it asks when the first news are over
            out, _ = play.communicate(timeout=PATIENCE)
            heard, _ = listener.communicate(timeout=MANNERS)
        finally:
            listener.kill()
    assert "3 messages played" in out and heard == "[0.0, 1.0, 2.0]\n"


@pytest.mark.parametrize("last", [4.0, 0.0])
def test_no_motor_is_left_under_a_voltage_or_at_a_speed(
    bench: Bench, start: Start, tmp_path: Path, last: float
) -> None:
    with BagWriter(tmp_path / "bag") as writer:
        channel = writer.topic("/motor/voltage", "motor_msgs/msg/MotorVoltage", offered(qos.VOLTAGE))
        reference = writer.topic("/motor/reference", "std_msgs/msg/Float64", offered(qos.REFERENCE))
        joint = writer.topic("/motor/joint_command", "sensor_msgs/msg/JointState", offered(qos.REFERENCE))
        robot = writer.topic("/cmd_vel", "geometry_msgs/msg/Twist", offered(qos.REFERENCE))
        for k, volts in enumerate((1.0, 2.0, last)):
            stamp = time_message(k)
            writer.write(channel, 10**18 + k * PERIOD, serialize_message(voltage_message(volts, stamp, "us")))
            writer.write(reference, 10**18 + k * PERIOD + 1, serialize_message(Float64(data=volts)))
            asked = JointState(name=["a"], velocity=[volts])
            writer.write(joint, 10**18 + k * PERIOD + 2, serialize_message(asked))
            writer.write(robot, 10**18 + k * PERIOD + 3, serialize_message(Twist(linear=Vector3(x=volts))))
    voltages = bench.hear(MotorVoltage, "motor/voltage", DEEP)
    references = bench.hear(Float64, "motor/reference", DEEP)
    joints, robots = bench.hear(JointState, "motor/joint_command", DEEP), bench.hear(Twist, "cmd_vel", DEEP)
    play = start("motor_identification", "play", tmp_path / "bag")
    bench.wait(lambda: play.poll() is not None, "the end of the bag")
    bench.wait(lambda: len(voltages) >= 3 and voltages[-1].voltage == 0.0, "0 V")
    expected = [1.0, 2.0, 4.0, 0.0] if last else [1.0, 2.0, 0.0]
    assert [message.voltage for message in voltages] == expected
    bench.wait(lambda: len(references) >= len(expected), "a reference of 0")
    assert [message.data for message in references] == expected
    bench.wait(lambda: min(len(joints), len(robots)) >= len(expected), "a joint and a robot at rest")
    assert [message.velocity[0] for message in joints] == [message.linear.x for message in robots] == expected


def test_a_cut_bag_is_played_and_gets_its_metadata(start: Start, tmp_path: Path) -> None:
    with BagWriter(tmp_path / "going/on") as writer:
        channel = writer.topic("/motor/speed", "motor_msgs/msg/MotorSpeed", offered(qos.SPEED))
        for k in range(120):
            data = serialize_message(speed_message(sample(k), time_message(k * PERIOD), "wheel"))
            writer.write(channel, 10**18 + k * PERIOD, data)
            if k == 99:
                writer.flush()
                shutil.copytree(tmp_path / "going/on", tmp_path / "bag")  # what a crash at this moment leaves
    play = start("motor_identification", "play", tmp_path / "bag", "--rate", "10")
    out, err = play.communicate(timeout=PATIENCE)
    assert play.returncode == 0 and "100 messages played" in out
    assert (
        "is cut off: 100 messages, 0.50 s up to the cut." in err and "had no metadata.yaml; it has been written" in err
    )
    assert (tmp_path / "bag/metadata.yaml").is_file()


def test_only_the_topics_that_are_named(bench: Bench, start: Start, tmp_path: Path) -> None:
    infos: list[MotorInfo] = []
    speeds: list[MotorSpeed] = []
    bench.node.create_subscription(MotorInfo, "motor/info", infos.append, qos.INFO)
    bench.node.create_subscription(MotorSpeed, "motor/speed", speeds.append, DEEP)
    play = start("motor_identification", "play", write(tmp_path / "bag", 5), "--topics", "motor/info", "--loop")
    bench.wait(lambda: len(infos) >= 2, "the info twice")
    end(play)
    assert speeds == [] and len(infos) < 10  # a lone message does not come in a flood


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (["{0}/nothing"], "There is no bag"),
        (["{0}/empty"], "has no messages"),
        (["{0}/bag", "--topics", "/other"], "has no messages on /other; it has /motor/info, /motor/speed"),
        (["{0}/bag", "--remap", "other:=new"], "has no messages on /other; it has /motor/info, /motor/speed"),
        (["{0}/bag", "--start-offset", "7"], "is 0.01 s long: choose a --start-offset below that"),
        (["{0}/odd"], "no topic that can be played here"),
    ],
)
def test_what_cannot_be_played(start: Start, tmp_path: Path, arguments: list[str], complaint: str) -> None:
    write(tmp_path / "bag", 2)
    BagWriter(tmp_path / "empty").close()
    with BagWriter(tmp_path / "odd") as writer:
        writer.write(writer.topic("/odd", "nowhere_msgs/msg/Odd"), 5, b"\x00\x01\x00\x00")
    play = start("motor_identification", "play", *(argument.format(tmp_path) for argument in arguments))
    out, err = play.communicate(timeout=PATIENCE)
    assert (play.returncode, out) == (1, "") and complaint in err and "Traceback" not in err
