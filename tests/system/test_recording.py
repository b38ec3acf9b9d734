"""A recorder that is killed, and one that records two motors: what is in the bag, counted from both sides."""

import json
import signal
from collections.abc import Callable
from pathlib import Path
from subprocess import Popen

import numpy as np
import pytest
from plant_user import User
from std_msgs.msg import Float64
from workbench import PATIENCE, Bench, end

from motor_identification.bag import contents, messages, read_recording
from motor_identification.identify import Request, identify
from motor_model.model_file import save
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_msgs.msg import MotorSpeed
from motor_ros import qos

Start = Callable[..., "Popen[str]"]


def identified(start: Start, bag: Path, *arguments: str) -> tuple[dict[str, float], str]:
    """What `identify` finds for kv and ka, and what it printed."""
    fit = bag.parent / "fit.json"
    process = start("motor_identification", "identify", bag, "--json", fit, *arguments)
    out, err = process.communicate(timeout=120.0)
    assert process.returncode == 0, err
    parameters = json.loads(fit.read_text(encoding="utf-8"))["model"]["parameters"]
    return {name: parameters[name]["value"] for name in ("kv", "ka")}, out + err


def test_a_killed_recorder_loses_at_most_a_second(bench: Bench, start: Start, tmp_path: Path) -> None:
    start("motor_sim", "motor_sim")
    user = User(bench)
    record = start("motor_identification", "record", tmp_path / "bag")
    written = (tmp_path / "bag").glob  # its folder is there a moment before its file
    bench.wait(lambda: any(written("*.mcap")) and contents(tmp_path / "bag").message_count > 0, "the first flush")
    bench.wait(lambda: bench.node.count_subscribers("motor/voltage") == 2, "plant and recorder")
    user.voltage = 6.0
    user.until(lambda sample: sample.speed > 80.0, "motion")
    user.voltage = 3.0
    user.more(300)
    record.send_signal(signal.SIGKILL)
    record.wait(timeout=PATIENCE)
    heard = [sample.sample_time for sample in user.samples]
    recording = read_recording(tmp_path / "bag")
    assert set(np.diff(recording.sample_time)) == {5_000_000}  # nothing is missing in between
    assert heard[0] - 10**10 < recording.sample_time[0] < heard[-1]
    lost = (heard[-1] - int(recording.sample_time[-1])) // 5_000_000
    assert -20 < lost <= 200  # of 1.5 s and more; below 0 where the recorder had heard more than this process
    both = np.intersect1d(recording.sample_time, heard)
    assert len(both) == sum(recording.sample_time[0] <= time <= recording.sample_time[-1] for time in heard) > 200
    found, said = identified(start, tmp_path / "bag")
    assert found["kv"] == pytest.approx(PAPER_KV, rel=1e-3) and found["ka"] == pytest.approx(PAPER_KA, rel=1e-2)
    assert f"is cut off: {len(recording)} samples, {recording.duration:.2f} s up to the cut." in said
    assert {row[0] for row in messages(tmp_path / "bag")} >= {"/motor/speed", "/motor/info", "/motor/voltage"}


MOTORS = {"left": {"kv": 0.07, "ka": 0.005}, "right": {"kv": 0.11, "ka": 0.012}}


@pytest.mark.slow
def test_two_controlled_motors_in_one_bag_do_not_meet(bench: Bench, start: Start, tmp_path: Path) -> None:
    for name, parameters in MOTORS.items():
        save(tmp_path / f"{name}.yaml", Parameters(parameters))
        namespace = ("-r", f"__ns:=/{name}")
        model = ("-p", f"model:={tmp_path / name}.yaml", "-p", f"name:={name}_wheel")
        start("motor_sim", "motor_sim", "--ros-args", *namespace, *model)
        start("motor_control", "motor_control", "--ros-args", *namespace)
    references = {name: bench.publisher(Float64, f"/{name}/motor/reference", qos.REFERENCE) for name in MOTORS}
    heard = {name: bench.hear(MotorSpeed, f"/{name}/motor/speed") for name in MOTORS}
    topics = [f"/{name}/motor/{topic}" for name in MOTORS for topic in ("speed", "info", "voltage", "reference")]
    record = start("motor_identification", "record", tmp_path / "bag", *topics)

    def recorded() -> int:
        """Samples that are in the bag, of the motor of which there are fewer."""
        topics = contents(tmp_path / "bag").topics if (tmp_path / "bag").is_dir() else ()
        counts = {topic.name: topic.message_count for topic in topics}
        return min(counts.get(f"/{name}/motor/speed", 0) for name in MOTORS)

    bench.wait(  # a controller and the recorder
        lambda: all(publisher.get_subscription_count() == 2 for publisher in references.values()), "the recorder"
    )
    bench.wait(lambda: recorded() > 0 and all(heard.values()), "samples of both in the bag")
    for left, right in ((60.0, 25.0), (20.0, 50.0)):
        references["left"].publish(Float64(data=left))
        references["right"].publish(Float64(data=right))
        counts = {name: len(samples) for name, samples in heard.items()}
        bench.wait(lambda: all(len(heard[name]) > count + 240 for name, count in counts.items()), "a second")  # noqa: B023
    bench.wait(lambda: recorded() > 480, "what the recorder may have heard late")
    end(record)
    for name, parameters in MOTORS.items():
        recording = read_recording(tmp_path / "bag", name)
        assert recording.notes == () and recording.info.name == f"{name}_wheel"
        assert set(np.diff(recording.sample_time)) == {5_000_000} and len(recording) > 400
        both = {sample.sample_time: sample for sample in heard[name]}
        common = [k for k, time in enumerate(recording.sample_time) if int(time) in both]
        assert len(common) > 400
        for k in common:
            sample = both[int(recording.sample_time[k])]
            assert (sample.edge_count, sample.voltage) == (recording.edge_count[k], recording.voltage[k])
            assert sample.header.frame_id == f"{name}_wheel"
        fit = identify([recording], Request()).parameters
        assert {key: fit.value(key) for key in parameters} == pytest.approx(parameters, rel=3e-3)
    found, _ = identified(start, tmp_path / "bag", "--topic-namespace", "right")
    assert found == pytest.approx(MOTORS["right"], rel=3e-3)
    aims = [row for row in messages(tmp_path / "bag") if row[0].endswith("reference")]
    assert [row[0] for row in aims] == ["/left/motor/reference", "/right/motor/reference"] * 2
