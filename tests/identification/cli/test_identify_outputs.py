"""A fit that was computed is not lost: to a pipe that closes, a full device, a name with odd characters."""

import shlex
import subprocess
import sys
from pathlib import Path

import pytest
from tiers import keep_fast

from motor_identification.cli.identify import main
from motor_model.model_file import load

QUICK = ["--particles", "8", "--epochs", "4"]  # how good a fit is, is not asked for here
COMMAND = [sys.executable, "-u", "-m", "motor_identification.cli.identify"]  # not buffered


@pytest.mark.parametrize(
    ("where", "status"), keep_fast([("| true", 0), ("> /dev/full", 1), (">&-", 0)], ("> /dev/full", 1))
)
def test_the_model_is_written_wherever_the_words_go(bags: Path, tmp_path: Path, where: str, status: int) -> None:
    """`identify … --output x | true` wrote no file and ended with 0."""
    words = " ".join([*COMMAND, str(bags / "staircase"), *QUICK, "--output", str(tmp_path / "model.yaml")])
    done = subprocess.run(
        ["bash", "-c", f"{words} {where}; exit ${{PIPESTATUS[0]}}"], capture_output=True, text=True, timeout=120.0
    )
    assert done.returncode == status and "Traceback" not in done.stderr and done.stderr.count("\n") <= status
    assert load(tmp_path / "model.yaml").gain > 0.0


@pytest.mark.parametrize("command", keep_fast(["inspect", "import_log"], "inspect"))
def test_what_is_found_is_written_although_nobody_reads_it(bags: Path, tmp_path: Path, command: str) -> None:
    log = tmp_path / "log.csv"
    log.write_text("t,u,speed\n" + "".join(f"{0.01 * k},{k % 50 // 25},{k % 50}\n" for k in range(300)))
    run = f"from motor_identification.cli.{command} import main; import sys; sys.exit(main(sys.argv[1:]))"
    read = [str(bags / "staircase")] if command == "inspect" else [str(log), "--unit", "rad/s"]
    line = shlex.join([sys.executable, "-u", "-c", run, *read, "--output", str(tmp_path / "found")])
    done = subprocess.run(
        ["bash", "-c", f"{line} | true; exit ${{PIPESTATUS[0]}}"], capture_output=True, text=True, timeout=120.0
    )
    assert (done.returncode, done.stderr) == (0, "") and (tmp_path / "found").exists()


def test_a_file_that_cannot_be_written_costs_neither_the_fit_nor_the_others(
    bags: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    files = ["--output", "/dev/full", "--json", str(tmp_path / "fit.json")]
    assert main([str(bags / "staircase"), *QUICK, *files, "--force"]) == 1
    said = capsys.readouterr()
    assert "kv" in said.out and (tmp_path / "fit.json").is_file()
    assert said.err == (
        "cannot write the model file /dev/full (No space left on device): make room, or choose another place.\n"
    )


@pytest.mark.slow
def test_a_name_with_odd_characters_is_drawn_as_it_is(
    bags: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A $ in a bag's name was a formula that could not be read, and there was no report."""
    name = "$\\frac{a$b$c\x1b[2J<script>"
    (tmp_path / name).symlink_to(bags / "staircase")
    assert main([str(tmp_path / name), *QUICK, "--report", str(tmp_path / "report")]) == 0
    assert {path.name for path in (tmp_path / "report").iterdir()} == {
        "report.html",
        "fit.png",
        "fit.json",
        "model.yaml",
    }
    page = (tmp_path / "report" / "report.html").read_text(encoding="utf-8")
    assert "\x1b" not in page + capsys.readouterr().out and "<script>" not in page
