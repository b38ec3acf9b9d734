"""One motor's log as different people and programs write it: each is read as the plain table, or asks one question."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from motor_identification.logs.columns.said import Said
from motor_identification.logs.imported import Imported, import_log
from motor_model.errors import RecordingError
from motor_model.gearing.gear import parse_gear_ratio

ROWS = 400
MS = 10 * np.arange(ROWS)
DUTY = np.repeat(np.array([0, 60, 200, -90, 255, -255, 120, 0]), ROWS // 8)
BEFORE = np.concatenate((np.zeros(41), DUTY[:-1]))  # a row's duty drives the motor from then on
RPM = np.round(np.convolve(BEFORE, np.exp(-np.arange(41) / 8.0) / 8.0, "valid"), 1)
COUNT = np.cumsum(np.rint(RPM)).astype(np.int64)
SAID = Said(supply_voltage=12.0, unit="rpm")
COUNTS = Said(supply_voltage=12.0, edges_per_revolution=1440)


def imported(folder: Path, text: str, said: Said) -> Imported:
    (folder / "log.csv").write_text(text)
    return import_log(folder / "log.csv", said)


def column(one: Imported, name: str) -> NDArray[np.float64]:
    return np.array([getattr(sample, name) for run in one.motors[0].log.runs for sample in run.samples])


def clock(ms: int, form: str = "{:02d}:{:02d}:{:02d}.{:03d}") -> str:
    ms += 43_383_123
    return form.format(ms // 3_600_000, ms // 60_000 % 60, ms // 1000 % 60, ms % 1000)


def table(row: Callable[[int], str], *before: str, **at: str) -> str:
    """A line for each row; those of `at` come before the rows of these numbers."""
    lines = [line for k in range(ROWS) for line in (at.get(f"row{k}"), row(k)) if line is not None]
    return "\n".join((*before, *lines)) + "\n"


def plain(k: int) -> str:
    return f"{MS[k]},{DUTY[k]},{RPM[k]}"


def german(value: float) -> str:
    return f"{value:,.2f}".translate(str.maketrans(",.", ".,"))


ODD = {
    "serial monitor": table(lambda k: f"{clock(MS[k])} -> {DUTY[k]},{RPM[k]}"),
    "serial monitor with names": table(lambda k: f"{clock(MS[k])} -> {DUTY[k]}\t{RPM[k]}", "12:03:03.000 -> pwm\trpm"),
    "serial plotter": table(lambda k: f"t_ms:{MS[k]}\tpwm:{DUTY[k]}\trpm:{RPM[k]}", "Motor test ready"),
    "names in every row": table(lambda k: f"t_ms={MS[k]}, pwm={DUTY[k]}, rpm={RPM[k]}"),
    "names again": table(plain, "ms,pwm,rpm", row150="ms,pwm,rpm"),
    "comments between": table(plain, "# 37D motor", "# ms,pwm,rpm", row100="# battery changed", row300="// end"),
    "separator at the end": table(lambda k: plain(k) + ",", "ms,pwm,rpm"),
    "separator at both ends": table(lambda k: plain(k) + ",", "ms,pwm,rpm,"),
    "thousands": table(lambda k: f"{MS[k]};{DUTY[k]};{german(100.0 * RPM[k])}", "ms;pwm;cent rpm [rpm]"),
    "time zone": table(lambda k: f"2024-05-06T{clock(MS[k])}+02:00,{DUTY[k]},{RPM[k]}", "timestamp,pwm,rpm"),
    "month first": table(lambda k: f"05/16/2024 {clock(MS[k])} PM,{DUTY[k]},{RPM[k]}", "Date Time,pwm,rpm"),
    "commas in quotes": table(
        lambda k: f'"{MS[k] / 1e3:.2f}","{DUTY[k]}","{RPM[k]:.1f}"'.replace(".", ","), "s,pwm,rpm"
    ),
    "units in the cells": table(lambda k: f"{MS[k] / 1e3:.2f} sec,{DUTY[k]},{RPM[k]} rpm", "Time,pwm,speed"),
    "names of months": table(lambda k: f"03-May-2024 {clock(MS[k])},{DUTY[k]},{RPM[k]}", "Time,pwm,rpm"),
    "time since the beginning": table(
        lambda k: f"0 days 00:00:{MS[k] / 1e3:09.6f},{DUTY[k]},{RPM[k]}", "elapsed,pwm,rpm"
    ),
    "minutes and seconds": table(
        lambda k: f"{58 + (MS[k] + 57_000) // 60_000}:{(MS[k] + 57_000) % 60_000 / 1e3:06.3f},{DUTY[k]},{RPM[k]}",
        "time,pwm,rpm",
    ),
    "days of a spreadsheet": table(
        lambda k: f"{45_413.5 + MS[k] / 86_400e3:.11f},{DUTY[k]},{RPM[k]}", "Timestamp,pwm,rpm"
    ),
    "seconds and nanoseconds": table(
        lambda k: f"{1_760_000_000 + MS[k] // 1000},{MS[k] % 1000 * 10**6},{DUTY[k]},{RPM[k]}",
        "header.stamp.sec,header.stamp.nanosec,pwm,rpm",
    ),
    "whole centiseconds in us": table(lambda k: f"{1000 * MS[k]},{DUTY[k]},{RPM[k]}", "time,pwm,rpm"),
    "a drive for each way": table(
        lambda k: f"{MS[k]},{max(DUTY[k], 0)},{max(-DUTY[k], 0)},{RPM[k]}", "ms,pwm_fwd,pwm_rev,rpm"
    ),
    "names and units in every row": table(lambda k: f"t: {MS[k]} ms, PWM: {DUTY[k]}, speed: {RPM[k]} rpm"),
    "an ESP32's log": table(lambda k: f"I ({5310 + MS[k]}) motor: pwm={DUTY[k]} rpm={RPM[k]}", "boot: ready"),
    "an ESP32's log in colours": table(
        lambda k: f"\x1b[0;32mI ({5310 + MS[k]}) motor: pwm: {DUTY[k]}, rpm: {RPM[k]}\x1b[0m"
    ),
    "Python's logging": table(
        lambda k: f"2024-05-06 {clock(MS[k]).replace('.', ',')} - INFO - pwm={DUTY[k]} rpm={RPM[k]}"
    ),
    "a matrix": "Sample   Time [ms]   Motor PWM   Wheel rpm\n\n["
    + ";\n".join(f"{k:5d} {MS[k]:6d} {DUTY[k]:5d} {RPM[k]:8.1f}" for k in range(ROWS))
    + "]\n",
    "semicolons at the end": table(lambda k: plain(k) + ";", "ms,pwm,rpm;"),
    "a line for each column": "".join(
        f"{name},{','.join(map(str, column))}\n" for name, column in {"ms": MS, "pwm": DUTY, "rpm": RPM}.items()
    ),
    "milliseconds since 1970": table(lambda k: f"{1_760_000_000_000 + MS[k]},{DUTY[k]},{RPM[k]}", "timestamp,pwm,rpm"),
    "microseconds since 1970, newest first": "time,pwm,rpm\n"
    + "".join(f"{1_760_000_000_000_000 + 1000 * MS[k]},{DUTY[k]},{RPM[k]}\n" for k in reversed(range(ROWS))),
    "seconds called ms": table(lambda k: f"{1.76e9 + MS[k] / 1e3:.3f},{DUTY[k]},{RPM[k]}", "timestamp(ms),pwm,rpm"),
    "a computer's clock beside the board's": table(
        lambda k: f"{1.76e9 + MS[k] / 1e3 + 0.003 * (k % 3):.3f},{DUTY[k]},{RPM[k]},{MS[k]}", "timestamp,pwm,rpm,Time"
    ),
    "dates beside the board's clock": table(
        lambda k: f"2026-05-01T{clock(MS[k] + 2 * (k % 3))},{DUTY[k]},{RPM[k]},{MS[k]}", "iso_time,pwm,rpm,time"
    ),
    "comments at the end": table(plain, "ms,pwm,rpm") + "# done\n# 400 rows\n\n// battery 11.9 V, bye\n",
    "another table behind": table(plain, "ms,pwm,rpm") + "21.278\n" * 200,
    "newest first": "ms,pwm,rpm\n" + "\n".join(plain(k) for k in reversed(range(ROWS))) + "\n",
    "full clock": table(lambda k: f"{(2**32 - 2000 + MS[k]) % 2**32},{DUTY[k]},{RPM[k]}", "millis,pwm,rpm"),
    "full clock of 16 bits": table(lambda k: f"{(2**16 - 2000 + MS[k]) % 2**16},{DUTY[k]},{RPM[k]}", "ms,pwm,rpm"),
    "midnight": table(
        lambda k: f"{clock((MS[k] + 43_014_877) % 86_400_000 - 43_383_123)},{DUTY[k]},{RPM[k]}", "t,pwm,rpm"
    ),
    "block of settings": table(
        lambda k: f"{MS[k]}\t{DUTY[k]}\t{RPM[k]}\t",
        "Writer\t2",
        "Reader\t2",
        "Tab\t.",
        "X0\t0.0\t0.0",
        "ms\tpwm\trpm\tComment",
    ),
    "JSON lines": table(lambda k: f'{{"ms": {MS[k]}, "motor": {{"pwm": {DUTY[k]}, "rpm": {RPM[k]}}}, "on": true}}'),
}


@pytest.mark.parametrize("name", ODD)
def test_it_is_read_as_the_plain_table(tmp_path: Path, name: str) -> None:
    found = imported(tmp_path, ODD[name], SAID)
    assert len(found.motors) == len(found.motors[0].log.runs) == 1
    times = column(found, "sample_time")
    assert np.allclose((times - times[0]) * 1e-6, MS, atol=1e-3)
    assert np.allclose(column(found, "voltage"), DUTY / 255.0 * 12.0)
    rpm = column(found, "speed") * 30.0 / np.pi
    assert np.allclose(rpm, RPM * (100.0 if name == "thousands" else 1.0), atol=0.05)


def test_a_few_garbled_rows_are_left_out_and_many_refused(tmp_path: Path) -> None:
    lines = table(plain, "ms,pwm,rpm").split("\n")
    few = [*lines]
    few[200], few[250], few[300] = "1990,60,120,60,1.5", "24", "2990,120,nan"
    found = imported(tmp_path, "\n".join(few), SAID)
    times = column(found, "sample_time") / 1e6
    assert sorted(set(MS) - set(np.rint(times - times[0]).astype(int))) == [1990, 2490, 2990]
    said = "\n".join(found.findings)
    assert "Left out: line 201 with more cells than columns are named (3)." in said
    assert "Left out: 2 rows with a cell that is no number (the first is line 251, column pwm: '')." in said
    many = [*lines]
    many[200:205] = ["1990,60,1x"] * 5  # of 400
    with pytest.raises(RecordingError, match="line 201, column rpm: '1x' is not a number"):
        imported(tmp_path, "\n".join(many), SAID)
    many[200:205] = ["1990,60,1,2"] * 5
    with pytest.raises(RecordingError, match="line 201 has more cells than columns"):
        imported(tmp_path, "\n".join(many), SAID)


def test_remarks_beside_the_table_are_left_out(tmp_path: Path) -> None:
    lines = table(plain, "ms,pwm,rpm").split("\n")
    remarked = [*lines[:1], *(f"{line},,slipped" if k % 10 > 5 else line for k, line in enumerate(lines[1:]) if line)]
    found, without = (imported(tmp_path, "\n".join(one), SAID) for one in (remarked, lines))
    assert np.array_equal(column(found, "speed"), column(without, "speed"))
    assert "Left out: words behind the last named column, in 160 lines (the first is 8)." in "\n".join(found.findings)


@pytest.mark.parametrize("words", [("CW", "CCW"), ("1", "0"), ("0", "1"), ("fwd", "rev"), ("1", "-1")])
def test_a_direction_beside_a_duty_without_sign(tmp_path: Path, words: tuple[str, str]) -> None:
    text = table(lambda k: f"{MS[k]},{abs(DUTY[k])},{words[int(DUTY[k] < 0)]},{COUNT[k]}", "ms,pwm,dir,count")
    found = imported(tmp_path, text, COUNTS)
    assert np.allclose(column(found, "voltage"), DUTY / 255.0 * 12.0)
    assert f"backward where dir is {words[1]}" in "\n".join(found.findings)
    without = imported(tmp_path, text, Said(**{**COUNTS.__dict__, "direction": "-"}))
    assert np.all(column(without, "voltage") >= 0.0)
    assert "Caution: the voltage has no sign" in "\n".join(without.motors[0].log.findings)


def test_a_direction_that_the_motion_does_not_show_is_asked_about(tmp_path: Path) -> None:
    text = table(lambda k: f"{MS[k]},{abs(DUTY[k])},{int(DUTY[k] < 0)},{abs(RPM[k])}", "ms,pwm,dir,rpm")
    with pytest.raises(RecordingError, match="dir says which way pwm goes, and rpm does not turn with it"):
        imported(tmp_path, text, SAID)


@pytest.mark.parametrize(("name", "why"), [("delta_ticks", "by its name"), ("ticks", "it follows the drive")])
def test_counts_that_begin_anew_in_every_row(tmp_path: Path, name: str, why: str) -> None:
    text = table(lambda k: f"{MS[k]},{DUTY[k]},{np.diff(COUNT, prepend=0)[k]}", f"ms,pwm,{name}")
    found = imported(tmp_path, text, COUNTS)
    assert np.array_equal(column(found, "edge_count"), COUNT)
    assert f"{name} counts anew in every row ({why}" in "\n".join(found.findings)
    going_on = imported(tmp_path, table(lambda k: f"{MS[k]},{DUTY[k]},{COUNT[k]}", f"ms,pwm,{name[-5:]}"), COUNTS)
    assert np.array_equal(column(going_on, "edge_count"), COUNT)


def test_input_and_output_of_a_loop_and_of_a_motor(tmp_path: Path) -> None:
    loop = table(lambda k: f"{MS[k]},100,{RPM[k]},{DUTY[k]}", "ms,Setpoint,Input,Output")
    motor = table(lambda k: f"{MS[k]},{DUTY[k]},{RPM[k]}", "ms,input,output")
    for text in (loop, motor):
        found = imported(tmp_path, text, SAID)
        assert np.allclose(column(found, "voltage"), DUTY / 255.0 * 12.0)


def test_missing_rows_leave_the_stamps_of_the_others_alone(tmp_path: Path) -> None:
    """Rows at 10 ms whose stamps are multiples of 10 ms are right; those rounded to 10 ms come at even distances."""
    lost = {57, 58, 171, 330}
    text = "\n".join(["ms,pwm,rpm", *(plain(k) for k in range(ROWS) if k not in lost)])
    times = column(imported(tmp_path, text, SAID), "sample_time") / 1e6
    assert set(np.rint(times).astype(int)) == set(MS) - {10 * k for k in lost}
    slow = "\n".join(["ms,pwm,rpm", *(f"{int(1.01 * k) * 10},{DUTY[k]},{RPM[k]}" for k in range(ROWS))])
    assert np.allclose(np.diff(column(imported(tmp_path, slow, SAID), "sample_time") / 1e6), 10.1, atol=0.05)


@pytest.mark.parametrize("ratio", ["34.014", "1"])
def test_counts_of_a_geared_motor_are_angles_of_its_output(tmp_path: Path, ratio: str) -> None:
    gear = parse_gear_ratio(ratio)
    counts = Said(supply_voltage=12.0, edges_per_revolution=44, gear=gear)
    found = imported(tmp_path, table(lambda k: f"{MS[k]},{DUTY[k]},{COUNT[k]}", "ms,pwm,ticks"), counts)
    info, turned = found.motors[0].log.info, column(found, "speed")
    assert (info.edges_per_revolution, info.gear) == (44, gear)
    assert np.sum(turned) * 0.01 == pytest.approx(COUNT[-1] * 2.0 * np.pi / 44 / float(gear), rel=0.02)
    rates = table(lambda k: f"{MS[k]},{DUTY[k]},{np.diff(COUNT, prepend=0)[k] * 100}", "ms,pwm,speed [count/s]")
    assert np.allclose(np.sum(column(imported(tmp_path, rates, counts), "speed")), np.sum(turned), rtol=0.02)
    degrees = table(lambda k: f"{MS[k]},{DUTY[k]},{COUNT[k] * 360.0 / 44 / float(gear):.9f}", "ms,pwm,angle [deg]")
    again = imported(tmp_path, degrees, counts)
    assert np.array_equal(column(again, "edge_count"), COUNT) and np.allclose(column(again, "speed"), turned)


def test_lines_behind_the_rows_are_another_table_or_comments(tmp_path: Path) -> None:
    found = imported(tmp_path, ODD["another table behind"], SAID)
    assert "Left out: the lines from 402 on, which have fewer than half of the cells of those before." in found.findings
    said = imported(tmp_path, ODD["comments at the end"], SAID).findings
    assert "Left out: 3 lines (the first is 402) without a number (comments, names of columns)." in said


def test_two_senders_in_one_table(tmp_path: Path) -> None:
    """As programs write that merge topics by time: a row has the duty or the speed."""
    text = table(lambda k: f"{MS[k]},,{RPM[k]}\n{MS[k] + 3},{DUTY[k]},", "ms,pwm,rpm", row0=f"0,{DUTY[0]},")
    found = imported(tmp_path, text, SAID)
    assert np.allclose(column(found, "speed") * 30.0 / np.pi, RPM, atol=0.05)
    assert np.allclose(column(found, "voltage"), DUTY / 255.0 * 12.0)  # 3 of 10 ms late
    said = "\n".join(found.motors[0].log.findings)
    assert "rpm has a value in 400 of 801 rows: those rows are taken." in said
    assert "pwm has a value in 401 of 801 rows: it holds until the next." in said


def test_rows_of_a_wide_table_may_be_mostly_empty(tmp_path: Path) -> None:
    """A column for each of many topics, and in each row the values of one."""
    names = "time,/imu:x,/imu:y,/imu:z,/bat:v,/cmd:pwm,/wheel:rpm,/gps:a,/gps:b,/gps:c"
    text = table(lambda k: f"{MS[k]},,,,,{DUTY[k]},,,,\n{MS[k] + 3},,,,,,{RPM[k]},,,", names)
    found = imported(tmp_path, text, Said(**{**SAID.__dict__, "voltage": "/cmd:pwm", "full_duty": 255.0}))
    assert np.allclose(column(found, "speed") * 30.0 / np.pi, RPM, atol=0.05)
    assert np.allclose(column(found, "voltage"), DUTY / 255.0 * 12.0)


def test_the_rounding_of_printed_digits_is_no_odd_count(tmp_path: Path) -> None:
    """Angles of 4096 counts a turn with two digits are up to 0.057 counts beside whole ones."""
    angle = np.round(COUNT * 360.0 / 4096, 2)
    text = table(lambda k: f"{MS[k]},{DUTY[k]},{angle[k]:.2f}", "ms,pwm,angle [deg]")
    found = imported(tmp_path, text, Said(supply_voltage=12.0))
    assert np.array_equal(column(found, "edge_count"), COUNT) and found.motors[0].log.info.edges_per_revolution == 4096
    assert "whole counts" not in "\n".join(found.motors[0].log.findings)
    beside = table(lambda k: f"{MS[k]},{DUTY[k]},{angle[k] + 0.02 * (k % 2):.2f}", "ms,pwm,angle [deg]")
    odd = imported(tmp_path, beside, Said(supply_voltage=12.0, edges_per_revolution=4096))
    assert "Caution: values are up to 0.2" in "\n".join(odd.motors[0].log.findings)
