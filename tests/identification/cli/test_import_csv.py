"""`import_csv` as a command: a bag from a log, or a sentence, exit status 1 and no bag."""

from pathlib import Path

import numpy as np
import pytest
from rclpy.serialization import deserialize_message

from motor_identification.bag import messages, read_recording, topics
from motor_identification.cli.import_csv import main
from motor_model.sample import Measurement
from motor_msgs.msg import MotorSpeed, MotorVoltage

COLUMNS = ["--time", "t", "--voltage", "u"]
SPEED = ["--speed", "y", "--unit", "rad/s"]


@pytest.fixture
def log(tmp_path: Path) -> Path:
    path = tmp_path / "log.csv"
    path.write_text("t,u,y,s\n" + "".join(f"{0.02 * k:.2f},{1 + k % 2},{10 * k},{k // 5}\n" for k in range(20)))
    return path


def test_a_bag_that_identification_reads(log: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    bag = tmp_path / "bag"
    assert main([str(log), "--output", str(bag), *COLUMNS, "--speed", "y", "--unit", "deg/s", "--name", "wheel"]) == 0
    recording = read_recording(bag)
    assert recording.info.measurement is Measurement.SPEED and recording.info.name == "wheel"
    assert np.array_equal(recording.sample_time, np.arange(20) * 20_000_000)
    assert recording.speed == pytest.approx(np.radians(10.0 * np.arange(20)))
    assert np.array_equal(recording.voltage, 1.0 + np.arange(20) % 2) and recording.info.voltage_assumed
    info, speed, voltage = topics(bag)
    assert [topic.message_count for topic in (info, speed, voltage)] == [1, 20, 20]
    assert [profile.durability for profile in info.qos] == ["transient_local"]
    stored = list(messages(bag))
    assert stored[0][0] == "/motor/info"
    for name, kind in (("/motor/speed", MotorSpeed), ("/motor/voltage", MotorVoltage)):
        for k, (_, _, log_time, data) in enumerate(row for row in stored if row[0] == name):
            message = deserialize_message(data, kind)
            assert message.header.frame_id == "wheel" and message.voltage == 1.0 + k % 2
            assert message.header.stamp.sec * 10**9 + message.header.stamp.nanosec == log_time
            assert log_time == log.stat().st_mtime_ns + k * 20_000_000  # the log does not say when it was made
    out, err = capsys.readouterr()
    assert err == "" and "20 rows, 0.38 s" in out and f"{bag}: 20 samples, 0.38 s" in out and out.count("\n") == 12


def test_times_since_1970_are_ros_times(tmp_path: Path) -> None:
    (tmp_path / "log.csv").write_text("t,u,y\n1760000000.5,1,1\n1760000001.5,1,2\n")
    assert main([str(tmp_path / "log.csv"), "--output", str(tmp_path / "bag"), *COLUMNS, *SPEED]) == 0
    assert {row[2] for row in messages(tmp_path / "bag")} == {1760000000500000000, 1760000001500000000}


def test_split_makes_a_bag_of_every_run(log: Path, tmp_path: Path) -> None:
    prefix = str(tmp_path / "run")
    arguments = [*COLUMNS, "--count", "y", "--edges-per-revolution", "360", "--split", "s"]
    assert main([str(log), "--output", prefix, *arguments]) == 0
    assert sorted(path.name for path in tmp_path.glob("run*")) == ["run_0", "run_1", "run_2", "run_3"]
    third = read_recording(f"{prefix}_2")
    assert np.array_equal(third.edge_count, 10 * np.arange(10, 15))
    assert third.info.measurement is Measurement.COUNTS and third.info.edges_per_revolution == 360


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        (("0.10,", "0.09,"), None),  # still forward: no complaint
        (("0.10,", "0.07,"), "line 7: time runs backwards"),
        (("0.10,", "0.08,"), None),  # two rows that share a stamp get a time each
        (("0.10,2", "0.10,volts"), "line 7, column u: 'volts' is not a number"),
        (("t,u,y,s", "t,v,y,s"), "has no column u: name one of t, v, y, s"),
    ],
)
def test_a_bad_log_is_a_sentence_and_no_bag(
    log: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], change: tuple[str, str], complaint: str | None
) -> None:
    log.write_text(log.read_text().replace(*change))
    status = main([str(log), "--output", str(tmp_path / "bag"), *COLUMNS, *SPEED])
    out, err = capsys.readouterr()
    assert (status, (tmp_path / "bag").exists()) == ((0, True) if complaint is None else (1, False))
    assert complaint is None or (complaint in err and err.count("\n") == 1 and out == "")


def test_existing_output_is_left_alone_and_no_other_run_written(
    log: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "run_2").mkdir()
    assert main([str(log), "--output", str(tmp_path / "run"), *COLUMNS, *SPEED, "--split", "s"]) == 1
    assert "run_2 exists already and is left as it is" in capsys.readouterr().err
    assert [path.name for path in tmp_path.glob("run*")] == ["run_2"]
    assert list((tmp_path / "run_2").iterdir()) == []


def test_no_such_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([str(tmp_path / "none"), "--output", str(tmp_path / "bag"), *COLUMNS, *SPEED]) == 1
    assert "There is no file" in capsys.readouterr().err


@pytest.mark.parametrize(
    "arguments",
    [
        ["--speed", "y", "--unit", "deg"],
        ["--position", "y", "--unit", "rpm"],
        ["--position", "y", "--speed-window", "0.02"],
        ["--speed", "y", "--position", "y"],
        ["--speed", "y", "--speed-window", "-1"],
        ["--speed", "y", "--edges-per-revolution", "0"],
        ["--speed", "y", "--voltage-scale", "0"],
        ["--count", "y"],
    ],
)
def test_what_does_not_go_together_is_a_usage_error(log: Path, tmp_path: Path, arguments: list[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        main([str(log), "--output", str(tmp_path / "bag"), *COLUMNS, *arguments])
    assert caught.value.code == 2 and not (tmp_path / "bag").exists()
