"""The recordings in bags/: what is found in them is the motor that made them, as closely as ever, and no closer."""

import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from motor_identification.bag import Source, contents, read_recording
from motor_identification.identify import Request
from motor_identification.service.job import DiagnosisJob, Job, run_diagnosis, run_job
from motor_model.model_file import load

BAGS = Path(__file__).resolve().parents[1] / "bags"
# bag: the model file of its motor, and the share of a parameter by which the fit may be off
TRUTH = {
    "step": ("paper", {"kv": 1e-6, "ka": 1e-5}),
    "rich": ("rich", {"kv": 1e-6, "ka": 2e-6, "ks": 2e-6, "breakaway_voltage": 2e-5, "stribeck_speed": 2e-4}),
    "emulated": ("emulated", {"kv": 2e-5, "ka": 2e-5, "ks": 4e-4, "delay": 4e-4}),
    "closed_loop": ("closed_loop", {"kv": 1e-5, "ka": 2e-5, "ks": 4e-5}),
}
# bag: samples, source and timer tick [s], and seconds
SHAPE = {
    "step": (220, "simulation", 4e-6, 1.095),
    "rich": (5690, "simulation", 4e-6, 28.445),
    "emulated": (831, "hardware", 5e-7, 4.15),
    "closed_loop": (1983, "simulation", 4e-6, 9.91),
}


def test_they_are_small_and_named() -> None:
    files = [path for path in BAGS.rglob("*") if path.is_file()]
    assert 400_000 < sum(path.stat().st_size for path in files) < 2_000_000
    assert {path.name for path in BAGS.iterdir() if path.is_dir()} == set(TRUTH)
    page = (BAGS / "README.md").read_text(encoding="utf-8")
    for bag, (model, _) in TRUTH.items():
        assert f"`{bag}`" in page and f"`{model}.yaml`" in page


@pytest.mark.parametrize("bag", TRUTH)
def test_what_is_in_it(bag: str) -> None:
    samples, source, tick, seconds = SHAPE[bag]
    recording = read_recording(BAGS / bag)
    assert len(recording.sample_time) == samples and recording.notes == ()
    assert (recording.info.source, recording.info.edge_resolution) == (source, tick)
    assert recording.info.max_voltage == load(BAGS / f"{TRUTH[bag][0]}.yaml").max_voltage
    duration = (recording.sample_time[-1] - recording.sample_time[0]) * 1e-9
    assert duration == pytest.approx(seconds, abs=0.01) and not contents(BAGS / bag).cut


@pytest.mark.parametrize("bag", TRUTH)
def test_the_motor_that_made_it_is_found(bag: str) -> None:
    model, shares = TRUTH[bag]
    truth = load(BAGS / f"{model}.yaml")
    fit = run_job(Job(Source((str(BAGS / bag),)), Request(effects=truth.effects)))
    assert set(fit.parameters.values) == set(shares) and not fit.not_identifiable and not any(fit.on_bound.values())
    for name, share in shares.items():
        value, sigma = fit.parameters.values[name], fit.standard_errors[name]
        assert value == pytest.approx(truth.values[name], rel=share), name
        assert 1e-9 < sigma / truth.values[name] < share, name  # no fit is surer than its data, nor much less sure
        assert abs(value - truth.values[name]) < 5.0 * sigma, name
    assert 0.8 < fit.residual_rms / fit.noise_floor < 1.2
    assert 0.998 < fit.r_squared < 1.0


@pytest.mark.slow
def test_the_command_that_made_it_makes_it_again(tmp_path: Path) -> None:
    done = subprocess.run([BAGS / "make.sh", tmp_path, "step"], capture_output=True, text=True, timeout=120.0)
    assert done.returncode == 0, done.stderr
    golden, again = read_recording(BAGS / "step"), read_recording(tmp_path / "step")
    known = replace(golden.info, gear_ratio=again.info.gear_ratio)  # older than the field: no gear is a gear of 1
    assert golden.info.gear == again.info.gear and known == again.info
    assert np.array_equal(golden.voltage, again.voltage)
    assert (
        np.max(np.abs(golden.edge_time - again.edge_time)) <= 4000
    )  # [ns] a tick: another machine may round otherwise


def test_friction_is_missing_in_the_closed_loop_and_nothing_else() -> None:
    found = run_diagnosis(DiagnosisJob(Source((str(BAGS / "closed_loop"),))))
    assert [finding.effect for finding in found.findings] == ["coulomb_friction"]
    assert found.after.seen and not found.after.confirms  # it goes to one level of the voltage, and back
    assert 65.0 < found.gap_before / found.noise_floor < 95.0
    assert 0.7 < found.gap_after / found.noise_floor < 1.2
