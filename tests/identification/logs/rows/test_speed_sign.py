"""Speeds that were measured without a sign."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.rows.speed_sign import find_signs, give_signs
from motor_identification.logs.signals import Floats, Signals

PERIOD, TIME_CONSTANT = 0.01, 0.08


def speed_of(voltage: Floats, friction: float = 0.8, begin: float = 0.0) -> Floats:
    """[rad/s] of a motor of 10 rad/s a volt with friction, fine steps."""
    speed, rows = begin, []
    for volts in voltage:
        rows.append(speed)
        for _ in range(20):
            drive = volts - 0.1 * speed
            held = abs(speed) < 0.05 and abs(drive) < friction
            drive = 0.0 if held else drive - friction * (np.sign(speed) if abs(speed) >= 0.05 else np.sign(drive))
            speed = 0.0 if held else speed + drive * 10.0 / TIME_CONSTANT * PERIOD / 20.0
    return np.array(rows)


LEVELS = np.repeat([4.0, -3.0, 0.0, -5.0, 2.0, 6.0, -6.0, 0.0, 3.0], 60)


@pytest.mark.parametrize("noise", [0.0, 0.5])
def test_the_motor_turns_over_where_it_is_slowest(noise: float) -> None:
    true = speed_of(LEVELS)
    seen = np.abs(true) + noise * np.abs(np.random.default_rng(0).normal(size=len(true)))
    found = find_signs(seen, LEVELS, float(seen.max()))
    wrong = (found * true < 0.0) & (np.abs(true) > 3.0)
    assert np.count_nonzero(wrong) <= 2  # of five reversals, a row of which is open each


def test_a_motor_that_is_braked_goes_on() -> None:
    """A controller's voltage is negative for a moment, and the motor slows down."""
    voltage = np.repeat([6.0, -2.0, 3.0, 6.0, -4.0, 5.0], [80, 6, 60, 60, 5, 60])
    true = speed_of(voltage)
    assert np.all(true > -0.1) and np.all(find_signs(true, voltage, float(true.max())) == 1.0)
    assert np.all(find_signs(speed_of(-voltage[::-1] * 0.0, begin=30.0), -np.ones(len(voltage)), 30.0) == 1.0)


def signals(speed: Floats, voltage: Floats) -> Signals:
    count, unknown = len(speed), np.full(len(speed), np.nan)
    half = count // 2
    runs = {"1": slice(0, half), "2": slice(half, count)}
    time = np.arange(count) * 10_000_000
    return Signals(Path("log.csv"), np.arange(count), time, voltage, speed, unknown, unknown, runs)


def test_only_speeds_without_a_sign_get_one() -> None:
    voltage = np.repeat([5.0, -5.0], 100)
    true = np.concatenate([speed_of(voltage[:100]), speed_of(voltage[100:])])
    given, said = give_signs(signals(np.abs(true), voltage))
    np.testing.assert_allclose(given.motion, true)
    assert len(said) == 1 and said[0].startswith("Caution: speeds have no sign, and the voltage has")
    assert give_signs(signals(true, voltage))[1] == []
    assert give_signs(signals(np.abs(true), np.abs(voltage)))[1] == []
    assert give_signs(signals(0.0 * true, voltage))[1] == []


@pytest.mark.parametrize(("offset", "signs"), [(-0.01, False), (-0.03, True)])
def test_a_converters_offset_is_no_sign_of_the_voltage(offset: float, signs: bool) -> None:
    """A share of the largest voltage below 0, then a run the other way whose speed has no sign."""
    voltage = np.repeat([6.0, 6.0 * offset, 6.0], 60)
    speed = np.abs(speed_of(np.repeat([6.0, 0.0, 6.0], 60)))
    unknown = np.full(len(voltage), np.nan)
    rows = np.arange(len(voltage))
    if signs:
        speed[60:120] = 20.0 * (1.0 - np.exp(-np.arange(60) / 8.0))
    signals = Signals(Path("log.csv"), rows, rows * 10**7, voltage, speed, unknown, unknown, {"": slice(0, len(rows))})
    assert bool(give_signs(signals)[1]) is signs
