"""Logs that begin late, that have no time, that log the last voltage, or that were read in a wrong unit."""

from dataclasses import replace
from math import pi, radians
from pathlib import Path

import numpy as np
import pytest

from motor_identification.bag import read_recording
from motor_identification.cli.import_csv import main
from motor_identification.logs import CsvForm, Kind, Log, read_log
from motor_identification.logs.form import time_unit_size
from motor_identification.measurement.build_intervals import make_intervals
from motor_identification.recording import check, recording_of
from motor_model.errors import RecordingError
from motor_model.sample import Measurement

SPEED = CsvForm("t", "u", "y", Kind.SPEED, "deg/s")
ANGLE = CsvForm("t", "u", "y", Kind.POSITION, "deg", edges_per_revolution=360)
STATIC = CsvForm(None, "u", "y", Kind.SPEED, "deg/s")


def read(folder: Path, rows: list[tuple[object, ...]], form: CsvForm, header: str = "t,u,y") -> Log:
    path = folder / "log.csv"
    path.write_text("\n".join([header, *(",".join(map(str, row)) for row in rows)]) + "\n")
    return read_log(path, form)


LATE = [(0.012, 5, 0), (0.017, 5, 1), (0.022, 4, 3)]


def test_a_run_from_rest_begins_when_its_voltage_came(tmp_path: Path) -> None:
    log = read(tmp_path, LATE, replace(ANGLE, rest_until=0.0))
    begin, first, *_ = log.runs[0].samples
    assert (begin.sample_time, begin.voltage, begin.speed, begin.edge_count) == (0, 5.0, 0.0, 0)
    assert [sample.sample_time for sample in log.runs[0].samples] == [0, 12_000_000, 17_000_000, 22_000_000]
    assert first.speed > 0.0  # a difference that is not known, and so not at the beginning
    assert "The motor stands until 0 s: the bag begins then" in log.findings[-1]
    at_once = read(tmp_path, LATE, replace(ANGLE, rest_until=0.012)).runs[0].samples
    assert len(at_once) == 3 and at_once[0].speed == 0.0 and at_once[0].sample_time == 12_000_000
    with pytest.raises(RecordingError, match=r"line 2: the run begins at t = 0.012 s, before --rest-until 0.02: that"):
        read(tmp_path, LATE, replace(ANGLE, rest_until=0.02))


def test_every_run_of_a_split_log_begins_from_rest(tmp_path: Path) -> None:
    rows = [*((*row, "a") for row in LATE), *((*row, "b") for row in LATE)]
    log = read(tmp_path, rows, replace(ANGLE, rest_until=0.0, split="s"), "t,u,y,s")
    assert [[sample.sample_time for sample in run.samples][:2] for run in log.runs] == [[0, 12_000_000]] * 2
    assert "every run begins then" in log.findings[-1] and log.info.sample_period == pytest.approx(0.005)


def test_a_run_that_goes_on_behind_missing_rows_begins_from_no_rest(tmp_path: Path) -> None:
    one = [(round(0.012 + 0.005 * k, 3), 5, k * k) for k in range(30)]
    gap = [(round(time + 0.5, 3), u, y + 900) for time, u, y in one]
    log = read(tmp_path, [*one, *gap, *one], replace(ANGLE, rest_until=0.0))
    assert [run.samples[0].sample_time for run in log.runs] == [0, 512_000_000, 0]
    assert log.runs[1].samples[0].edge_count == 900 and log.runs[2].samples[0].edge_count == 0
    assert "every run that goes on from none before begins then" in log.findings[-1]


def test_a_voltage_that_was_applied_before_its_row(tmp_path: Path) -> None:
    usual = read(tmp_path, LATE, ANGLE)
    assert [sample.voltage for sample in usual.runs[0].samples] == [5.0, 5.0, 4.0]
    assert "applied from its time until the next row (otherwise: --voltage-before)" in usual.findings[-1]
    before = read(tmp_path, LATE, replace(ANGLE, voltage_before=True))
    assert [sample.voltage for sample in before.runs[0].samples] == [5.0, 4.0, 4.0]
    assert "from the time of the row before until its own" in before.findings[-1]
    rested = read(tmp_path, [(0.012, 3, 0), *LATE[1:]], replace(ANGLE, voltage_before=True, rest_until=0.0))
    assert [sample.voltage for sample in rested.runs[0].samples] == [3.0, 5.0, 4.0, 4.0]
    split = [*((*row, "a") for row in LATE), *((*row, "b") for row in LATE)]
    log = read(tmp_path, split, replace(ANGLE, voltage_before=True, split="s"), "t,u,y,s")
    assert [[sample.voltage for sample in run.samples] for run in log.runs] == [[5.0, 4.0, 4.0]] * 2


