"""`identify` as its user meets it: what it prints and writes, and one sentence for everything that is wrong."""

import json
import shutil
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import yaml
from motor_bags import write_bag
from patience import PATIENCE

from motor_identification.cli.experiment import main as experiment
from motor_identification.cli.identify import announce_effort
from motor_identification.cli.identify import main as identify
from motor_identification.experiment import make_plan, simulate_plan
from motor_model.excitation import profile
from motor_model.model_file import load
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_model.sample import Info, Sample
from motor_model.sensing.board import BoardConfig


@pytest.fixture(scope="module")
def samples() -> list[Sample]:
    """A staircase on a motor with friction."""
    motor = Parameters({"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.5}, ("coulomb_friction",))
    plan = make_plan(profile("staircase"), 10.0, 12.0, 0.005)
    return [sample for _, sample in simulate_plan(plan, motor, BoardConfig())]


@pytest.fixture(scope="module")
def good(samples: list[Sample], tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_bag(tmp_path_factory.mktemp("good") / "bag", samples, info=Info())


def test_prints_the_parameters_and_writes_what_was_asked_for(
    good: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    files = {name: tmp_path / name for name in ("model.yaml", "fit.json", "report")}
    options = ["--output", str(files["model.yaml"]), "--json", str(files["fit.json"]), "--report", str(files["report"])]
    assert identify([str(good), "--effects", "coulomb_friction", *options]) == 0
    out, err = capsys.readouterr()
    rows = {row.split()[0]: row.split() for row in out.splitlines() if row[:2] in ("kv", "ka", "ks")}
    assert float(rows["kv"][1]) == pytest.approx(PAPER_KV, rel=1e-4)
    assert float(rows["ks"][1]) == pytest.approx(0.5, rel=1e-3) and rows["ks"][3] == "V"
    assert 0.0 < float(rows["ks"][2]) < 0.01
    assert err == ""

    content = json.loads(files["fit.json"].read_text())
    assert set(content["model"]["parameters"]) == {"kv", "ka", "ks"}
    assert content["model"]["effects"] == ["coulomb_friction"]
    assert 0.9 < content["residual_rms"] / content["noise_floor"] < 1.1
    assert 0.99999 < content["r_squared"] < 1.0
    assert content["not_identifiable"] == [] and content["suggested_experiment"] is None
    assert 80 < content["evaluations"] < 1_000 and content["duration"] > 0.0
    model = load(files["model.yaml"])
    assert model.value("ks") == pytest.approx(content["model"]["parameters"]["ks"]["value"], rel=1e-12)
    saved = yaml.safe_load(files["model.yaml"].read_text())
    assert saved["parameters"]["ka"]["unit"] == "V·s²/rad" and saved["origin"]["bags"] == [str(good)]
    assert (files["report"] / "fit.png").stat().st_size > 20_000
    page = (files["report"] / "report.html").read_text(encoding="utf-8")
    assert "<h2>Measured and simulated</h2>" in page and f"model:={files['model.yaml']}" in page
    assert f"report: {files['report'] / 'report.html'}" in out


def test_a_long_fit_is_announced_before_it_begins() -> None:
    assert announce_effort(["coulomb_friction", "backlash", "encoder_eccentricity"]) == ""
    said = announce_effort(["backlash", "torque_ripple"])
    assert said.startswith("torque_ripple is looked for in a spectrum")
    assert said.endswith(": this can take minutes. Ctrl-C ends it.\n")


def test_the_same_seed_gives_the_same_answer(good: Path, tmp_path: Path) -> None:
    answers = []
    for name in ("a.json", "b.json"):
        assert identify([str(good), "--json", str(tmp_path / name), "--seed", "7", "--particles", "20"]) == 0
        answers.append(json.loads((tmp_path / name).read_text()))
    assert answers[0]["model"] == answers[1]["model"]


def stopped(samples: list[Sample]) -> list[Sample]:
    return [replace(s, speed=0.0, edge_count=0, edge_time=0, edge_period=0.0) for s in samples]


def without_numbers(samples: list[Sample]) -> list[Sample]:
    return [replace(s, voltage=float("nan")) if 300 <= k < 310 else s for k, s in enumerate(samples)]


def undriven(samples: list[Sample]) -> list[Sample]:
    return [replace(s, voltage=0.0) for s in samples]


def restarted(samples: list[Sample]) -> list[Sample]:
    return samples[300:] + samples[:300]


BAD = {
    "never moves": (stopped, "the motor never moves"),
    "not a number": (without_numbers, "10 voltage values that are not numbers (the first at 1.500 s)"),
    "no voltage": (undriven, "is always 0"),
    "one sample": (lambda samples: samples[:1], "is too short (samples: 1)"),
    "restarted": (restarted, "the plant's clock stands still or steps back"),
}


@pytest.mark.parametrize("case", BAD)
def test_a_recording_that_cannot_answer_is_one_sentence(
    case: str, samples: list[Sample], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    change, words = BAD[case]
    bag = write_bag(tmp_path / "bag", change(samples))
    assert identify([str(bag), "--output", str(tmp_path / "model.yaml")]) == 1
    out, err = capsys.readouterr()
    assert words in err and err.count("\n") == 1 and out == ""
    assert not (tmp_path / "model.yaml").exists()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["{tmp}/nowhere"], "There is no bag"),
        (["{bag}", "--effects", "magic"], "'magic' is not an effect; the effects are coulomb_friction,"),
        (["{bag}", "--effects", ",,"], "--effects ,, names no effect: name some, or leave it out"),
        (["{bag}", "--topic-namespace", "left"], "/left/motor/speed"),
        (["{bag}", "{bag}/../bag"], "is given twice: name every bag once."),
        (["{bag}", "--start", "3", "--stop", "2"], "must be before"),
        (["{bag}", "--start", "40"], "{bag} is 5.85 s long: --start 40 s is after its end."),
        (["{bag}", "--start", "-1"], "are seconds after the first sample"),
        (["{bag}", "--stop", "nan"], "are seconds after the first sample"),
        (["{bag}", "--start", "2", "--stop", "2.001"], "has fewer than two samples from 2 to 2.001 s"),
        (["{bag}", "--output", "{tmp}/no/such/directory.yaml"], "cannot write {tmp}/no/such/directory.yaml"),
    ],
)
def test_a_bad_command_is_one_sentence(
    arguments: list[str], words: str, good: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert identify([argument.format(tmp=tmp_path, bag=good) for argument in arguments]) == 1
    err = capsys.readouterr().err
    assert words.format(tmp=tmp_path, bag=good) in err and err.count("\n") == 1


def test_what_exists_is_only_replaced_by_force(good: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "report").mkdir()
    options = ["--output", str(tmp_path / "model.yaml"), "--json", str(tmp_path / "fit.json")]
    options += ["--report", str(tmp_path / "report")]
    said = "exists already and is left as it is: choose another name, or replace it with --force.\n"
    files = [tmp_path / name for name in ("model.yaml", "fit.json", "report/fit.png", "report/model.yaml")]
    for taken in files:
        taken.write_text("mine")
        assert identify([str(good), *options]) == 1
        assert capsys.readouterr() == ("", f"{taken} {said}")
        assert taken.read_bytes() == b"mine" and sum(file.exists() for file in files) == 1
        taken.unlink()
    for taken in files:
        taken.write_text("mine")
    assert identify([str(good), *options, "--force"]) == 0
    assert all(taken.read_bytes() != b"mine" for taken in files)


SLOW = """
from numba import njit
import motor_identification.service.job as module
from motor_identification.cli.identify import main

def run_job(job, progress):
    progress("search", 0.3)
    print("computing", flush=True)
    while True:
        njit(lambda x: x + 1.0)(1.0)  # compiling calls back through ctypes, where a KeyboardInterrupt would be lost

module.run_job = run_job
raise SystemExit(main())
"""


def test_ctrl_c_is_one_sentence_while_the_motor_is_compiled_too(good: Path) -> None:
    process = subprocess.Popen([sys.executable, "-c", SLOW, str(good)], stderr=subprocess.PIPE, stdout=subprocess.PIPE)
    assert process.stdout is not None and process.stdout.readline() == b"computing\n"
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=PATIENCE)
    assert (process.returncode, out) == (130, b"")
    assert err == b"The identification was interrupted; nothing was written.\n"


@pytest.mark.parametrize("arguments", [[], ["bag", "--particles", "1"], ["bag", "--epochs", "many"]])
def test_a_misused_command_exits_with_2(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stopped:
        identify(arguments)
    assert stopped.value.code == 2
    assert "usage: ros2 run motor_identification identify [options] BAG [BAG ...]\n" in capsys.readouterr().err


def test_a_bag_that_was_cut_off_is_read_up_to_the_cut_and_that_is_said(
    good: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    cut = tmp_path / "cut"
    shutil.copytree(good, cut)
    (cut / "metadata.yaml").unlink()
    file = next(cut.glob("*.mcap"))
    file.write_bytes(file.read_bytes()[: int(0.6 * file.stat().st_size)])
    assert identify([str(cut), "--effects", "coulomb_friction"]) == 0
    out = capsys.readouterr().out
    assert "is cut off: 1170 samples, 5.85 s" in out
    values = {row.split()[0]: float(row.split()[1]) for row in out.splitlines() if row[:2] in ("kv", "ka", "ks")}
    assert values["kv"] == pytest.approx(PAPER_KV, rel=0.01)


def test_experiment_offline_is_the_same_for_the_same_seed_and_refuses_an_existing_bag(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    from motor_identification.bag import read_recording

    for name in ("a", "b"):
        assert experiment(["step", "--model", "", "--voltage", "10", "--output", str(tmp_path / name)]) == 0
    a, b = (read_recording(str(tmp_path / name)) for name in ("a", "b"))
    assert np.array_equal(a.edge_time, b.edge_time) and a.voltage.max() == 10.0
    assert a.duration == pytest.approx(1.1, abs=0.01)
    capsys.readouterr()
    assert experiment(["step", "--model", "", "--output", str(tmp_path / "a")]) == 1
    err = capsys.readouterr().err
    assert "exists already" in err and err.count("\n") == 1


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("effects: [magic]\nparameters: {kv: 0.07, ka: 0.005}", "'magic' is not an effect"),
        ("effects: []\nparameters: {kv: 0.07, ka: -0.005}", "ka = -0.005 V·s²/rad is not physical"),
        ("effects: []\nparameters: {kv: 0.07}", "the model lacks ka"),
        ("kv: 0.07", "a model file has 'effects' and 'parameters'"),
        ("{", "is not YAML"),
    ],
)
def test_a_bad_model_file_is_one_sentence(
    text: str, words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "model.yaml").write_text(text)
    model = str(tmp_path / "model.yaml")
    assert experiment(["step", "--model", model, "--output", str(tmp_path / "bag")]) == 1
    err = capsys.readouterr().err
    assert words in err and err.count("\n") == 1
    assert not (tmp_path / "bag").exists()
