"""`import_log` as a command."""

from pathlib import Path

import pytest

from motor_identification.bag import read_recording
from motor_identification.cli._log_bags import write_bags
from motor_identification.cli.import_log import main
from motor_identification.logs.run import Run
from motor_model.errors import RecordingError
from motor_model.sample import Info, Sample

DATA = Path(__file__).resolve().parents[2] / "data"


def test_a_dry_run_says_it_in_one_screen_and_writes_nothing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([str(DATA / "undc/prbs_2026-08-14.csv"), "--output", str(tmp_path / "bag"), "--dry-run"]) == 0
    out, err = capsys.readouterr()
    assert err == "" and out.count("\n") <= 24 and out.endswith("Nothing is written (--dry-run).\n")
    for word in ("a text table with the columns t, u, y", "sample period 20 ms", "Excitation: 1.83 to 3.08 V"):
        assert word in out
    assert list(tmp_path.iterdir()) == []


def test_a_bag_for_every_motor_and_run(tmp_path: Path) -> None:
    assert main([str(DATA / "frc/drivetrain_sysid.json"), "--output", str(tmp_path / "robot")]) == 0
    names = sorted(path.name for path in tmp_path.iterdir())
    tests = ("fast-backward", "fast-forward", "slow-backward", "slow-forward")
    assert names == [f"robot_{side}_{test}" for side in ("left", "right") for test in tests]
    assert read_recording(tmp_path / names[0]).info.name == "left"


def test_questions_are_one_sentence_and_exit_1(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([str(DATA / "ev3/steps_1s.csv"), "--output", str(tmp_path / "bag")]) == 1
    out, err = capsys.readouterr()
    assert out == "" and err.count("\n") == 1 and "(--supply-voltage V)" in err and list(tmp_path.iterdir()) == []


def test_an_output_has_to_be_said() -> None:
    with pytest.raises(SystemExit) as caught:
        main([str(DATA / "undc/prbs_2026-08-14.csv")])
    assert caught.value.code == 2


@pytest.mark.parametrize("period", ["0", "-1", "nan", "inf", "1e300", "two"])
def test_a_sample_period_is_a_number_above_zero(period: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        main(["log.csv", "--dry-run", "--sample-period", period])
    assert caught.value.code == 2 and "argument --sample-period: " in capsys.readouterr().err.splitlines()[-1]


@pytest.mark.parametrize("other", [["--time", "t"], ["--time-unit", "ms"], ["--steady"]])
def test_a_sample_period_is_instead_of_times(other: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        main(["log.csv", "--dry-run", "--sample-period", "0.002", *other])
    assert caught.value.code == 2 and "--sample-period" in capsys.readouterr().err.splitlines()[-1]


def test_what_breaks_in_the_middle_leaves_no_bag(tmp_path: Path) -> None:
    run = Run("", (Sample(0, 1.0, 1.0), Sample(10, 1.0, 1.0)))
    broken = Run("", (Sample(0, 1.0, 1.0), Sample(10, "fast", 1.0)))  # type: ignore[arg-type]
    with pytest.raises(ValueError):
        write_bags({tmp_path / "a": (run, Info()), tmp_path / "b": (broken, Info())}, 10**18)
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(RecordingError, match="before 1970 or after 2038"):
        write_bags({tmp_path / "a": (run, Info())}, 2**62)
    assert list(tmp_path.iterdir()) == []
    write_bags({tmp_path / "a": (run, Info())}, 10**18)
    assert len(list(tmp_path.iterdir())) == 1


def test_a_bag_keeps_what_its_import_warned_of(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A detrended log came to a diagnosis that named effects of its lost means and said nothing of them."""
    drive = [3.0 if k % 40 < 10 else 1.0 for k in range(400)]
    speed = [2.0]
    for volts in drive[:-1]:
        speed.append(speed[-1] + 0.2 * (2.0 * volts - speed[-1]))
    for name, share in (("whole", 0.0), ("detrended", 1.0)):
        lost = [share * sum(one) / len(one) for one in (drive, speed)]
        rows = (f"{0.01 * k:.2f},{drive[k] - lost[0]:.9f},{speed[k] - lost[1]:.9f}" for k in range(400))
        (tmp_path / f"{name}.csv").write_text("\n".join(["time [s],voltage [V],speed [rad/s]", *rows]))
        assert main([str(tmp_path / f"{name}.csv"), "--output", str(tmp_path / name)]) == 0
    assert "Caution: voltage [V] and speed [rad/s] both have a mean of 0" in capsys.readouterr().out
    assert read_recording(tmp_path / "whole").notes == ()
    (note,) = read_recording(tmp_path / "detrended").notes
    assert note.startswith("The import cautions: voltage [V] and speed [rad/s] both have a mean of 0, as where a trend")


@pytest.mark.parametrize(
    "other", [["--motor", "a:x,y"], ["--steady"], ["--full-duty", "255"], ["--voltage", "u"], ["--direction", "d"]]
)
def test_a_constant_voltage_takes_nothing_beside_it(capsys: pytest.CaptureFixture[str], other: list[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        main(["log.csv", "--dry-run", "--constant-voltage", "9", *other])
    assert caught.value.code == 2 and "--constant-voltage" in capsys.readouterr().err.splitlines()[-1]


@pytest.mark.parametrize(
    ("unit", "status"), [("1e-9", 1), ("9e-10", 2), ("3600", 1), ("3601", 2), ("min", 2), ("nan", 2)]
)
def test_a_unit_of_times_is_named_or_seconds_a_tick(
    unit: str, status: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A file that is not there is looked for where the option is sound."""
    try:
        found = main([str(tmp_path / "none.csv"), "--time-unit", unit, "--dry-run"])
    except SystemExit as end:
        found = int(end.code or 0)
    assert found == status
    told = capsys.readouterr().err
    assert (f"{unit} is none of s, ms, us, ns, and no seconds a tick" in told) is (status == 2)