def test_a_static_curve_is_a_stair_whose_ends_are_compared(tmp_path: Path) -> None:
    rows = [(1, 100), (2, 260), (3, 421), (-3, -420)]
    log = read(tmp_path, rows, replace(STATIC, edges_per_revolution=2800, speed_window=0.5), "u,y")
    samples = log.runs[0].samples
    assert [sample.voltage for sample in samples] == [1.0, 2.0, 3.0, -3.0, -3.0]
    assert [sample.speed for sample in samples] == pytest.approx([0.0, *map(radians, (100, 260, 421, -420))])
    assert np.all(np.diff([sample.sample_time for sample in samples]) == 20_000_000_000)
    assert (log.info.measurement, log.info.speed_window, log.info.speed_lag) == (Measurement.SPEED, 0.5, 0.25)
    assert "log.csv: 4 steady states, up to 3 V." in log.findings[0] and "do not show inertia" in log.findings[2]
    intervals = make_intervals(check(recording_of(samples, log.info, "static")))
    assert np.array_equal(intervals.time[intervals.last], [20.0, 40.0, 60.0, 80.0])
    assert np.allclose(intervals.duration, 0.5) and np.degrees(intervals.speed) == pytest.approx([100, 260, 421, -420])
    assert np.degrees(intervals.sigma) == pytest.approx(360 / 2800 / 0.5 / np.sqrt(6.0), rel=1e-6)
    assumed = read(tmp_path, rows, STATIC, "u,y")
    assert "the mean over the last 1 s (assumed; otherwise: --speed-window)" in assumed.findings[1]
    by_count = read(tmp_path, rows, replace(STATIC, count_quantum=0.36), "u,y")
    assert by_count.info.edges_per_revolution == 1000  # 0.36 deg/s over 1 s
    with pytest.raises(RecordingError, match="the mean over 5 s at most: reduce --speed-window"):
        read(tmp_path, rows, replace(STATIC, speed_window=6.0), "u,y")


def test_positions_that_wrap_or_jump(tmp_path: Path) -> None:
    angle = np.arange(120) * 7
    again = [(f"{0.005 * k:.3f}", 5, value) for k, value in enumerate(np.tile([0, 0, *range(0, 252, 7)], 3))]
    with pytest.raises(
        RecordingError, match=r"line \d+: y jumps from \d+ to \d+, and not for the first time: say"
    ) as bad:
        read(tmp_path, again, ANGLE)  # where it stands behind each jump
    assert str(bad.value).endswith(".") and "\n" not in str(bad.value)
    once = [(f"{0.005 * k:.3f}", 5, 9999 if k == 60 else value) for k, value in enumerate(angle)]
    misread = read(tmp_path, once, ANGLE)
    assert [len(run.samples) for run in misread.runs] == [60, 59]
    assert any(line.startswith("Caution: y jumps once, at line 62,") for line in misread.findings)
    wrapped = [(f"{0.005 * k:.3f}", 5, value) for k, value in enumerate(angle % 256)]
    said = read(tmp_path, wrapped, replace(ANGLE, wrap=256.0))
    assert said.runs[0].samples[-1].edge_count == 119 * 7 and "y wraps at 256 deg (3 times)" in " ".join(said.findings)
    told = read(tmp_path, wrapped, ANGLE)
    assert told.runs[0].samples[-1].edge_count == 119 * 7 and "y wraps at 256 deg (3 times; a" in " ".join(
        told.findings
    )
    turning = [(f"{0.005 * k:.3f}", 5, value) for k, value in enumerate(angle % 360)]
    seen = read(tmp_path, turning, ANGLE)
    assert seen.runs[0].samples[-1].edge_count == 119 * 7 and "y wraps at 360 deg (2 times)" in " ".join(seen.findings)
    reset = [(f"{0.005 * k:.3f}", 5, value - 420 * (k > 60)) for k, value in enumerate(angle)]
    parts = read(tmp_path, reset, ANGLE)
    assert [len(run.samples) for run in parts.runs] == [61, 59] and "y is reset once: 2 runs" in " ".join(
        parts.findings
    )
    smooth = [(f"{0.005 * k:.3f}", 5, value) for k, value in enumerate(angle)]
    assert read(tmp_path, smooth, ANGLE).runs[0].samples[-1].edge_count == 119 * 7


@pytest.mark.parametrize("unit", ["rad/s", "rpm"])
def test_speeds_in_a_mistaken_unit_are_seen_by_their_steps(tmp_path: Path, unit: str) -> None:
    """Counts of 2800 a turn in 20 ms: 6.43 deg/s each; the same numbers as rad/s or rpm are 57 or 6 times too fast."""
    count = 360 / 2800 / 0.02
    rows = [(f"{0.02 * k:.2f}", 2, f"{count * (20 + 7 * k % 17):.6f}") for k in range(60)]
    right = replace(SPEED, edges_per_revolution=2800, speed_window=0.02)
    assert "is 6.429 deg/s." in " ".join(read(tmp_path, rows, right).findings)
    with pytest.raises(RecordingError, match=rf"change in steps of 6.429 {unit}, but one count .2800 .* check --unit"):
        read(tmp_path, rows, replace(right, unit=unit))
    slower = [(time, volts, f"{radians(float(value)):.9f}") for time, volts, value in rows]
    with pytest.raises(RecordingError, match="change in steps of 0.1122 deg/s, but one count .2800"):
        read(tmp_path, slower, right)


