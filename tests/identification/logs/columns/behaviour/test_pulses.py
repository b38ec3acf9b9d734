"""Pulses of a model's motor controller as shares of the supply, by where the motor stands."""

from pathlib import Path

import numpy as np
import pytest
from log_columns import answer, columns
from numpy.typing import NDArray

from motor_identification.logs.columns.behaviour.pulses import read_pulses
from motor_identification.logs.columns.said import Said
from motor_identification.logs.imported import import_log
from motor_model.errors import RecordingError

Floats = NDArray[np.float64]

TIME = np.arange(200) * 0.02


def levels(seed: int, least: float) -> Floats:
    """Shares of the supply for a second each, from the least to 1, after a second of rest."""
    shares = np.repeat(np.random.default_rng(seed).uniform(least, 1.0, 4), 50)
    return np.where(np.arange(200) < 50, 0.0, shares)


@pytest.mark.parametrize("seed", range(4_340_000, 4_340_006))
@pytest.mark.parametrize("name", ["ESC signal (µs)", "pwm_us", "esc"])
def test_pulses_from_where_the_motor_stands(name: str, seed: int) -> None:
    share = levels(seed, 0.2)
    moved = 900.0 * np.abs(answer(share)) * (answer(share) > 0.01)
    one_way = read_pulses(columns(t=TIME, **{name: 1000.0 + 1000.0 * share}, rpm=moved), Said())
    assert np.allclose(one_way.numbers(name), share)
    assert f"{name} is read as a share of the supply from 1000 µs" in one_way.notes[-1]
    both = np.where(np.arange(200) < 120, share, -share)
    turned = read_pulses(columns(t=TIME, **{name: 1500.0 + 500.0 * both}, rpm=900.0 * answer(both)), Said())
    assert np.allclose(turned.numbers(name), both)
    without = columns(t=TIME, **{name: 1500.0 + 500.0 * both}, rpm=900.0 * np.abs(answer(both)))
    assert np.allclose(read_pulses(without, Said()).numbers(name), both)
    count = np.cumsum(np.round(moved))
    assert np.allclose(
        read_pulses(columns(t=TIME, **{name: 1000 + 1000 * share}, count=count), Said()).numbers(name), share
    )


@pytest.mark.parametrize(("way", "turned", "read"), [(1.0, 1.0, True), (-1.0, 1.0, True), (1.0, 0.0, False)])
def test_pulses_about_which_a_motor_turns_both_ways_though_it_stands_elsewhere(
    way: float, turned: float, read: bool
) -> None:
    """Of a loop whose motor sticks below a third of its voltage, 17 % of the rows in which it stood were at 1500 µs."""
    share = np.repeat([0.0, 0.3, 0.9, 0.2, -0.9, -0.25, -0.8, 0.7, 0.3, 0.1], 20)
    moving = np.where(np.abs(share) > 0.3, 900.0 * way * share, 0.0)
    speed = np.where(share < 0.0, turned, 1.0) * moving
    table = columns(t=TIME, esc=1500.0 + 500.0 * share, rpm=speed)
    found = read_pulses(table, Said())
    assert np.allclose(found.numbers("esc"), share) if read else found is table
    few = np.where(np.arange(200) < 184, np.abs(share), share)
    assert (
        read_pulses(columns(t=TIME, esc=1500.0 + 500.0 * few, rpm=900.0 * np.abs(moving)), Said()).numbers("esc").max()
        > 1.0
    )


def test_what_is_no_voltage_may_be_said(tmp_path: Path) -> None:
    share = levels(4_340_030, 0.2)
    rpm = 100.0 + 900.0 * answer(share)  # it never stands
    table = columns(t=TIME, esc=1100.0 + 900.0 * share, rpm=rpm)
    assert np.allclose(read_pulses(table, Said(neutral=1100.0)).numbers("esc"), share)
    assert np.allclose(read_pulses(table, Said(neutral=1100.0, full_duty=1800.0)).numbers("esc"), 0.5 * share)
    lower = read_pulses(
        columns(t=TIME, esc=np.where(share == 0.0, 980.0, 1000.0 + 1000.0 * share), rpm=rpm), Said(neutral=1000.0)
    )
    assert np.allclose(lower.numbers("esc"), share)  # one that goes one way
    both = np.where(np.arange(200) < 120, share, -share)
    halves = columns(t=TIME, pwm=127.0 + 127.0 * both, rpm=900.0 * answer(both))
    assert np.allclose(read_pulses(halves, Said(neutral=127.0, full_duty=127.0, voltage="pwm")).numbers("pwm"), both)
    with pytest.raises(RecordingError, match=r"--neutral 127 is of which column\? Say it \(--voltage COL\)\."):
        read_pulses(halves, Said(neutral=127.0))
    with pytest.raises(RecordingError, match=r"pwm shows 127 at 0 V: say how far from there .* \(--full-duty D\)\."):
        read_pulses(halves, Said(neutral=127.0, voltage="pwm"))
    path = tmp_path / "halves.csv"
    rows = zip(TIME, 127.0 + np.rint(127.0 * both), 900.0 * answer(both), strict=True)
    path.write_text("t,pwm,rpm\n" + "\n".join(f"{t:.2f},{u:.0f},{v:.3f}" for t, u, v in rows), encoding="utf-8")
    said = Said(neutral=127.0, full_duty=127.0, voltage="pwm", supply_voltage=12.0)
    (motor,) = import_log(path, said).motors
    volts = np.concatenate([[sample.voltage for sample in run.samples] for run in motor.log.runs])
    assert volts.min() == pytest.approx(12.0 * both.min(), abs=0.05)
    assert volts.max() == pytest.approx(12.0 * both.max(), abs=0.05)


