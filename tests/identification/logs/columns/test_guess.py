"""Whole forms out of tables: what was guessed, what was said, what is asked."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.columns.guess import guess_forms
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.csv.reader import read_table
from motor_identification.logs.form import CsvForm, Kind
from motor_model.errors import RecordingError

DATA = Path(__file__).resolve().parents[3] / "data"


def guess(name: str, **said: object) -> tuple[CsvForm, ...]:
    return guess_forms(read_table(DATA / name), Said(**said)).forms  # type: ignore[arg-type]


def test_single_letters_with_an_encoders_steps() -> None:
    (form,) = guess("undc/prbs_2026-08-14.csv")
    assert form == CsvForm("t", "u", "y", Kind.SPEED, "deg/s")
    (profile,) = guess("undc/profile_closed_2026-08-18.csv")
    assert (profile.motion, profile.kind, profile.unit) == ("y", Kind.POSITION, "deg")


def test_spanish_names_and_a_duty_beside_the_voltage() -> None:
    (form,) = guess("esp32/step_response.csv")
    assert (form.time, form.voltage, form.motion, form.unit) == (
        "Tiempo (s)",
        "Voltaje (V)",
        "Velocidad (rad/s)",
        "rad/s",
    )


def test_a_battery_in_millivolts_and_a_static_curve_of_two_wheels() -> None:
    left, right = guess("micromouse/wheelSpeedCalibration3.csv")
    assert (left.time, left.voltage, left.motion, left.unit, left.label) == (
        None,
        "motorCommand",
        "leftSpeedRpm",
        "rpm",
        "left",
    )
    assert (left.supply, left.supply_scale, left.voltage_scale) == ("batteryVoltage", 1e-3, 1.0 / 255.0)
    assert replace(left, motion="", label="", name="") == replace(right, motion="", label="", name="")


def test_duties_of_runs_that_begin_from_rest() -> None:
    with pytest.raises(RecordingError, match=r"duty_pct as a duty in %: say the voltage at full duty"):
        guess("ev3/steps_1s.csv")
    (form,) = guess("ev3/steps_1s.csv", supply_voltage=7.4)
    assert form.voltage_scale == pytest.approx(0.074) and form.max_voltage == 7.4
    assert (form.unit, form.kind, form.rest_until) == ("deg", Kind.POSITION, 0.0)


def test_all_that_cannot_be_told_is_asked_at_once() -> None:
    with pytest.raises(RecordingError) as caught:
        guess("micromouse/testPid3.csv")
    text = str(caught.value)
    assert text.count("--supply-voltage") == 1 and text.count("--unit") == 1 and "\n" not in text
    assert "deg/s or rpm" in text and text.endswith(".")
    left, right = guess("micromouse/testPid3.csv", supply_voltage=7.9, unit="rpm")
    assert (left.time_unit, left.unit, right.motion) == ("s", "rpm", "rightSpeed")
    assert guess("micromouse/testPid1.csv", supply_voltage=7.9, unit="rpm")[0].time_unit == "ms"


def test_every_guess_is_said_with_the_option_that_corrects_it() -> None:
    found = guess_forms(read_table(DATA / "undc/prbs_2026-08-14.csv"), Said()).findings
    assert [line.split(":")[0] for line in found] == ["Time", "Voltage", "Motion"]
    for line, option in zip(found, ("--time-unit", "--voltage-scale", "--unit"), strict=True):
        assert option in line
    said = Said(time="t", time_unit="s", voltage_scale=1.0, motion="y", kind=Kind.SPEED, unit="deg/s")
    assert "assumed" not in " ".join(guess_forms(read_table(DATA / "undc/prbs_2026-08-14.csv"), said).findings)


@pytest.mark.parametrize(("first", "rest"), [(5.9, 0.0), (6.1, None)])
def test_a_clock_that_begins_shortly_before_the_first_row(tmp_path: Path, first: float, rest: float | None) -> None:
    """Less than six sample periods before it."""
    times = 0.01 * (first + np.arange(30))
    rows = [f"{time:.4f},{volts},{k}" for volts in (3, 5) for k, time in enumerate(times)]
    (tmp_path / "log.csv").write_text("\n".join(["t,u,pos_deg", *rows]))
    assert guess_forms(read_table(tmp_path / "log.csv"), Said()).forms[0].rest_until == rest


@pytest.mark.parametrize(
    ("rows", "step", "each", "unit"),
    [(26, 1099, 1, "ms"), (100, 1099, 1, "ms"), (101, 1099, 1, "us"), (26, 5001, 1, "us"), (26, 1099, 5, "us")],
)
def test_few_rows_of_a_level_each_are_a_static_curve(
    tmp_path: Path, rows: int, step: int, each: int, unit: str
) -> None:
    """A second apart by a board's milliseconds: in microseconds a motor had come to its speed within a row."""
    lines = [f"{42300 + step * k},{10 * (k // each)},{8.0 * (k // each)}" for k in range(rows)]
    (tmp_path / "log.csv").write_text("\n".join(["time,command,speedRpm", *lines]) + "\n")
    guess = guess_forms(read_table(tmp_path / "log.csv"), Said(full_duty=1000.0, supply_voltage=7.4))
    assert f"Time: time in {unit} (" in "".join(guess.findings) and (guess.forms[0].time is None) == (unit == "ms")