def test_speeds_that_were_timed_between_edges_change_by_their_digits(tmp_path: Path) -> None:
    """Of a slow motor, at 200 Hz: one count of 400 a turn in a row is 30 rpm, and the steps are 0.01."""
    rows = [(f"{0.005 * k:.3f}", 2, f"{20.0 + 0.01 * (37 * k % 501):.2f}") for k in range(400)]
    timed = replace(SPEED, unit="rpm", edges_per_revolution=400)
    log = read(tmp_path, rows, timed)
    assert log.info.edges_per_revolution == 0 and "were smoothed, or timed" in " ".join(log.findings)
    coarse = [(time, volts, f"{float(value):.1f}") for time, volts, value in rows]
    with pytest.raises(RecordingError, match="change in steps of 0.1 rpm, but one count .2800"):
        read(tmp_path, coarse, replace(timed, edges_per_revolution=2800))
    turns = [(time, volts, f"{0.5 * (k % 11):.1f}") for k, (time, volts, _) in enumerate(rows)]  # counts, in rev/s
    with pytest.raises(RecordingError, match="change in steps of 0.5 deg/s, but one count .400"):
        read(tmp_path, turns, replace(timed, unit="deg/s"))


def test_the_command_offers_them(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "static.csv").write_text("u,y\n" + "".join(f"{k},{160 * k - 32}\n" for k in range(1, 6)))
    common = ["--voltage", "u", "--unit", "deg/s"]
    assert (
        main([str(tmp_path / "static.csv"), "--output", str(tmp_path / "static"), "--steady", "--speed", "y", *common])
        == 0
    )
    recording = read_recording(tmp_path / "static")
    assert len(recording) == 6 and recording.info.speed_window == 1.0
    (tmp_path / "steps.csv").write_text("t,u,y\n0.01,5,0\n0.02,5,1\n0.03,5,3\n")
    steps = [str(tmp_path / "steps.csv"), "--time", "t", "--voltage", "u", "--position", "y", "--unit", "deg"]
    more = ["--edges-per-revolution", "360", "--rest-until", "0", "--voltage-before"]
    assert main([*steps, "--output", str(tmp_path / "steps"), *more]) == 0
    recording = read_recording(tmp_path / "steps")
    assert recording.time == pytest.approx([0.0, 0.01, 0.02, 0.03]) and recording.speed[0] == 0.0
    assert recording.speed[2] == pytest.approx(2 * pi / 360 / 0.01)
    capsys.readouterr()
    for wrong in (
        ["--steady", "--position", "y", "--voltage", "u", "--unit", "deg"],
        ["--steady", "--speed", "y", "--speed-lag", "0", *common],
        ["--steady", "--speed", "y", "--voltage-before", *common],
        ["--steady", "--time", "t", "--speed", "y", *common],
        ["--steady", "--speed", "y", "--rest-until", "0", *common],
        ["--time", "t", "--speed", "y", "--rest-until", "nan", *common],
        ["--speed", "y", "--speed-lag", "nan", *common],
        ["--speed", "y", "--edges-per-revolution", "20000000000", *common],
        ["--speed", "y", "--full-duty", "255", "--voltage-scale", "2", *common],
        ["--motor", "left:u", *common],
    ):
        with pytest.raises(SystemExit) as caught:
            main([str(tmp_path / "static.csv"), "--output", str(tmp_path / "no"), *wrong])
        assert caught.value.code == 2 and not (tmp_path / "no").exists()


def test_help_shows_whole_commands(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["--help"])
    text = capsys.readouterr().out
    assert text.count("  ros2 run motor_identification import_csv ") >= 3
    assert "--split duty_pct --rest-until 0" in text and "--steady" in text


@pytest.mark.parametrize(("unit", "size"), [("s", 10**9), ("ns", 1), ("8.26446e-06", 8264), ("1e-12", 1)])
def test_the_unit_of_times_is_named_or_seconds_a_tick(unit: str, size: int) -> None:
    assert time_unit_size(unit) == size


def test_ticks_of_a_timer_become_seconds(tmp_path: Path) -> None:
    rows = [(1520 * k, 5, 3 * k) for k in range(50)]  # of 121 kHz
    log = read(tmp_path, rows, replace(SPEED, time_unit="8.26446e-06"))
    assert log.info.sample_period == pytest.approx(1520 / 121_000, rel=1e-4)
