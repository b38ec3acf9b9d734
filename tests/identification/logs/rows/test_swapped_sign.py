"""A motion that goes against its voltage."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.rows import swapped_sign
from motor_identification.logs.rows.swapped_sign import turn_round
from motor_identification.logs.signals import Floats, Signals

VOLTAGE = np.repeat([5.0, -5.0, 0.0, 3.0], 50)


def signals(motion: Floats) -> Signals:
    count, unknown = len(motion), np.full(len(motion), np.nan)
    time, runs = np.arange(count) * 10_000_000, {"1": slice(0, 100), "2": slice(100, count)}
    return Signals(Path("log.csv"), np.arange(count), time, VOLTAGE, motion, unknown, unknown, runs)


@pytest.mark.parametrize("is_speed", [True, False])
def test_exchanged_wires(is_speed: bool) -> None:
    speed = 10.0 * np.convolve(VOLTAGE, np.exp(-np.arange(40) / 6.0))[:200] / 6.5
    motion = speed if is_speed else 1000.0 + np.cumsum(speed)
    turned, said = turn_round(signals(-motion), is_speed)
    np.testing.assert_array_equal(turned.motion, motion)
    assert said[0].startswith("Caution: the motion goes against the voltage") and len(said) == 1
    kept, said = turn_round(signals(motion), is_speed)
    assert np.array_equal(kept.motion, motion) and said == []
    assert turn_round(signals(0.0 * motion), is_speed)[1] == []


@pytest.mark.parametrize(("share", "turned"), [(0.74, False), (0.76, True)])
def test_so_much_of_it(share: float, turned: bool) -> None:
    against = np.where(np.arange(200) % 50 < 50 * share, -1.0, 1.0) * VOLTAGE
    assert bool(turn_round(signals(against), True)[1]) == turned


@pytest.mark.parametrize("noise", [0.0, 1.24])
def test_a_standing_motor_is_not_turned_round(noise: float) -> None:
    """A sensor shows its last speed, or a count of noise, under -400 of 5000, which friction holds."""
    volts = np.where(np.arange(200) < 40, 0.0024, -0.96)
    stale = 1.24 + noise * (np.random.default_rng(1).random(200) < 0.3)
    given = replace(signals(stale), voltage=volts)
    assert turn_round(given, True)[1] == []
    one_count = np.where(np.arange(200) < 45, 0.0, 1.24)  # of a motor that turns
    assert turn_round(replace(given, motion=one_count), True)[1]


def test_a_few_rows_tell_nothing() -> None:
    for rows, turned in ((19, False), (20, True)):
        few = replace(signals(-VOLTAGE), runs={"": slice(0, 200)}).only(np.arange(200) < rows)
        assert bool(turn_round(few, True)[1]) == turned


def potentiometer(speed: float, seed: int) -> Signals:
    """A motor that follows its voltage at so much a row and a volt, as a converter with noise of 40 sees it."""
    random, count = np.random.default_rng(seed), 1000
    voltage, unknown = np.repeat([4.0, -3.0, 6.0, -6.0], 250), np.full(count, np.nan)
    motion = np.cumsum(speed * voltage) + 40.0 * random.standard_normal(count)
    time = np.arange(count) * 10_000_000
    return Signals(Path("log.csv"), np.arange(count), time, voltage, motion, unknown, unknown, {"": slice(0, count)})


@pytest.mark.parametrize(("speed", "turned"), [(-0.8, True), (0.8, False), (0.0, False)])
def test_a_position_with_much_noise_shows_over_many_rows_where_it_goes(speed: float, turned: bool) -> None:
    for seed in range(20):
        found, said = turn_round(potentiometer(speed, seed), False)
        assert bool(said) is turned and np.array_equal(found.motion, potentiometer(speed, seed).motion) is not turned


@pytest.mark.parametrize(("longer", "turned"), [(-0.6, True), (-0.4, False)])
def test_spans_twice_as_long_have_to_say_the_same(longer: float, turned: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """A position loop that holds a load answers what it went before: over 2 to 32 rows against, beyond not."""
    told = {1: (-0.1, True), 2: (-0.7, False), 4: (longer, False)}
    monkeypatch.setattr(swapped_sign, "_compare", lambda _, is_speed, rows: told[rows])
    assert swapped_sign._goes_against(signals(VOLTAGE), False) is turned
