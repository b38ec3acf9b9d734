"""Logs without times whose rows are so many seconds apart."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.columns.said import Said
from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import Kind
from motor_identification.logs.imported import import_log
from motor_identification.logs.rows.row_times import (
    ROW_TIMES,
    give_times,
    number_rows,
    space_evenly,
    sum_steps,
    take_periods_out,
    write_times_in_seconds,
)
from motor_model.errors import RecordingError

HEADER = "Channel 1,Channel 2,Channel 4"
SAID = {"voltage": "Channel 4", "motion": "Channel 2", "unit": "deg"}


def write_logs(folder: Path, spoilt: int | None = None) -> tuple[Path, Path]:
    """The same log without and with times, 2 ms a row; a row may have a garbled cell."""
    volts = 6.0 * np.sign(np.sin(np.arange(400) / 25.0))
    angle = 0.9 * np.rint(40.0 * (1.0 - np.cos(np.arange(400) / 25.0)))
    rows = [f"{k % 3},{y:.2f},{u:g}" for k, (y, u) in enumerate(zip(angle, volts, strict=True))]
    if spoilt is not None:
        rows[spoilt] = "1,#,6"
    timed = [f"{0.002 * k:.3f},{row}" for k, row in enumerate(rows)]
    bare, full = folder / "bare.csv", folder / "timed.csv"
    bare.write_text("\n".join([HEADER, *rows]) + "\n")
    full.write_text("\n".join([f"t,{HEADER}", *timed]) + "\n")
    return bare, full


@pytest.mark.parametrize("spoilt", [None, 200, 399])
def test_a_log_has_the_samples_that_it_has_with_times(tmp_path: Path, spoilt: int | None) -> None:
    bare, full = write_logs(tmp_path, spoilt)
    without = import_log(bare, Said(sample_period=0.002, kind=Kind.POSITION, **SAID))
    (motor,), (other,) = without.motors, import_log(full, Said(kind=Kind.POSITION, **SAID)).motors
    assert motor.log.runs == other.log.runs and motor.log.info == other.log.info
    assert motor.log.info.sample_period == 0.002 and sum(len(run.samples) for run in motor.log.runs) >= 399
    assert "Time: rows are 2 ms apart, as said (--sample-period)." in without.findings
    assert not any(ROW_TIMES in line for line in (*without.findings, *motor.log.findings))


def test_without_times_a_position_is_asked_about(tmp_path: Path) -> None:
    bare, _ = write_logs(tmp_path)
    asked = "Channel 2 is a position, and no column is its times: say --time COL, or --sample-period S where"
    with pytest.raises(RecordingError, match=asked):
        import_log(bare, Said(kind=Kind.POSITION, **SAID))
    with pytest.raises(RecordingError, match=r"one of Channel 1, Channel 2, Channel 4\. Where"):
        import_log(bare, Said(sample_period=0.002))


@pytest.mark.parametrize(("held", "asked"), [(4, False), (3, True)])
def test_speeds_are_steady_states_where_each_has_a_voltage(tmp_path: Path, held: int, asked: bool) -> None:
    """Of 21 rows, one in so many has the voltage of the row before; 4 of 5 may change."""
    volts = np.cumsum(np.arange(1, 22) % (held + 1) != 0)
    path = tmp_path / "log.csv"
    path.write_text("\n".join(["u,speed [rad/s]", *(f"{u},{5 * u}" for u in volts)]) + "\n")
    if asked:
        with pytest.raises(RecordingError, match=r"u stays from row to row, .*--sample-period S .*; or --steady\."):
            import_log(path, Said())
        assert import_log(path, Said(steady=True)).motors
    else:
        assert any("--time, or --sample-period" in line for line in import_log(path, Said()).findings)


def test_rows_that_are_left_out_leave_their_time_and_turned_ones_go_forward() -> None:
    table = number_rows(Table(Path("log.csv"), [2, 3, 4, 5], {"u": ["1", "2", "3", "4"]}))
    some = table.rows(np.array([True, False, True, True]), "")
    assert give_times(some, 0.002).nanoseconds(ROW_TIMES, 1).tolist() == [0, 4_000_000, 6_000_000]
    assert give_times(table.rows(np.arange(4)[::-1], ""), 1.0).nanoseconds(ROW_TIMES, 1).tolist()[::3] == [0, 3 * 10**9]


@pytest.mark.parametrize(
    ("name", "unit", "named"),
    [("dt", 1e-3, "time"), ("dt_ms", 1.0, "time [ms]"), ("Delta t (us)", 1e3, "time [us]"), ("time_step", 1.0, "time")],
)
def test_times_are_summed_from_how_long_each_row_took(name: str, unit: float, named: str) -> None:
    """10 and 20 ms in turn, as a loop logs that reads a clock of coarse ticks."""
    took = np.where(np.arange(60) % 3, 10.0, 20.0)
    table = Table(Path("log.csv"), np.arange(2, 62), {"u": np.ones(60), name: took * unit})
    summed = sum_steps(table)
    assert summed.names == [named, "u"]
    assert summed.numbers(named) == pytest.approx((np.cumsum(took) - took[0]) * unit)
    assert summed.notes[-1].startswith(f"No column of times: they are summed from {name}, how long")


def test_the_first_row_may_have_taken_nothing() -> None:
    table = Table(Path("log.csv"), np.arange(2, 62), {"u": np.ones(60), "dt": np.where(np.arange(60), 0.01, 0.0)})
    assert sum_steps(table).numbers("time") == pytest.approx(0.01 * np.arange(60))


@pytest.mark.parametrize(
    "columns",
    [
        {"t": np.arange(60.0), "dt": np.ones(60)},  # there are times
        {"u": np.ones(60), "dt": np.where(np.arange(60) < 30, 1.0, 0.0)},  # no time passes
        {"u": np.ones(60), "delta_t": np.arange(1.0, 61.0)},  # since the first row
        {"u": np.ones(60), "timestep": 1000.0 + np.arange(60) // 2},  # a coarse clock that ran before
        {"u": np.ones(60), "dt": 1.0 + np.arange(60) % 20},  # of anything
        {"u": np.ones(2), "dt": np.ones(2)},  # nothing tells
        {"u": np.ones(60), "dt": np.ones(60), "delta_t": np.ones(60)},  # two of them
        {"u": np.ones(60), "data": np.ones(60)},
    ],
)
def test_other_columns_are_not_summed(columns: dict[str, np.ndarray]) -> None:
    table = Table(Path("log.csv"), np.arange(2, 2 + len(next(iter(columns.values())))), columns)
    assert sum_steps(table) is table


def test_a_log_of_steps_is_read_as_one_of_times(tmp_path: Path) -> None:
    bare, full = write_logs(tmp_path)
    rows = bare.read_text().splitlines()[1:]
    (tmp_path / "steps.csv").write_text("\n".join([f"dt,{HEADER}", *(f"0.002,{row}" for row in rows)]) + "\n")
    (one,), (other,) = (import_log(path, Said(**SAID)).motors for path in (tmp_path / "steps.csv", full))
    assert one.log.runs == other.log.runs


@pytest.mark.parametrize("spoilt", ["dt,#,6", "10,#,6"])
def test_a_row_that_is_left_out_keeps_its_time_in_the_sum(tmp_path: Path, spoilt: str) -> None:
    """A garbled row of a table of `dt`: those behind it do not come 10 ms earlier."""
    rows = [f"10,{5 * max(k - 50, 0)},{6 * (k > 50)}" for k in range(200)]
    for name, here in (("whole.csv", rows[120]), ("garbled.csv", spoilt)):
        (tmp_path / name).write_text("\n".join(["dt_ms,angle [deg],u", *rows[:120], here, *rows[121:]]) + "\n")
    times = [
        [sample.sample_time for run in import_log(tmp_path / name, Said()).motors[0].log.runs for sample in run.samples]
        for name in ("whole.csv", "garbled.csv")
    ]
    assert len(times[0]) == 200 and times[1] == [*times[0][:120], *times[0][121:]]


def test_days_of_matlab_are_known_to_ten_microseconds() -> None:
    days = [f"{739_007.5 + 0.01 * k / 86_400.0:.12f}" for k in range(50)]
    table = write_times_in_seconds(Table(Path("log.csv"), np.arange(2, 52), {"t": np.array(days), "u": np.ones(50)}))
    assert table.numbers("t") == pytest.approx(0.01 * np.arange(50), abs=2e-5)
    assert table.notes == (
        "t is in days, as spreadsheets and MATLAB count them: seconds since the first row are taken.",
    )


@pytest.mark.parametrize(
    ("seconds", "nanoseconds", "joined"),
    [
        ("stamp.sec", "stamp.nanosec", "stamp [ns]"),
        ("secs", "nsecs", "time [ns]"),
        ("header_stamp_secs", "header_stamp_nsecs", "header.stamp [ns]"),
        ("stamp.sec", "other.nanosec", ""),
        ("sec", "rpm", ""),
    ],
)
def test_seconds_and_nanoseconds_are_one_time(seconds: str, nanoseconds: str, joined: str) -> None:
    cells = {seconds: np.array([1.0, 1.0, 2.0]), nanoseconds: np.array([0.0, 5e8, 7.0]), "u": np.ones(3)}
    table = write_times_in_seconds(Table(Path("log.csv"), [2, 3, 4], cells))
    assert table.names == ([joined, "u"] if joined else [seconds, nanoseconds, "u"])
    if joined:
        assert table.nanoseconds(joined, 1).tolist() == [10**9, 15 * 10**8, 2 * 10**9 + 7]
        cells[nanoseconds][1] = 1e9  # none: a second has fewer
        assert write_times_in_seconds(Table(Path("log.csv"), [2, 3, 4], cells)).names == [seconds, nanoseconds, "u"]


@pytest.mark.parametrize(
    ("name", "cells", "period"),
    [
        ("fs", ["500", *[""] * 7], 0.002),  # in its first cell alone
        ("Fs", [10.0] * 8, 0.1),
        ("sample_rate", [1000.0] * 8, 0.001),
        ("Ts", [0.005] * 8, 0.005),
        ("Ts [ms]", [5.0] * 8, 0.005),
        ("fs", [0.2] * 8, None),  # a row in 5 s
        ("fs", [500.0, 500.0, *[400.0] * 6], None),
        ("fs", [-500.0] * 8, None),
        ("Ts", [5.0] * 8, None),  # of no unit
        ("gain", [500.0] * 8, None),
    ],
)
def test_a_column_that_says_how_often_rows_came(name: str, cells: list[object], period: float | None) -> None:
    given = Table(Path("log.csv"), np.arange(2, 10), {"u": np.ones(8), name: cells})
    spaced = space_evenly(given)
    if period is None:
        assert spaced is given
        return
    assert spaced.numbers("time [s]") == pytest.approx(np.arange(8) * period) and spaced.names == ["time [s]", "u"]
    note = f"No column of times: rows are {1e3 * period:g} ms apart, as {name} says (assumed)."
    assert spaced.notes == (note,)
    timed = Table(Path("log.csv"), np.arange(2, 10), {"t": np.arange(8.0), name: cells})
    assert space_evenly(timed) is timed


@pytest.mark.parametrize(("rate", "period"), [(500.0, 0.002), (500.4, 0.002), (501.0, None)])
def test_a_period_and_a_rate_that_agree_are_one(rate: float, period: float | None) -> None:
    cells = {"u": np.ones(8), "Ts": np.full(8, 0.002), "fs": np.full(8, rate)}
    given = Table(Path("log.csv"), np.arange(2, 10), cells)
    spaced = space_evenly(given)
    assert spaced.names == (["time [s]", "u"] if period else given.names)
    if period:
        assert spaced.numbers("time [s]") == pytest.approx(np.arange(8) * period)


@pytest.mark.parametrize(
    ("count", "sweeps", "asked"),
    [(101, 4, False), (101, 6, True), (150, 0, False), (250, 0, True)],
)
def test_a_drive_that_goes_to_and_fro_is_no_steady_curve(tmp_path: Path, count: int, sweeps: int, asked: bool) -> None:
    """Up and down twice is a steady curve, thrice is a wave; in any order, 250 are more than somebody takes by hand."""
    place = np.arange(count)
    volts = np.random.default_rng(3).uniform(0.0, 12.0, count)
    if sweeps:
        volts = 6.0 - 6.0 * np.cos(np.pi * sweeps * place / (count - 1)) + 1e-4 * place
    path = tmp_path / "log.csv"
    path.write_text("\n".join(["u,speed [rad/s]", *(f"{u:.5f},{5 * u:.5f}" for u in volts)]) + "\n")
    if asked:
        with pytest.raises(RecordingError, match=r"u goes to and fro, .*--sample-period S .*; or --steady\."):
            import_log(path, Said())
    else:
        assert any("--time, or --sample-period" in line for line in import_log(path, Said()).findings)
    assert import_log(path, Said(steady=True)).motors


@pytest.mark.parametrize(
    ("name", "bare", "period"),
    [
        ("rpm (dt=10ms)", "rpm", 0.01),
        ("rpm dt = 0.005", "rpm", 0.005),
        ("rpm [Ts=20]", "rpm", 0.02),  # no motor is logged every 20 s
        ("rpm; dt=500us", "rpm", 0.0005),
        ("rpm (dt)", "rpm (dt)", None),
        ("width=10", "width=10", None),
    ],
)
def test_a_name_that_says_how_often_rows_came(name: str, bare: str, period: float | None) -> None:
    given = Table(Path("log.csv"), np.arange(2, 10), {"u": np.ones(8), name: np.arange(8.0)})
    spaced = space_evenly(sum_steps(take_periods_out(given)))
    times = [] if period is None else [spaced.names[0]]
    assert spaced.names == [*times, "u", bare]
    if period is not None:
        unit = {"time [s]": 1.0, "time [ms]": 1e-3, "time [us]": 1e-6}[spaced.names[0]]
        assert spaced.numbers(spaced.names[0]) * unit == pytest.approx(np.arange(8) * period)
    timed = Table(Path("log.csv"), np.arange(2, 10), {"t": np.arange(8.0), name: np.arange(8.0)})
    assert take_periods_out(timed).names == ["t", bare]


def test_an_empty_column_that_is_called_by_its_period(tmp_path: Path) -> None:
    path = tmp_path / "log.csv"
    path.write_text("u,y,dt=10\n" + "".join(f"{3.0 * (k // 40 % 2)},{0.01 * (k % 7)},\n" for k in range(400)))
    (motor,) = import_log(path, Said(unit="rad/s")).motors
    assert motor.log.info.sample_period == pytest.approx(0.01)


def test_a_log_with_its_sampling_rate_is_read_without_an_option(tmp_path: Path) -> None:
    rows = [f"{3.0 * (k // 40 % 2)},{5.0 * (k // 40 % 2) + 0.01 * (k % 7)}" for k in range(400)]
    path = tmp_path / "log.csv"
    path.write_text("\n".join(["u,y,fs", f"{rows[0]},500", *(f"{row}," for row in rows[1:])]) + "\n")
    (motor,) = import_log(path, Said(unit="rad/s")).motors
    assert motor.log.info.sample_period == pytest.approx(0.002)
    with pytest.raises(RecordingError, match="no column is its times"):
        path.write_text("\n".join(["u,y", *rows]) + "\n")
        import_log(path, Said(unit="rad/s"))
