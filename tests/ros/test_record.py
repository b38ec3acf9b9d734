"""`record` as a process over DDS: what is published is what is in the bag."""

import resource
import signal
import time
from pathlib import Path
from typing import Any

import pytest
from bags_over_dds import DEEP, INFO, PERIOD, Start, sample
from rclpy.duration import Duration
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message
from std_msgs.msg import Float64
from workbench import PATIENCE, Bench, end

from motor_identification.bag import BagWriter, messages, read_recording, topics
from motor_identification.cli.record import main
from motor_identification.live.recorder import Recorder
from motor_msgs.msg import MotorInfo, MotorSpeed
from motor_ros import qos
from motor_ros.messages import info_message, speed_message, time_message


def written(bench: Bench, bag: Path, count: int) -> None:
    """Wait until so many messages are in the file, which is still being written."""
    bench.wait(lambda: bag.is_dir() and sum(1 for _ in messages(bag)) >= count, f"{count} messages in the bag")


def say(publisher: Any, numbers: range) -> None:
    for k in numbers:
        publisher.publish(speed_message(sample(k), time_message(k * PERIOD), "wheel"))


def recorded(bag: Path) -> set[str]:
    """Topics of the messages in a bag, which may still be written."""
    return {row[0] for row in messages(bag)} if bag.is_dir() else set()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_everything_that_was_published_is_in_the_bag(
    bench: Bench, start: Start, tmp_path: Path, number: signal.Signals
) -> None:
    info = bench.publisher(MotorInfo, "motor/info", qos.INFO)
    info.publish(info_message(INFO, time_message(0)))  # before anybody listens: it is latched
    speed = bench.publisher(MotorSpeed, "motor/speed", DEEP)
    before = time.time_ns()
    record = start("motor_identification", "record", tmp_path / "bag")
    bench.heard(speed, info)
    say(speed, range(400))
    reference = bench.publisher(Float64, "motor/reference", qos.REFERENCE)  # later than all others
    bench.heard(reference)
    reference.publish(Float64(data=7.0))
    written(bench, tmp_path / "bag", 402)
    out, err = end(record, number)
    after = time.time_ns()
    assert record.returncode == 0 and err == ""
    assert out.splitlines()[-1].startswith(f"{tmp_path}/bag: 402 messages, ")
    recording = read_recording(tmp_path / "bag")
    assert recording.sample_time.tolist() == [k * PERIOD for k in range(400)]
    assert recording.speed.tolist() == [100.0 + k for k in range(400)]
    assert recording.info == INFO and recording.notes == ()
    counts = {topic.name: topic.message_count for topic in topics(tmp_path / "bag")}
    assert counts == {"/motor/info": 1, "/motor/speed": 400, "/motor/reference": 1}
    durability = {topic.name: topic.qos[0].durability for topic in topics(tmp_path / "bag")}
    assert durability == {
        "/motor/info": "transient_local",
        "/motor/speed": "volatile",
        "/motor/reference": "volatile",
    }
    times = [row[2] for row in messages(tmp_path / "bag", {"/motor/speed"})]
    assert before < min(times) and max(times) < after and times == sorted(times)


def test_named_topics_in_a_namespace_and_best_effort(bench: Bench, start: Start, tmp_path: Path) -> None:
    best_effort = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
    near = bench.publisher(Float64, "/left/near", best_effort)
    far = bench.publisher(Float64, "/far")
    bench.publisher(Float64, "/left/other")
    record = start(
        "motor_identification", "record", tmp_path / "bag", "near", "/far", "never", "--topic-namespace", "left"
    )
    bench.heard(near, far)
    far.publish(Float64(data=1.0))

    def both() -> bool:
        near.publish(Float64(data=2.0))  # again and again: with best effort the first ones may be lost
        return {"/left/near", "/far"} <= recorded(tmp_path / "bag")

    bench.wait(both, "both in the bag")
    out, _ = end(record)
    assert {topic.name: topic.qos[0].reliability for topic in topics(tmp_path / "bag")} == {
        "/left/near": "best_effort",
        "/far": "reliable",
    }
    assert out.rstrip().endswith("; nothing came on /left/never")


def test_a_reference_that_is_published_once_by_a_program_that_ends_is_recorded(
    bench: Bench, start: Start, tmp_path: Path
) -> None:
    speed = bench.publisher(MotorSpeed, "motor/speed", DEEP)
    record = start("motor_identification", "record", tmp_path / "bag")
    controller = bench.hear(Float64, "motor/reference", qos.REFERENCE)  # record joins who listens
    bench.heard(speed)
    bench.wait(lambda: bench.node.count_subscribers("motor/reference") == 2, "the recorder on motor/reference")
    say(speed, range(5))
    for k in range(5):
        reference = bench.publisher(Float64, "motor/reference", qos.REFERENCE)
        bench.wait(lambda of=reference: of.get_subscription_count() == 2, "both")  # no sooner, and no later
        reference.publish(Float64(data=float(k)))
        assert reference.wait_for_all_acked(Duration(seconds=PATIENCE))
        bench.wait(lambda k=k: len(controller) > k, "the reference")
        bench.node.destroy_publisher(reference)
    written(bench, tmp_path / "bag", 10)
    end(record)
    data = [deserialize_message(row[3], Float64).data for row in messages(tmp_path / "bag", {"/motor/reference"})]
    assert data == [message.data for message in controller] == [0.0, 1.0, 2.0, 3.0, 4.0]
    assert {topic.name for topic in topics(tmp_path / "bag")} == {"/motor/speed", "/motor/reference"}