def test_pulses_are_not_read_where_the_motor_does_not_say_from_where() -> None:
    share = levels(4_340_010, 0.2)
    rpm = 900.0 * answer(share) * (share > 0.0)
    runs = columns(t=TIME, esc=1300.0 + 500.0 * share, rpm=100.0 + rpm)  # it never stands
    turns = columns(t=TIME, esc=1000.0 + 1000.0 * share, rpm=100.0 + rpm)  # but turns at 1000 µs
    back = columns(t=TIME, esc=1000.0 + 1000.0 * share, rpm=np.where(np.arange(200) < 120, rpm, -rpm))  # both ways
    digital = columns(t=TIME, esc=48.0 + 1700.0 * share, rpm=rpm)
    duties = columns(t=TIME, pwm=1000.0 + 1000.0 * share, rpm=rpm)  # of another name they may be anything
    for table in (runs, turns, back, digital, duties):
        assert read_pulses(table, Said()) is table
    pulses = columns(t=TIME, esc=1000.0 + 1000.0 * share, rpm=rpm)
    for said in (Said(full_duty=2000.0), Said(voltage_scale=0.01), Said(voltage="rpm")):
        assert read_pulses(pulses, said) is pulses
    assert read_pulses(pulses, Said(voltage="esc")).notes


def test_what_is_no_pulse_or_beyond_the_last_is_none_and_full() -> None:
    share = levels(4_340_011, 0.3)
    rpm = 900.0 * answer(share) * (share > 0.0)
    pulses = np.where(np.arange(200) < 10, 0.0, 1000.0 + 1000.0 * share)
    pulses[[60, 61]] = 2012.0, 988.0
    found = read_pulses(columns(t=TIME, esc=pulses, rpm=rpm), Said()).numbers("esc")
    assert np.all(found[:50] == 0.0) and tuple(found[60:62]) == (1.0, 0.0)


@pytest.mark.parametrize("name", ["ESC signal (µs)", "throttle_us"])
@pytest.mark.parametrize("sagging", [True, False])
def test_a_test_stands_log_is_read_with_its_battery(tmp_path: Path, sagging: bool, name: str) -> None:
    """What it calls a voltage is at its highest where the motor stands; one that drives is then at its lowest."""
    share = np.linspace(0.0, 1.0, 11)
    rpm = 9000.0 * np.sqrt(share)
    volts = 12.0 - 3.0 * share if sagging else 12.0 * share
    path = tmp_path / "stand.csv"
    rows = [f"{k},{1000 + 100 * k},{volts[k]:.3f},{rpm[k]:.1f}" for k in range(11)]
    path.write_text("\n".join([f"Time (s),{name},Voltage (V),Motor Speed (RPM)", *rows]))
    imported = import_log(path, Said())
    (motor,) = imported.motors
    applied = sorted({round(sample.voltage, 3) for sample in motor.log.runs[0].samples})
    wanted = share * volts if sagging else volts
    assert applied == pytest.approx(sorted(set(np.round(wanted, 3))), abs=2e-3)
    assert any("times Voltage (V) in V" in one for one in imported.findings) == sagging


def test_how_long_pulses_are_is_no_share_without_their_distance(tmp_path: Path) -> None:
    path = tmp_path / "log.csv"
    rows = [f"{k / 100},{k // 20 % 7},{k // 20 % 7 * 12.5:.1f}" for k in range(200)]
    path.write_text("\n".join(["t,pwm_us,rpm", *rows]))
    with pytest.raises(RecordingError, match="pwm_us is how long a pulse is in µs.*--voltage-scale"):
        import_log(path, Said(supply_voltage=12.0))
    (motor,) = import_log(path, Said(supply_voltage=12.0, full_duty=10.0)).motors
    assert max(sample.voltage for sample in motor.log.runs[0].samples) == pytest.approx(7.2)


def test_pulses_with_gaps_are_left_for_what_fills_them() -> None:
    table = columns(t=TIME, esc=np.where(np.arange(200) % 3 == 0, "1000", ""), rpm=TIME)
    assert read_pulses(table, Said()) is table
