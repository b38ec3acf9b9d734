"""Speeds by a period that rows should have had are divided by the rows' own, and no others."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from position_rows import rows

from motor_identification.logs.form import CsvForm, Kind
from motor_identification.logs.log import read_log
from motor_identification.logs.rows import row_lengths
from motor_identification.logs.rows.row_lengths import divide_by_own_rows, divide_by_regular_rows, find_window
from motor_identification.logs.signals import Signals

Floats = NDArray[np.float64]

ROWS, PERIOD = 400, 0.01  # [s]
FORM = CsvForm("t", "u", "w", Kind.SPEED, "rad/s")


def loop(jitter: float = 0.15) -> Floats:
    """The instants [s] of a loop whose periods are off by a share of the one that it should have."""
    lengths = PERIOD * (1.0 + jitter * np.random.default_rng(2).standard_normal(ROWS - 1)).clip(0.5)
    return np.append(0.0, np.cumsum(lengths))


def travel(time: Floats) -> Floats:
    return 300.0 * time + 40.0 * np.sin(3.0 * time)


def by_own_rows(time: Floats) -> Floats:
    return np.append(300.0, np.diff(travel(time)) / np.diff(time))


def by_nominal(time: Floats) -> Floats:
    return np.append(300.0, np.diff(travel(time)) / PERIOD)


def signals(time: Floats, motion: Floats) -> Signals:
    return replace(rows(motion), time=np.round(time * 1e9).astype(np.int64))


def test_a_row_that_took_longer_had_more_counts() -> None:
    time = loop()
    found, said = divide_by_own_rows(signals(time, by_nominal(time)))
    ratio = found.motion[1:] / by_own_rows(time)[1:]
    assert np.ptp(ratio) < 1e-6 and ratio[0] == pytest.approx(1.0, rel=0.02)  # but for the mean row
    assert said[0].startswith("Speeds were computed as if every row took 9.957 ms") and "--no-nominal-period" in said[0]


@pytest.mark.parametrize("noise", [0.0, 3.0])
def test_speeds_of_their_own_rows_or_times_are_left(noise: float) -> None:
    time = loop()
    random = np.random.default_rng(4)
    window = 0.5 * PERIOD  # that a sensor counts in, whatever the loop does
    own_time = (travel(time) - travel(time - window)) / window
    for motion in (by_own_rows(time), own_time):
        logged = signals(time, motion + noise * random.standard_normal(ROWS))
        assert divide_by_own_rows(logged) == (logged, [])
    even = signals(loop(0.001), by_nominal(loop(0.001)))
    assert divide_by_own_rows(even) == (even, [])


def test_a_gap_is_no_row_and_somebody_may_say_it() -> None:
    time = loop()
    later = time + np.where(np.arange(ROWS) >= 200, 2.0, 0.0)
    logged = signals(later, by_nominal(time))
    found, said = divide_by_own_rows(logged)
    assert said and found.motion[200] == logged.motion[200] and found.motion[201] != logged.motion[201]
    assert divide_by_own_rows(logged, False) == (logged, [])
    own = signals(time, by_own_rows(time))
    assert divide_by_own_rows(own, True)[1] and not divide_by_own_rows(own)[1]


@pytest.mark.parametrize(("limit", "value"), [("LEAST_ROWS", ROWS + 1), ("IRREGULAR", 0.5), ("BETTER", 0.0)])
def test_every_limit_decides(limit: str, value: float, monkeypatch: pytest.MonkeyPatch) -> None:
    time = loop()
    logged = signals(time, by_nominal(time))
    monkeypatch.setattr(row_lengths, limit, value)
    assert divide_by_own_rows(logged) == (logged, [])


def test_an_import_says_it_and_lets_it_be_said(tmp_path: Path) -> None:
    time = loop()
    lines = "".join(f"{t:.6f},6,{w:.4f}\n" for t, w in zip(time, by_nominal(time), strict=True))
    (tmp_path / "log.csv").write_text("t,u,w\n" + lines, encoding="utf-8")
    speeds = {}
    for said in (None, False):
        log = read_log(tmp_path / "log.csv", replace(FORM, nominal_period=said))
        assert any("--no-nominal-period" in line for line in log.findings) == (said is None)
        assert log.info.rows_said is (said is not None) and not log.info.speed_said
        speeds[said] = np.array([one.speed for one in log.runs[0].samples])
    assert np.std(np.diff(speeds[None])[1:]) < 0.1 * np.std(np.diff(speeds[False])[1:])
    window = read_log(tmp_path / "log.csv", replace(FORM, speed_window=0.01))  # somebody knows what they are
    assert not any("--no-nominal-period" in line for line in window.findings)


def stamped_counts(by_stamps: bool) -> tuple[Signals, Signals, Floats]:
    """Counts of a loop of 4.96 ms, divided by the steps of its whole milliseconds, or by the loop's own."""
    even = 4.96e-3 * np.arange(ROWS)
    stamps = np.floor(even * 1e3 + 0.3) * 1e-3
    counts = np.diff(np.floor(travel(even) * 465.0 / (2.0 * np.pi)), prepend=0.0)
    steps = np.diff(stamps if by_stamps else even, prepend=-4.96e-3)
    speed = counts * 2.0 * np.pi / 465.0 / steps
    return signals(stamps, speed), signals(even, speed), counts