@pytest.mark.parametrize(("period", "steady"), [(0.39, False), (0.41, True)])
def test_rows_far_apart_with_a_voltage_each_are_steady_states(tmp_path: Path, period: float, steady: bool) -> None:
    rows = [f"{period * k + 0.001:.4f},{k % 7 + 1},{10 * (k % 7)}" for k in range(40)]
    (tmp_path / "log.csv").write_text("\n".join(["t [s],u,speed [rpm]", *rows]))
    assert (guess_forms(read_table(tmp_path / "log.csv"), Said()).forms[0].time is None) == steady


@pytest.mark.parametrize(
    ("target", "steady"),
    [("100", False), ("{k}", True), ("0", True)],  # held; a curve's own; of no controller
)
def test_rows_far_apart_under_a_controller_are_no_steady_states(tmp_path: Path, target: str, steady: bool) -> None:
    rows = [f"{k},{target.format(k=k)},{k % 7 + 1},{95 + 5 * k % 11}" for k in range(40)]
    (tmp_path / "log.csv").write_text("\n".join(["t [s],Setpoint,u,speed [rpm]", *rows]))
    guess = guess_forms(read_table(tmp_path / "log.csv"), Said())
    assert (guess.forms[0].time is None) == steady
    assert any("Caution: rows are 1 s apart, and a controller" in line for line in guess.findings) != steady


@pytest.mark.parametrize(
    ("name", "step", "unit"),
    [("time_us", 5e-4, "s"), ("time_us", 1000.0, "us"), ("t_ms", 9e-4, "s"), ("t_ms", 0.01, "ms")],
)
def test_times_called_microseconds_that_are_seconds(name: str, step: float, unit: str, tmp_path: Path) -> None:
    path = tmp_path / "log.csv"
    rows = [f"{step * k:.6f},{0 if k < 50 else 160},{max(k - 60, 0) / 7:.5f}" for k in range(200)]
    path.write_text("\n".join([f"{name},pwm,w", *rows]))
    made = guess_forms(read_table(path), Said(supply_voltage=8.0, unit="rad/s"))
    assert made.forms[0].time_unit == unit
    said = (
        f"Time: {name} in s (whatever its name says: rows are then {1e3 * step:.4g} ms apart; otherwise: --time-unit)."
    )
    assert (said in made.findings) == (unit == "s")


