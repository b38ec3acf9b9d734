"""What BagWriter makes is what `ros2 bag`, PlotJuggler and Foxglove expect, checked through readers of others."""

import json
from pathlib import Path

import pytest
import yaml
from ament_index_python.packages import get_package_share_directory
from mcap.reader import make_reader
from motor_bags import PERIOD, SAMPLES, START, write_bag
from rosbags.highlevel import AnyReader
from rosbags.interfaces import QosDurability, QosReliability
from rosbags.rosbag2 import Reader

from motor_identification.bag import BagWriter, Qos, contents, messages, read_recording, topics

SPEED = "motor_msgs/msg/MotorSpeed"


def test_rosbags_reads_it_and_decodes_with_the_embedded_definitions(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", SAMPLES)
    with AnyReader([bag]) as reader:  # takes its types from the bag
        assert reader.duration == 1999 * PERIOD + 1 and reader.message_count == 2001
        seen = [
            (time, reader.deserialize(data, connection.msgtype))
            for connection, time, data in reader.messages()
            if connection.topic == "/motor/speed"
        ]
    assert [time for time, _ in seen] == [START + k * PERIOD for k in range(2000)]
    assert [message.speed for _, message in seen] == [sample.speed for sample in SAMPLES]
    assert {message.header.frame_id for _, message in seen} == {"wheel"}


def test_rosbags_finds_the_offered_qos_in_file_and_metadata(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", SAMPLES[:10])
    for path in (bag, next(bag.glob("*.mcap"))):
        with Reader(path) as reader:
            info, speed = (connection.ext.offered_qos_profiles for connection in reader.connections)
            assert [(qos.durability, qos.depth) for qos in info] == [(QosDurability.TRANSIENT_LOCAL, 1)]
            assert [(qos.durability, qos.depth) for qos in speed] == [(QosDurability.VOLATILE, 100)]
            assert {qos.reliability for qos in (*info, *speed)} == {QosReliability.RELIABLE}
            assert len(list(reader.messages())) == 11
    assert topics(bag)[0].qos == (Qos(durability="transient_local", depth=1),)


def test_metadata_is_that_of_jazzy(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", SAMPLES[:100])
    text = (bag / "metadata.yaml").read_text()
    assert "&id" not in text  # no YAML anchors
    information = yaml.safe_load(text)["rosbag2_bagfile_information"]
    assert information["version"] == 9 and information["storage_identifier"] == "mcap"
    assert information["relative_file_paths"] == ["bag_0.mcap"] == [file.name for file in bag.glob("*.mcap")]
    assert information["starting_time"]["nanoseconds_since_epoch"] == START
    assert information["duration"]["nanoseconds"] == 99 * PERIOD
    assert information["message_count"] == information["files"][0]["message_count"] == 101
    rows = information["topics_with_message_count"]
    assert [row["message_count"] for row in rows] == [1, 100]
    described = json.loads((Path(get_package_share_directory("motor_msgs")) / "msg/MotorSpeed.json").read_text())
    hashes = {row["type_name"]: row["hash_string"] for row in described["type_hashes"]}
    assert rows[1]["topic_metadata"]["type_description_hash"] == hashes[SPEED]
    profile = rows[1]["topic_metadata"]["offered_qos_profiles"][0]
    assert profile["deadline"] == {"sec": 9223372036, "nsec": 854775807}
    assert (profile["history"], profile["depth"], profile["reliability"]) == ("keep_last", 100, "reliable")


def test_the_mcap_carries_schemas_profile_and_the_same_metadata(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", SAMPLES)
    with next(bag.glob("*.mcap")).open("rb") as stream:
        reader = make_reader(stream, validate_crcs=True)
        assert reader.get_header().profile == "ros2"
        summary = reader.get_summary()
        assert summary is not None and summary.statistics is not None
        assert summary.statistics.message_count == 2001 == sum(1 for _ in reader.iter_messages())
        assert {chunk.compression for chunk in summary.chunk_indexes} == {"zstd"}
        schema = next(schema for schema in summary.schemas.values() if schema.name == SPEED)
        assert schema.encoding == "ros2msg"
        parts = schema.data.decode().split("=" * 80 + "\n")
        assert [part.split("\n")[0] for part in parts[1:]] == ["MSG: std_msgs/Header", "MSG: builtin_interfaces/Time"]
        assert "float64 speed" in parts[0] and "string frame_id" in parts[1] and "uint32 nanosec" in parts[2]
        (record,) = reader.iter_metadata()
        embedded = yaml.safe_load(record.metadata["serialized_metadata"])
    assert embedded == yaml.safe_load((bag / "metadata.yaml").read_text())["rosbag2_bagfile_information"]


def test_deeply_nested_definitions_are_complete(tmp_path: Path) -> None:
    with BagWriter(tmp_path / "bag") as writer:
        writer.write(writer.topic("/path", "nav_msgs/msg/Path"), 5, b"\x00\x01\x00\x00")
        writer.write(writer.topic("/joints", "sensor_msgs/msg/JointState"), 6, b"\x00\x01\x00\x00")
        writer.write(writer.topic("/odd", "nowhere_msgs/msg/Odd"), 7, b"\x00\x01\x00\x00")
    path, joints, odd = topics(tmp_path / "bag")
    names = ["geometry_msgs/PoseStamped", "geometry_msgs/Pose", "geometry_msgs/Point", "geometry_msgs/Quaternion"]
    assert all(path.definition.count(f"MSG: {name}\n") == 1 for name in [*names, "std_msgs/Header"])
    assert joints.definition.count("MSG: ") == 2
    assert odd.definition == "" and odd.type_name == "nowhere_msgs/msg/Odd"
    with AnyReader([tmp_path / "bag"]) as reader:
        assert [connection.msgcount for connection in reader.connections] == [1, 1, 1]


def test_a_bag_that_is_set_aside_frees_its_name(tmp_path: Path) -> None:
    for name in ("bag_incomplete", "bag_incomplete_2"):
        writer = BagWriter(tmp_path / "bag")
        writer.write(writer.topic("/x", "std_msgs/msg/Float64"), 1, b"1234")
        assert writer.set_aside() == tmp_path / name
        assert contents(tmp_path / name).message_count == 1
    assert BagWriter(tmp_path / "bag").set_aside() is None  # empty: nothing worth keeping
    assert sorted(path.name for path in tmp_path.iterdir()) == ["bag_incomplete", "bag_incomplete_2"]


def test_an_error_inside_leaves_a_readable_bag(tmp_path: Path) -> None:
    data = next(row[3] for row in messages(write_bag(tmp_path / "source", SAMPLES[:1])) if row[0] == "/motor/speed")
    with pytest.raises(KeyError), BagWriter(tmp_path / "bag") as writer:
        channel = writer.topic("/motor/speed", SPEED)
        assert writer.topic("/motor/speed", SPEED) == channel
        writer.write(channel, 5, data)
        raise KeyError("something else went wrong")
    assert [row[:3] for row in messages(tmp_path / "bag")] == [("/motor/speed", SPEED, 5)]
    assert (tmp_path / "bag/metadata.yaml").is_file()


def test_discard_leaves_nothing(tmp_path: Path) -> None:
    with BagWriter(tmp_path / "deep/bag") as writer:
        writer.write(writer.topic("/motor/speed", SPEED), 5, b"")
        writer.discard()
    assert not (tmp_path / "deep/bag").exists()


def test_times_and_counts(tmp_path: Path) -> None:
    with BagWriter(tmp_path / "bag") as writer:
        channel = writer.topic("/motor/speed", SPEED)
        for time in (2_000_000_000, 500_000_000, 1_000_000_000):
            writer.write(channel, time, b"\x00\x01\x00\x00", publish_time=time - 7)
        assert (writer.message_count, writer.duration) == (3, 1.5)
        assert writer.counts == {"/motor/speed": 3}
    with next((tmp_path / "bag").glob("*.mcap")).open("rb") as stream:
        stored = [(message.log_time, message.publish_time) for _, _, message in make_reader(stream).iter_messages()]
    assert stored == [(time, time - 7) for time in (500_000_000, 1_000_000_000, 2_000_000_000)]


def test_read_recording_takes_strings_and_paths(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", SAMPLES[:10])
    assert read_recording(str(bag)).uri == read_recording(bag).uri == str(bag)