def test_counts_by_the_steps_of_coarse_stamps_are_divided_by_regular_rows() -> None:
    stamped, regular, counts = stamped_counts(by_stamps=True)
    found, said = divide_by_regular_rows(stamped, regular)
    turned = found.motion[1:] * 4.96e-3 * 465.0 / (2.0 * np.pi)
    assert np.allclose(turned, counts[1:], atol=1e-3) and said[0].endswith("(found).")


@pytest.mark.parametrize("by_stamps", [True, False])
def test_a_few_longer_steps_are_those_of_counts_that_lie_on_a_lattice_by_them_alone(by_stamps: bool) -> None:
    """Four of 143 rows of a firmware's speeds halved the step, and a slot of 0.041 rad was made of them."""
    even = 26.03e-3 * np.arange(143)
    stamps = np.floor(even * 1e3 + 0.3) * 1e-3
    random = np.random.default_rng(750_000)
    counts = np.floor(15.0 * (1.0 - np.exp(-np.arange(143) / 3.0)) + random.uniform(0.0, 4.0, 143))
    steps = np.diff(stamps, prepend=-0.026) if by_stamps else np.full(143, 0.026)
    speed = np.round(counts * 2.0 * np.pi / 1285.0 / steps, 6)
    found, said = divide_by_regular_rows(signals(stamps, speed), signals(even, speed))
    assert bool(said) is by_stamps
    turned = found.motion[1:] * (26.03e-3 if by_stamps else 0.026) * 1285.0 / (2.0 * np.pi)
    assert np.allclose(turned, counts[1:], atol=1e-3)
    rough = signals(stamps, speed + 0.02 * random.standard_normal(143))
    assert divide_by_regular_rows(rough, replace(rough, time=signals(even, speed).time))[1] == []


def test_speeds_by_other_rows_than_their_stamps_are_left() -> None:
    stamped, regular, _ = stamped_counts(by_stamps=False)
    assert divide_by_regular_rows(stamped, regular) == (regular, [])
    noisy = replace(stamped, motion=stamped.motion + np.random.default_rng(1).standard_normal(ROWS))
    assert divide_by_regular_rows(noisy, replace(regular, motion=noisy.motion))[1] == []
    assert divide_by_regular_rows(stamped, stamped)[1] == []
    assert divide_by_regular_rows(stamped.only(np.arange(ROWS) > 0), regular)[1] == []


@pytest.mark.parametrize(("times", "fits"), [(1.0, True), (2.9, True), (3.1, False), (27.0, False)])
def test_no_window_fits_rows_that_become_many_times_longer(times: float, fits: bool) -> None:
    """Jitter is none of that: the parts of a log are compared."""
    lengths = np.repeat([PERIOD, times * PERIOD], 100) * np.tile([0.2, 1.0, 1.8, 1.0], 50)
    time = np.append(0.0, np.cumsum(lengths))
    window, said = find_window(signals(time, travel(time)), 0.03)
    assert window == pytest.approx(0.03 if fits else PERIOD)
    assert bool(said) is not fits and ("--speed-window" in said) is not fits
    apart = replace(signals(time, travel(time)), runs={"1": slice(0, 101), "2": slice(101, len(time))})
    assert find_window(apart, 0.03) == (0.03, "")


@pytest.mark.parametrize("window", [None, 0.05])
def test_the_shortest_rows_are_a_window_that_nobody_said(tmp_path: Path, window: float | None) -> None:
    """A ramp of the voltage with rows of 36 ms, and one of 1 s: each has a speed of the last 50 ms."""
    time = np.append(0.0, np.cumsum(np.repeat([0.036, 1.0], 40)))
    volts = np.append(np.arange(41) % 41, np.arange(40)) * 0.3
    path = tmp_path / "log.csv"
    path.write_text("t,u,w\n" + "".join(f"{t},{u:.4g},{2.1234 * u:.7g}\n" for t, u in zip(time, volts, strict=True)))
    log = read_log(path, replace(FORM, speed_window=window))
    text = " ".join(log.findings)
    assert log.info.speed_window == pytest.approx(window or 0.036)
    assert ("Caution: rows take 36 ms in one part" in text) is (window is None)
    assert ("assumed: a row of the shortest" in text) is (window is None)