def test_what_is_more_than_volts_and_has_no_name_is_asked(tmp_path: Path) -> None:
    k = np.arange(300)
    rows = [f"{0.01 * n:.2f} {190 * np.sin(n // 30):.3f} {np.sin(0.11 * n) + 0.3 * (n % 3):.3f}" for n in k]
    (tmp_path / "log.txt").write_text("\n".join(rows))
    with pytest.raises(RecordingError, match="column 2 goes up to 188, more than a motor's volts: say which column"):
        guess_forms(read_table(tmp_path / "log.txt"), Said(unit="rad/s"))
    assert guess_forms(read_table(tmp_path / "log.txt"), Said(unit="rad/s", voltage_scale=0.1)).forms


def test_times_that_count_by_a_rate_are_asked_for_it(tmp_path: Path) -> None:
    rows = [f"{45 * n},{n // 30 % 2},{n % 9}.5" for n in range(300)]
    (tmp_path / "log.csv").write_text("\n".join(["timestep (8 kHz),voltage,speed [rpm]", *rows]))
    with pytest.raises(RecordingError, match="counts by a rate: say how many seconds one is"):
        guess_forms(read_table(tmp_path / "log.csv"), Said())
    (form,) = guess_forms(read_table(tmp_path / "log.csv"), Said(time_unit="0.000125")).forms
    assert (form.time, form.time_unit) == ("timestep (8 kHz)", "0.000125")


def test_electrical_turns_are_told(tmp_path: Path) -> None:
    rows = [f"{20 * n},{(n // 30 % 3 - 1) * 0.5},{n % 9 * 7}" for n in range(300)]
    (tmp_path / "log.csv").write_text("\n".join(["ms_today,duty_cycle,erpm", *rows]))
    found = guess_forms(read_table(tmp_path / "log.csv"), Said(supply_voltage=12.0))
    assert any("erpm, a speed in rpm (of electrical turns" in line for line in found.findings)


@pytest.mark.parametrize(
    ("name", "first", "step", "rows", "unit"),
    [
        ("Time", 22754, 503.0, 0, "ms"),  # a speed that is there in the next row, of 0.5 ms
        ("Time", 22754, 503.0, 20, "us"),
        ("Time", 0, 0.5, 0, "s"),
        ("Time", 0, 0.5, 20, "ms"),
        ("Time", 22754, 5003.0, 0, "us"),
        ("Time [us]", 22754, 503.0, 0, "us"),
    ],
)
def test_a_motion_that_answers_at_once_tells_the_unit_of_its_times(
    name: str, first: int, step: float, rows: int, unit: str, tmp_path: Path
) -> None:
    times = [first + step * k + (k % 3 if step > 1.0 else 0) for k in range(120)]
    speeds = [0.0 if k < 40 else 49.0 * (1.0 - np.exp(-(k - 40) / rows) if rows else 1.0) for k in range(120)]
    lines = [f"{times[k]:.1f},{0 if k < 40 else 75},{speeds[k] + 0.1 * (k % 3):.1f}" for k in range(120)]
    (tmp_path / "log.csv").write_text("\n".join([f"{name},pwm,speed [rpm]", *lines]))
    guess = guess_forms(read_table(tmp_path / "log.csv"), Said(supply_voltage=12.0, full_duty=100.0))
    assert guess.forms[0].time_unit == unit
    told = "no motor answers as soon; otherwise: --time-unit)" in "".join(guess.findings)
    assert told is (rows == 0 and unit != "us")


@pytest.mark.parametrize(("name", "unit"), [("dcount", "us"), ("speed [rpm]", "ms")])
def test_counts_of_each_row_do_not_tell_it(name: str, unit: str, tmp_path: Path) -> None:
    """Their differences answer at once, as a torque does."""
    lines = [f"{22754 + 503 * k + k % 3},{0 if k < 40 else 75},{0 if k < 40 else 40 + k % 2}" for k in range(120)]
    (tmp_path / "log.csv").write_text("\n".join([f"Time,pwm,{name}", *lines]))
    said = Said(supply_voltage=12.0, full_duty=100.0, edges_per_revolution=2000)
    assert guess_forms(read_table(tmp_path / "log.csv"), said).forms[0].time_unit == unit


