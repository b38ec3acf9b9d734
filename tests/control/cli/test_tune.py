"""`tune` as its user meets it: what it prints and writes, and one sentence for everything that is wrong."""

import shlex
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from motor_control.cli.tune import main
from motor_control.configuration import config_of
from motor_control.parameters import ROWS
from motor_model.model_file import load, save
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters, paper_motor
from motor_model.sample import Info

RUBBING = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.4, "breakaway_voltage": 0.9, "stribeck_speed": 4.0}


@pytest.fixture
def model(tmp_path: Path) -> Path:
    path = tmp_path / "model.yaml"
    save(path, Parameters(RUBBING, ("static_friction",), name="bench"))
    return path


def written(path: Path) -> dict[str, object]:
    content = yaml.safe_load(path.read_text(encoding="utf-8"))
    assert list(content) == ["/**/motor_control"]
    values: dict[str, object] = content["/**/motor_control"]["ros__parameters"]
    return values


def table(printed: str) -> dict[str, float]:
    """The first table's numbers."""
    rows = (line.rsplit("  ", 1) for line in printed.split("\n\n")[0].splitlines())
    return {row[0].strip().rsplit("  ", 1)[0].strip(): float(row[0].split()[-1]) for row in rows}


@pytest.mark.slow
def test_the_gains_are_written_although_nobody_reads_the_table(model: Path, tmp_path: Path) -> None:
    """`tune … --output gains.yaml | head -1` wrote no file, unbuffered, and ended with 0."""
    gains = tmp_path / "gains.yaml"
    command = [sys.executable, "-u", "-m", "motor_control.cli.tune", str(model), "--output", str(gains)]
    line = f"{shlex.join(command)} | true; exit ${{PIPESTATUS[0]}}"
    done = subprocess.run(["bash", "-c", line], capture_output=True, text=True, timeout=120.0)
    assert done.returncode == 0 and done.stderr == ""
    assert written(gains)["speed_source"] == "measured"


def test_prints_and_writes(model: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    gains, figure = tmp_path / "gains.yaml", tmp_path / "step.png"
    assert main([str(model), "--output", str(gains), "--figure", str(figure)]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    values = written(gains)
    assert values == {
        "kp": pytest.approx(0.1334, rel=0.01),
        "ki": pytest.approx(1.672, rel=0.01),
        "speed_source": "measured",
    }
    shown = table(out)
    assert shown["kp"] == pytest.approx(values["kp"], rel=1e-3)
    assert 32.0 < shown["closed-loop time constant"] < 34.0
    assert 12.5 < shown["gain margin"] < 14.0 and 69.0 < shown["phase margin"] < 73.0
    assert 48.0 < shown["delay margin"] < 52.0
    assert shown["overshoot, small step"] == 0.0
    assert "encoder delay at 10.4 rad/s  22.4 ms" in out and "2 % ripple from the disc     33.1 ms" in out
    assert "The model has 0.9 V of friction, which these gains do not compensate." in out
    text = gains.read_text(encoding="utf-8")
    assert "time constant 33.1 ms, limited by 2 % ripple from the disc" in text
    assert "Gain margin 13.4 dB, phase margin 71 deg, delay margin 50 ms" in text
    assert figure.stat().st_size > 30_000 and figure.read_bytes()[:4] == b"\x89PNG"


def test_the_observers_file_sets_up_the_controller(
    model: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    gains, figure = tmp_path / "gains.yaml", tmp_path / "step.png"
    options = ["--speed-source", "observer", "--slot-irregularity", "0.02", "--output", str(gains)]
    assert main([str(model), *options, "--figure", str(figure)]) == 0
    assert "assume that the model is exact" in capsys.readouterr().out
    values = written(gains)
    assert (values["speed_source"], values["feedforward"], values["model"]) == ("observer", True, str(model))
    names = {row.name: type(row.default) for row in ROWS}
    assert all(isinstance(value, names[name]) for name, value in values.items())  # a double must have its point
    defaults = {row.name: row.default for row in ROWS}
    config = config_of({**defaults, **values}, Info(), load(model))  # type: ignore[dict-item]
    assert config.observer is not None and config.feedforward is not None and config.note == ""
    assert config.observer.slot_irregularity == 0.02
    assert config.gains.kp == pytest.approx(0.24, abs=0.03)
    assert figure.stat().st_size > 30_000


def test_a_node_takes_the_file_in_any_namespace(model: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import rclpy
    from rclpy.node import Node

    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    gains = tmp_path / "gains.yaml"
    assert main([str(model), "--time-constant", "0.05", "--output", str(gains)]) == 0
    for namespace in ("/", "/left", "/a/b"):
        context = rclpy.Context()
        context.init(["--ros-args", "--params-file", str(gains), "-r", f"__ns:={namespace}"])
        node = Node("motor_control", context=context)
        try:
            for row in ROWS:
                node.declare_parameter(row.name, row.default)
            assert node.get_parameter("kp").value == written(gains)["kp"] < 0.12
            assert node.get_parameter("ki").value == written(gains)["ki"]
        finally:
            node.destroy_node()
            context.shutdown()


def test_options_reach_the_loop(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "paper.yaml"
    save(path, paper_motor())

    def kp(*options: str) -> float:
        assert main([str(path), *options]) == 0
        return table(capsys.readouterr().out)["kp"]

    usual = kp()
    assert 2.0 < kp("--sample-rate", "1000") / usual < 3.0
    assert 0.3 < kp("--edges-per-revolution", "24") / usual < 0.8
    assert 0.6 < kp("--lowest-speed", "3") / usual < 0.8
    assert 0.2 < kp("--slot-irregularity", "0.02") / usual < 0.4
    assert 1.2 < kp("--oscillation", "0.04") / usual < 1.7
    assert main([str(path), "--time-constant", "0.025"]) == 0
    assert "causes 2.37 % speed ripple. A time constant of 33.1 ms keeps it at 2 %" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("content", "options", "words"),
    [
        ("parameters: {ka: {value: 0.0055}}", [], "the model lacks kv; give each a value."),
        ("parameters: {kv: {value: 0.07}, ka: {value: 0.0}}", [], "kv and ka must be positive"),
        ("[]", [], "a model file has 'effects' and 'parameters'"),
        (None, [], "cannot read the model file"),
        ("", ["--time-constant", "0.005"], "ask for 22.4 ms or more, sample faster"),
        ("", ["--output", "nowhere/gains.yaml"], "cannot write nowhere/gains.yaml: name a file in a directory"),
        ("", ["--figure", "nowhere/step.png"], "cannot write nowhere/step.png: name a file in a directory"),
        ("", ["--figure", "step.txt"], "its name must end in .png"),
        ("", ["--edges-per-revolution", "0"], "edges_per_revolution = 0 does not work"),
    ],
)
def test_one_sentence_for_what_is_wrong(
    content: str | None, options: list[str], words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "model.yaml"
    if content is not None:
        path.write_text(content or "parameters: {kv: {value: 0.06893}, ka: {value: 0.0055}}", encoding="utf-8")
    assert main([str(path), *options]) == 1
    _, err = capsys.readouterr()
    assert words in err and err.count("\n") == 1 and err.endswith(".\n")


@pytest.mark.parametrize(
    "options", [["--time-constant", "0"], ["--sample-rate", "nan"], ["--speed-source", "guess"], []]
)
def test_usage(options: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stop:
        main(["model.yaml", *options] if options else [])
    assert stop.value.code == 2
    assert "usage: ros2 run motor_control tune [options] MODEL\n" in capsys.readouterr().err
