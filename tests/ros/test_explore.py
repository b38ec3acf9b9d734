"""`explore` on a live plant: it drives, diagnoses, drives what was suggested, and leaves the motor at 0 V."""

import json
import signal
from collections.abc import Callable
from pathlib import Path
from subprocess import Popen

import pytest
import workbench
from workbench import PATIENCE, Bench

from motor_identification.bag import read_recording
from motor_identification.cli import experiment
from motor_identification.cli import explore as cli
from motor_model.model_file import load, save
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_msgs.msg import MotorSpeed, MotorVoltage
from motor_ros import qos
from motor_ros.run import Interrupt

Start = Callable[..., "Popen[str]"]
KS = 0.4


@pytest.fixture
def samples(bench: Bench, start: Start, tmp_path: Path) -> list[MotorSpeed]:
    """What a plant with friction reports."""
    save(tmp_path / "true.yaml", Parameters({"kv": PAPER_KV, "ka": PAPER_KA, "ks": KS}, ("coulomb_friction",)))
    start("motor_sim", "motor_sim", "--ros-args", "-p", f"model:={tmp_path / 'true.yaml'}")
    samples = bench.hear(MotorSpeed, "motor/speed", qos.SPEED)
    bench.wait(lambda: bool(samples), "a sample")
    return samples


def explore(*arguments: object) -> "Popen[str]":
    return workbench.start("motor_identification", "explore", *arguments)


def assert_at_rest(bench: Bench, samples: list[MotorSpeed]) -> None:
    del samples[:]
    bench.wait(lambda: bool(samples) and samples[-1].voltage == 0.0 and samples[-1].speed == 0.0, "a motor at rest")


def test_a_terminal_that_is_closed_after_an_experiment_ends_the_exploration(monkeypatch: pytest.MonkeyPatch) -> None:
    """The signal fell on deaf ears during the diagnosis, and the next experiment drove the motor with nobody there."""

    def listen(arguments: list[str]) -> int:
        Interrupt()
        return 0

    monkeypatch.setattr(experiment, "main", listen)
    numbers = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
    before = {number: signal.getsignal(number) for number in numbers}
    try:
        assert cli._recorded("step", "bag", cli.parser().parse_args(["directory"])) == 0
        assert {number: signal.getsignal(number) for number in numbers} == before
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


@pytest.mark.slow
@pytest.mark.long
def test_names_what_is_missing_after_the_experiments_it_asks_for(
    bench: Bench, samples: list[MotorSpeed], tmp_path: Path
) -> None:
    process = explore(tmp_path / "found", "--profile", "step", "--voltage", "10")
    try:
        bench.wait(lambda: process.poll() is not None, "the end of the exploration", 90.0)
    finally:
        process.kill()
    out, err = process.communicate()
    assert process.returncode == 0, err
    content = json.loads((tmp_path / "found" / "diagnosis.json").read_text())
    assert len(content["bags"]) >= 2 and all(Path(bag).is_dir() for bag in content["bags"])
    assert [finding["effect"] for finding in content["findings"]] == ["coulomb_friction"]
    assert load(tmp_path / "found" / "model.yaml").value("ks") == pytest.approx(KS, rel=1e-3)
    assert "Round 2: " in out and f"report: {tmp_path / 'found' / 'report.html'}" in out
    assert_at_rest(bench, samples)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_leaves_the_motor_at_rest_when_it_is_interrupted(
    bench: Bench, samples: list[MotorSpeed], tmp_path: Path, number: signal.Signals
) -> None:
    voltages = bench.hear(MotorVoltage, "motor/voltage", qos.VOLTAGE)
    process = explore(tmp_path / "found", "--profile", "staircase")
    try:
        bench.wait(lambda: bool(voltages) and samples[-1].edge_count > 20, "a motor that turns", PATIENCE)
        process.send_signal(number)
        bench.wait(lambda: process.poll() is not None, "the end of the exploration")
    finally:
        process.kill()
    _out, err = process.communicate()
    assert process.returncode == 130 and "Traceback" not in err
    assert_at_rest(bench, samples)
    assert voltages[-1].voltage == 0.0
    recording = read_recording(tmp_path / "found" / "1_staircase_incomplete")  # what there was is not lost
    assert recording.voltage.max() > 1.0 and recording.duration < 5.8


def test_a_wrong_effect_is_refused_before_the_motor_moves(
    bench: Bench, samples: list[MotorSpeed], tmp_path: Path
) -> None:
    process = explore(tmp_path / "found", "--known-effects", "nope")
    out, err = process.communicate(timeout=PATIENCE)
    assert (process.returncode, out) == (1, "") and err.startswith("'nope' is not an effect; the effects are ")
    assert not (tmp_path / "found").exists() and samples[-1].edge_count == 0