@pytest.mark.parametrize(("drives", "asked"), [((0, 0), "is 0 in every row: check --voltage"), ((0, 1), "say the")])
def test_a_drive_that_is_0_is_refused_before_anything_is_asked(
    drives: tuple[int, int], asked: str, tmp_path: Path
) -> None:
    rows = [f"{0.02 * k:.2f},{drives[k // 60]},{0.1 * (k % 7):.1f}" for k in range(120)]
    (tmp_path / "log.csv").write_text("\n".join(["t [s],Control,speed", *rows]))
    with pytest.raises(RecordingError, match=asked):
        guess_forms(read_table(tmp_path / "log.csv"), Said())


@pytest.mark.parametrize(
    ("drive", "moves", "asked"),
    [(0, 1, "a_effort and b_effort are 0 in every row: check --voltage"), (1, 1, "b_effort as a duty")],
)
def test_of_axes_that_are_not_driven_nothing_is_asked(drive: int, moves: int, asked: str, tmp_path: Path) -> None:
    """One that is, is the motor; where none is, that is said first, whichever moves."""
    rows = [f"{0.02 * k:.2f},0,7,{drive * (k // 20 % 2)},{moves * (k % 7)}.5" for k in range(120)]
    (tmp_path / "log.csv").write_text("\n".join(["t [s],a_effort,a_position,b_effort,b_position", *rows]))
    with pytest.raises(RecordingError, match=asked) as told:
        guess_forms(read_table(tmp_path / "log.csv"), Said())
    if drive:
        assert "a_" not in str(told.value).partition("log.csv")[2]
        guess = guess_forms(read_table(tmp_path / "log.csv"), Said(supply_voltage=12.0, unit="rad"))
        assert [form.motion for form in guess.forms] == ["b_position"]
        assert guess.findings[-1] == "Left out: motor a, which is not driven and hardly moves."


def test_an_axis_that_is_not_driven_but_moves_is_one(tmp_path: Path) -> None:
    rows = [f"{0.02 * k:.2f},0,{k % 5}.5,{k // 20 % 2},{k % 7}.5" for k in range(120)]
    (tmp_path / "log.csv").write_text("\n".join(["t [s],a_effort,a_position,b_effort,b_position", *rows]))
    assert len(guess_forms(read_table(tmp_path / "log.csv"), Said(supply_voltage=12.0, unit="rad")).forms) == 2


def test_motors_that_the_user_names_are_not_left_out_where_they_stand(tmp_path: Path) -> None:
    rows = [f"{0.02 * k:.2f},0,7,{k // 20 % 2},{k % 7}.5" for k in range(120)]
    (tmp_path / "log.csv").write_text("\n".join(["t [s],a_effort,a_position,b_effort,b_position", *rows]))
    both = (Pair("a", "a_effort", "a_position"), Pair("b", "b_effort", "b_position"))
    guess = guess_forms(read_table(tmp_path / "log.csv"), Said(motors=both, supply_voltage=12.0, unit="rad"))
    assert [form.motion for form in guess.forms] == ["a_position", "b_position"]
    assert not any("Left out" in line for line in guess.findings)


@pytest.mark.parametrize("held", ["load_current_setpoint_A", "ref_voltage [V]", "speed limit setpoint", "target_rpm"])
def test_a_static_curve_beside_what_is_held_is_one_of_steady_states(held: str, tmp_path: Path) -> None:
    rows = [f"{2 * k},0.5,{1 + 0.2 * k:.2f},{10 + 4 * k}" for k in range(40)]
    (tmp_path / "log.csv").write_text("\n".join([f"time_s,{held},voltage [V],speed [rad/s]", *rows]))
    guess = guess_forms(read_table(tmp_path / "log.csv"), Said())
    assert guess.forms[0].time is None and not any("Caution" in line for line in guess.findings)
