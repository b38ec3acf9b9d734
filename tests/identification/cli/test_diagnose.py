"""`diagnose` and `explore` as their user meets them: what they print and write, and one sentence for what is wrong."""

import contextlib
import fcntl
import json
import os
import pty
import re
import signal
import struct
import subprocess
import sys
import termios
from collections.abc import Callable
from pathlib import Path

import pytest
import yaml
from friction import KS
from patience import PATIENCE
from tiers import keep_fast

from motor_identification.cli.diagnose import main as diagnose
from motor_identification.cli.explore import main as explore
from motor_model.errors import MotorError
from motor_model.model_file import load


def test_names_the_effect_and_writes_what_was_asked_for(
    bags: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    files = {name: tmp_path / name for name in ("model.yaml", "all.json", "new/report")}
    options = ["--output", str(files["model.yaml"]), "--json", str(files["all.json"])]
    options += ["--report", str(files["new/report"]), "--validate", str(bags / "coast")]
    assert diagnose([str(bags / "staircase"), *options]) == 0
    out, err = capsys.readouterr()
    assert err == "" and "coulomb_friction" in out
    (printed,) = {float(value) for value in re.findall(r"ks = ([\d.]+) ±", out)}
    assert printed == pytest.approx(KS, rel=1e-3)
    assert [line for line in out.splitlines() if ".yaml" in line or ".json" in line or ".html" in line] == [
        f"model: {tmp_path / 'model.yaml'}", f"json: {tmp_path / 'all.json'}",
        f"report: {tmp_path / 'new/report/report.html'}",
    ]  # fmt: skip

    content = json.loads(files["all.json"].read_text())
    assert content["bags"] == [str(bags / "staircase")] and content["validation"] == [str(bags / "coast")]
    assert content["verdict"] in ("explained", "undecided")
    assert [finding["effect"] for finding in content["findings"]] == ["coulomb_friction"]
    assert content["model"]["effects"] == ["coulomb_friction"] and content["baseline"]["effects"] == []
    assert content["model"]["parameters"]["ks"]["value"] == pytest.approx(KS, rel=1e-3)
    assert content["gap_before"] > 10.0 * content["noise_floor"]
    assert 0.7 < content["gap_after"] / content["noise_floor"] < 1.3

    model = load(files["model.yaml"])
    assert model.effects == ("coulomb_friction",) and model.value("ks") == pytest.approx(KS, rel=1e-3)
    assert yaml.safe_load(files["model.yaml"].read_text())["origin"]["bags"] == [str(bags / "staircase")]
    beside = files["new/report"]
    assert json.loads((beside / "diagnosis.json").read_text()) == content
    assert load(beside / "model.yaml") == model
    page = (beside / "report.html").read_text(encoding="utf-8")
    assert "<html" in page and f"model:={files['model.yaml']}" in page  # the file that was asked for


def test_what_is_known_is_not_found_again_and_only_the_part_asked_for_is_read(
    bags: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    part = ["--start", "0.5", "--stop", "5.0", "--known-effects", "coulomb_friction, "]
    assert diagnose([str(bags / "staircase"), *part, "--json", str(tmp_path / "d.json")]) == 0
    content = json.loads((tmp_path / "d.json").read_text())
    assert content["baseline"]["effects"] == ["coulomb_friction"] and content["findings"] == []
    assert content["gap_before"] == content["gap_after"]
    capsys.readouterr()
    assert diagnose([str(bags / "staircase"), "--start", "50", "--stop", "60"]) == 1
    assert "s long: --start 50 s is after its end." in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["{bags}/nowhere"], "There is no bag"),
        (["{bags}/coast", "--validate", "{bags}/nowhere"], "There is no bag"),
        (["{bags}/coast", "--validate", "{bags}/staircase/../coast"], "is given for the fit and for validation"),
        (["{bags}/coast", "--known-effects", "magic"], "'magic' is not an effect"),
        (["{bags}/coast", "--known-effects", " ,"], "--known-effects  , names no effect"),
        (["{bags}/coast", "--topic-namespace", "left"], "/left/motor/speed"),
        (["{bags}/coast", "--start", "3", "--stop", "2"], "must be before"),
        (["{bags}/coast", "--output", "{tmp}/no/model.yaml"], "cannot write {tmp}/no/model.yaml"),
        (["{bags}/coast", "--json", "{tmp}"], "cannot write {tmp}"),
        (["{bags}/coast", "--report", "{bags}/true.yaml"], "cannot write {bags}/true.yaml/"),
    ],
)
def test_a_bad_command_is_one_sentence_before_anything_is_computed(
    arguments: list[str],
    words: str,
    bags: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("motor_identification.diagnosis.start.search_globally", None)  # nobody gets so far
    names = {"bags": bags, "tmp": tmp_path}
    assert diagnose([argument.format(**names) for argument in arguments]) == 1
    out, err = capsys.readouterr()
    assert words.format(**names) in err and err.count("\n") == 1 and out == ""


@pytest.mark.parametrize(
    ("command", "arguments"),
    [(diagnose, []), (diagnose, ["--validate", "a", "b"]), (diagnose, ["a", "--start", "soon"]), (explore, [])]
    + [(explore, ["d", *more]) for more in (["--rounds", "0"], ["--profile", "magic"], ["--voltage", "-1"])],
)
def test_a_misused_command_exits_with_2(
    command: Callable[[list[str]], int], arguments: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as stopped:
        command(arguments)
    name = command.__module__.rpartition(".")[2]
    assert stopped.value.code == 2
    assert f"usage: ros2 run motor_identification {name} [options]" in capsys.readouterr().err


def test_a_file_that_cannot_be_written_after_all_takes_no_other_with_it(
    bags: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*arguments: object) -> None:
        raise MotorError("cannot write it: No space left on device.")

    monkeypatch.setattr("motor_identification.reporting.html.write_report", full)
    options = ["--known-effects", "coulomb_friction", "--report", str(tmp_path / "report")]
    assert diagnose([str(bags / "coast"), *options]) == 1
    out, err = capsys.readouterr()
    assert "noise floor" in out
    assert err == "cannot write it: No space left on device.\n"
    assert {path.name for path in (tmp_path / "report").iterdir()} == {"model.yaml", "diagnosis.json"}


@pytest.mark.parametrize("taken", ["model.yaml", "all.json", "report/report.html", "report/diagnosis.json"])
def test_what_exists_is_not_replaced_and_nothing_computed_in_vain(
    taken: str, bags: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("motor_identification.diagnosis.start.search_globally", None)  # nobody gets so far
    (tmp_path / "report").mkdir()
    (tmp_path / taken).write_text("mine")
    options = ["--output", str(tmp_path / "model.yaml"), "--json", str(tmp_path / "all.json")]
    assert diagnose([str(bags / "coast"), *options, "--report", str(tmp_path / "report")]) == 1
    said = "exists already and is left as it is: choose another name, or replace it with --force.\n"
    assert capsys.readouterr() == ("", f"{tmp_path / taken} {said}")
    assert (tmp_path / taken).read_text() == "mine"


SLOW = """
import threading
import motor_identification.diagnose as module
from motor_identification.cli.diagnose import main

def diagnose(recordings, validation, request, progress, stopped):
    tick = threading.Event()

    def for_ever() -> None:
        while True:
            tick.wait(0.01)

    threading.Thread(target=for_ever).start()
    while True:
        progress(module.Stage("step 1: backlash", 0.4, "backlash", 0.25))
        tick.wait(0.01)

module.diagnose = diagnose
raise SystemExit(main())
"""


@pytest.mark.parametrize("number", keep_fast([signal.SIGINT, signal.SIGTERM], signal.SIGINT))
def test_shows_progress_on_a_terminal_and_ends_at_ctrl_c(bags: Path, number: signal.Signals) -> None:
    terminal, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 100, 0, 0))
    command = [sys.executable, "-c", SLOW, str(bags / "coast")]
    process = subprocess.Popen(command, stderr=theirs, stdout=subprocess.PIPE)
    os.close(theirs)
    shown, told = b"", False
    with contextlib.suppress(OSError):  # when the process, the other end, is gone: its other threads have ended too
        while True:
            shown += os.read(terminal, 1024)
            if not told and b"step 1: backlash, gap 0.25 rad/s" in shown and b" 40 %" in shown:
                process.send_signal(number)
                told = True
    os.close(terminal)
    assert process.communicate(timeout=PATIENCE)[0] == b"" and process.returncode == 130
    assert told and b"Traceback" not in shown
    assert shown.endswith(b"The diagnosis was interrupted; nothing was written.\r\n")


@pytest.mark.slow
@pytest.mark.usefixtures("undrawn")
def test_explores_until_nothing_is_open(bags: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    directory = tmp_path / "found"
    model = ["--model", str(bags / "true.yaml"), "--voltage", "10"]
    assert explore([str(directory), "--profile", "step", *model]) == 0
    out, err = capsys.readouterr()
    rounds = sorted(path.name for path in directory.iterdir() if path.is_dir())
    assert rounds[0] == "1_step" and len(rounds) >= 2
    assert rounds[1] in ("2_staircase", "2_ramps", "2_coast") and f"Round 2: '{rounds[1][2:]}', as suggested." in out
    content = json.loads((directory / "diagnosis.json").read_text())
    assert content["bags"] == [str(directory / name) for name in rounds]
    assert [finding["effect"] for finding in content["findings"]] == ["coulomb_friction"]
    assert load(directory / "model.yaml").value("ks") == pytest.approx(KS, rel=1e-3)
    assert (directory / "report.html").exists()
    assert "Traceback" not in err

    assert explore([str(directory), *model]) == 1
    assert f"{directory} is not empty" in capsys.readouterr().err


@pytest.mark.usefixtures("undrawn")
def test_explores_no_longer_than_asked_for(bags: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    options = ["--profile", "step", "--rounds", "1", "--model", str(bags / "true.yaml")]
    assert explore([str(tmp_path / "found"), *options]) == 0
    assert "was suggested next; --rounds 1 ends here." in capsys.readouterr().out
    assert [path.name for path in (tmp_path / "found").iterdir() if path.is_dir()] == ["1_step"]


def test_an_exploration_that_cannot_begin_is_one_sentence(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert explore([str(tmp_path / "found"), "--model", str(tmp_path / "nowhere.yaml")]) == 1
    err = capsys.readouterr().err
    assert "nowhere.yaml" in err and err.count("\n") == 1