def test_all_topics(bench: Bench, start: Start, tmp_path: Path) -> None:
    one, two = bench.publisher(Float64, "/one"), bench.publisher(Float64, "/two/deep")
    record = start("motor_identification", "record", tmp_path / "bag", "--all")
    bench.heard(one, two)
    one.publish(Float64(data=1.0))
    two.publish(Float64(data=2.0))
    bench.wait(lambda: {"/one", "/two/deep"} <= recorded(tmp_path / "bag"), "both in the bag")
    end(record)
    assert record.returncode == 0


def test_a_duration_ends_it(bench: Bench, start: Start, tmp_path: Path) -> None:
    latched = bench.publisher(MotorInfo, "motor/info", qos.INFO)
    latched.publish(info_message(INFO, time_message(0)))
    record = start("motor_identification", "record", tmp_path / "bag", "--duration", "5")
    bench.wait(lambda: record.poll() is not None, "the end of the duration")
    assert record.returncode == 0 and recorded(tmp_path / "bag") == {"/motor/info"}
    assert record.stdout is not None and "; nothing came on /motor/speed" in record.stdout.read()


def test_nothing_recorded_is_said_and_leaves_no_bag(start: Start, tmp_path: Path) -> None:
    record = start("motor_identification", "record", tmp_path / "bag", "/nobody/says/this")
    assert record.stdout is not None and "Recording /nobody/says/this" in record.stdout.readline()
    _, err = end(record)
    assert record.returncode == 1
    assert err.startswith("Nothing was recorded") and "/nobody/says/this" in err and err.count("\n") == 1
    assert not (tmp_path / "bag").exists()


def test_an_existing_bag_is_refused_at_once(start: Start, tmp_path: Path) -> None:
    (tmp_path / "bag").mkdir()
    record = start("motor_identification", "record", tmp_path / "bag")
    out, err = record.communicate(timeout=PATIENCE)
    assert (record.returncode, out) == (1, "") and "exists already and is left as it is" in err
    assert list((tmp_path / "bag").iterdir()) == []


def test_what_has_arrived_when_recording_ends_is_written(bench: Bench, tmp_path: Path) -> None:
    speed = bench.publisher(MotorSpeed, "motor/speed")
    with BagWriter(tmp_path / "bag") as writer:
        recorder = Recorder(bench.node, writer, ["/motor/speed"])
        bench.heard(speed)
        say(speed, range(50))
        assert speed.wait_for_all_acked(Duration(seconds=PATIENCE))
        assert recorder.counts["/motor/speed"] == 0  # nobody has spun
        recorder.close()
        assert recorder.counts["/motor/speed"] == 50
    assert read_recording(tmp_path / "bag").sample_time.tolist() == [k * PERIOD for k in range(50)]


def test_a_clock_that_stands_holds_no_recording_up(bench: Bench, tmp_path: Path) -> None:
    """As after the system's clock was set back: what came was taken an hour later, but for the latest few hundred."""
    bench.node.set_parameters([Parameter("use_sim_time", value=True)])
    speed = bench.publisher(MotorSpeed, "motor/speed")
    with BagWriter(tmp_path / "bag") as writer:
        recorder = Recorder(bench.node, writer, ["/motor/speed"])
        bench.heard(speed)
        say(speed, range(50))
        bench.wait(lambda: recorder.counts["/motor/speed"] == 50, "what was said")
        recorder.close()


def test_a_full_disk_ends_recording_and_loses_nothing(bench: Bench, start: Start, tmp_path: Path) -> None:
    speed = bench.publisher(MotorSpeed, "motor/speed", DEEP)
    record = start("motor_identification", "record", tmp_path / "bag")
    bench.heard(speed)
    say(speed, range(100))
    written(bench, tmp_path / "bag", 100)
    resource.prlimit(record.pid, resource.RLIMIT_FSIZE, (1000, 1000))  # the file is longer already
    say(speed, range(100, 200))
    bench.wait(lambda: record.poll() is not None, "the end of recording")
    _, err = record.communicate()
    assert record.returncode == 1
    assert err == (
        f"{tmp_path}/bag cannot be written (File too large): make room, or choose another place; "
        "the 100 messages recorded until then are kept.\n"
    )
    assert read_recording(tmp_path / "bag").sample_time.tolist() == [k * PERIOD for k in range(100)]


@pytest.mark.parametrize("other", [["motor/speed"], ["--all"]])
def test_a_mapping_names_the_topics_alone(other: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        main(["bag", *other, "--mapping", "mapping.yaml"])
    assert caught.value.code == 2 and "--mapping names the topics" in capsys.readouterr().err


def test_a_mapping_that_is_not_there_is_a_sentence_and_no_bag(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([str(tmp_path / "bag"), "--mapping", str(tmp_path / "none.yaml")]) == 1
    assert capsys.readouterr().err.startswith("There is no mapping") and list(tmp_path.iterdir()) == []


def test_an_empty_mapping_is_none_and_does_not_record_for_ever(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([str(tmp_path / "bag"), "--mapping", ""]) == 1
    assert capsys.readouterr().err.startswith("There is no mapping") and list(tmp_path.iterdir()) == []
