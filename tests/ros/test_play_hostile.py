"""`play` with bags that somebody made to do harm: nothing of them is run, and no motor is left under a voltage."""

import subprocess
from pathlib import Path

import pytest
from bags_over_dds import Start
from rclpy.serialization import serialize_message
from std_msgs.msg import Float64
from workbench import ENVIRONMENT, PATIENCE, Bench, program

from motor_identification.bag import BagWriter
from motor_identification.live.qos_profiles import offered
from motor_msgs.msg import MotorVoltage
from motor_ros import qos

RUN = "open('run', 'w').close()"  # what the attacker wants


def test_a_type_name_runs_nothing_of_the_working_directory(tmp_path: Path) -> None:
    """A topic of type venv/__main__/X made an environment here and ran the bag's own ensurepip."""
    for package in ("ensurepip", "evil", "evil/msg"):
        (tmp_path / package).mkdir()
        for module in ("__init__", "__main__"):
            (tmp_path / package / f"{module}.py").write_text(RUN)
    with BagWriter(tmp_path / "bag") as writer:
        types = ("venv/__main__/X", "evil/msg/X", "std_srvs/srv/SetBool")
        for number, name in enumerate((*(f"/t{k}" for k in range(3)), "/\x1b[2J")):
            channel = writer.topic(name, [*types, "std_msgs/msg/Float64"][number])
            writer.write(channel, 10**18, serialize_message(Float64()))
    before = {path for path in tmp_path.rglob("*") if path.suffix != ".pyc"}
    command = [program("motor_identification", "play"), "bag"]
    environment = ENVIRONMENT | {"PYTHONPATH": f"{ENVIRONMENT.get('PYTHONPATH', '')}:"}  # the working directory too
    done = subprocess.run(
        command, cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=PATIENCE, check=False
    )
    assert done.returncode == 1 and done.stdout == ""
    assert {path for path in tmp_path.rglob("*") if path.suffix != ".pyc"} == before
    said = done.stderr.splitlines()
    assert [line.split(" is not played: ")[0] for line in said[:-1]] == ["/t0", "/t1", "/t2", r"/\x1b[2J"]
    assert said[-1].startswith("bag has no topic that can be played here: install the packages")


@pytest.mark.parametrize("garbled", [b"", b"\x00\x01\x00\x00" + b"\xff" * 40])
def test_a_garbled_last_voltage_is_not_sent_and_0_v_is(
    garbled: bytes, bench: Bench, start: Start, tmp_path: Path
) -> None:
    with BagWriter(tmp_path / "bag") as writer:
        channel = writer.topic("/motor/voltage", "motor_msgs/msg/MotorVoltage", offered(qos.VOLTAGE))
        writer.write(channel, 10**18, serialize_message(MotorVoltage(voltage=5.0)))
        writer.write(channel, 10**18 + 10**8, garbled)
    voltages = bench.hear(MotorVoltage, "motor/voltage", qos.COMMANDS)
    play = start("motor_identification", "play", tmp_path / "bag")
    bench.wait(lambda: len(voltages) >= 2, "two voltages")
    out, err = play.communicate(timeout=PATIENCE)
    assert [message.voltage for message in voltages] == [5.0, 0.0]
    assert play.returncode == 0 and "1 message is not of its type and was not played." in err
    assert "Traceback" not in err


def test_a_log_time_at_the_end_of_time_is_refused_and_0_v_is_left(bench: Bench, start: Start, tmp_path: Path) -> None:
    with BagWriter(tmp_path / "bag") as writer:
        channel = writer.topic("/motor/voltage", "motor_msgs/msg/MotorVoltage", offered(qos.VOLTAGE))
        for time in (10**18, 2**64 - 1):
            writer.write(channel, time, serialize_message(MotorVoltage(voltage=5.0)))
    voltages = bench.hear(MotorVoltage, "motor/voltage", qos.COMMANDS)
    play = start("motor_identification", "play", tmp_path / "bag")
    bench.wait(lambda: len(voltages) >= 2, "two voltages")
    _, err = play.communicate(timeout=PATIENCE)
    assert [message.voltage for message in voltages] == [5.0, 0.0]
    assert play.returncode == 1 and "days later, so its log time is damaged" in err and err.count("\n") == 1
