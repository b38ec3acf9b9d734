"""Rows of an even clock that were stamped when they came are put on it, and no others."""

from dataclasses import replace
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from numpy.typing import NDArray
from position_rows import rows

from motor_identification.logs.form import CsvForm, Kind
from motor_identification.logs.log import read_log
from motor_identification.logs.rows import even_clock
from motor_identification.logs.rows.even_clock import restore_even_clock
from motor_identification.logs.signals import Signals
from motor_identification.sensor import row_clock

Floats = NDArray[np.float64]

ROWS, PERIOD = 400, 0.01  # [s]
FORM = CsvForm("t", "u", "c", Kind.COUNT, "count", edges_per_revolution=1000)


def swing(time: Floats) -> Floats:
    """A position that goes to and fro, in counts."""
    return np.asarray(np.round(5000.0 * np.sin(2.0 * time)))


def signals(stamps: Floats, motion: Floats) -> Signals:
    return replace(rows(motion), time=np.round(stamps * 1e9).astype(np.int64))


def late(scale: float, seed: int = 0) -> Signals:
    """Even rows, each stamped late by a part of a row in the mean."""
    even = PERIOD * np.arange(ROWS)
    return signals(np.sort(even + scale * PERIOD * np.random.default_rng(seed).exponential(size=ROWS)), swing(even))


def test_late_stamps_of_even_rows_are_put_right() -> None:
    logged = late(0.2)
    restored, said = restore_even_clock(logged)
    even = restored.time - restored.time[0]
    assert np.ptp(np.diff(even)) <= 1 and np.mean(np.diff(even)) == pytest.approx(1e9 * PERIOD, rel=1e-3)
    assert np.mean(logged.time - restored.time) == pytest.approx(0.0, abs=1e5)  # as late as before, in the mean
    assert len(said) == 1 and said[0].startswith("Stamps are off an even clock of 10 ms by 2.")
    assert np.array_equal(restored.motion, logged.motion)


def test_rows_that_came_when_they_say_are_left() -> None:
    """A loop whose periods are irregular runs away from any clock; one that waits for its next turn does not."""
    random = np.random.default_rng(1)
    away = np.cumsum(PERIOD * (1.0 + 0.3 * random.standard_normal(ROWS)).clip(0.5))
    waits = PERIOD * (np.arange(ROWS) + 0.2 * random.random(ROWS))
    for true in (away, waits):
        logged = signals(true, swing(true))
        assert restore_even_clock(logged) == (logged, [])
    exact = signals(PERIOD * np.arange(ROWS), swing(PERIOD * np.arange(ROWS)))
    assert restore_even_clock(exact) == (exact, [])


def test_a_motor_that_stands_tells_of_no_clock() -> None:
    """Nor does it say of the other runs that they are on one."""
    still = late(0.2)
    still = replace(still, motion=np.full(ROWS, 7.0))
    assert restore_even_clock(still) == (still, [])
    assert len(restore_even_clock(still, wanted=True)[1]) == 1


def test_a_loop_that_runs_away_and_is_stamped_late_is_smoothed() -> None:
    """Neither its stamps nor an even clock are near to when its rows came."""
    random = np.random.default_rng(3)
    true = np.cumsum(PERIOD * (1.0 + 0.1 * random.standard_normal(ROWS)))
    stamps = true + 0.3 * PERIOD * random.exponential(size=ROWS)
    restored, said = restore_even_clock(signals(np.maximum.accumulate(stamps), swing(true)))
    assert len(said) == 1
    even = np.polyval(np.polyfit(np.arange(ROWS), true, 1), np.arange(ROWS))
    off = [np.std(times - true) for times in (1e-9 * restored.time, stamps, even)]
    assert off[0] < 0.6 * min(off[1:])


def test_a_loop_of_coarse_counts_that_runs_away_for_long_is_on_no_even_clock() -> None:
    """Seven rows of 1.5 counts each tell nothing of a period that is 6 % longer or shorter; means of many rows do."""
    random = np.random.default_rng(1)
    true = np.cumsum(0.0035 * (1.0 + 0.06 * random.standard_normal(1000)))
    stamps = np.maximum.accumulate(true + 0.1 * 0.0035 * random.exponential(size=1000))
    restored, said = restore_even_clock(signals(stamps, np.floor(1.5 / 0.0035 * true)))
    assert len(said) == 1
    even = np.polyval(np.polyfit(np.arange(1000), stamps, 1), np.arange(1000))
    off = [1e3 * np.std(times - true) for times in (1e-9 * restored.time, stamps, even)]
    assert 0.1 < off[0] < 0.8 * off[1] < 0.4 < 1.0 < off[2]  # [ms]


def test_whole_milliseconds_and_few_counts_hide_no_clock() -> None:
    """A hundred counts a turn at most, ten or less a row: an eighth of what a row may be late is seen."""
    even = 0.005 * np.arange(ROWS)
    late_ones = even + 0.3 * 0.005 * np.random.default_rng(4).exponential(size=ROWS)
    stamps = np.floor(np.maximum.accumulate(late_ones) * 1e3) * 1e-3 + 1e-6 * np.arange(ROWS)
    restored, said = restore_even_clock(signals(stamps, np.round(100.0 * np.sin(9.0 * even))))
    assert len(said) == 1 and np.ptp(np.diff(restored.time)) <= 1


@pytest.mark.parametrize("own", [False, True])
def test_speeds_of_counts_tell_the_clock_by_their_counts(own: bool) -> None:
    """Divided by the period that rows should have, or by what their stamps say."""
    logged = late(0.2)
    counts = np.diff(logged.motion, prepend=logged.motion[0])
    steps = np.diff(logged.time, prepend=logged.time[0] - 10_000_000) * 1e-9
    speeds = replace(logged, motion=counts * 0.37 / (steps if own else PERIOD))
    restored, said = restore_even_clock(speeds, is_speed=True)
    assert len(said) == 1 and np.ptp(np.diff(restored.time)) <= 1


@pytest.mark.parametrize("step", [1.0, 0.01])
def test_speeds_of_printed_decimals_are_no_counts(step: float) -> None:
    """A loop that waits for its next turn: by what is printed of its speeds, any rows would be even."""
    random = np.random.default_rng(1)
    true = PERIOD * (np.arange(ROWS) + 0.2 * random.random(ROWS))
    speeds = np.round(300.0 * np.cos(2.0 * true) * 0.1 / step) * step
    logged = signals(true, speeds)
    assert restore_even_clock(logged, is_speed=True) == (logged, [])


def test_a_tachogenerators_steps_are_no_counts() -> None:
    """Of a noise of a step and more, as of a steady converter's; summed up, any rows would be even."""
    random = np.random.default_rng(1)
    true = PERIOD * (np.arange(ROWS) + 0.2 * random.random(ROWS))
    for noise in (1.5, 0.0):
        speeds = 0.37 * np.round(120.0 * np.cos(2.0 * true) + noise * random.standard_normal(ROWS))
        logged = signals(true, speeds)
        assert restore_even_clock(logged, is_speed=True) == (logged, [])


def test_counts_of_rows_that_came_when_they_say_keep_their_stamps() -> None:
    random = np.random.default_rng(1)
    true = PERIOD * (np.arange(ROWS) + 0.2 * random.random(ROWS))
    counts = np.diff(swing(true), prepend=0.0)
    steps = np.diff(true, prepend=true[0] - PERIOD)
    for speeds in (counts * 0.37 / PERIOD, counts * 0.37 / steps):
        logged = signals(true, speeds)
        assert restore_even_clock(logged, is_speed=True) == (logged, [])


def test_counts_divided_by_lengths_that_whole_milliseconds_hide_keep_their_stamps() -> None:
    """A loop that runs away by 2 % a row was put on an even clock, 2.7 ms off stamps that were right to half one."""
    random = np.random.default_rng(1)
    lengths = PERIOD * (1.0 + 0.02 * random.standard_normal(2000))
    true = np.cumsum(lengths)
    rates = np.repeat([0.0, 0.5, 1.5, 2.5, 3.5, 20.0, 60.0, 100.0], 250)  # counts in a row; of the few it shows them
    counts = np.diff(np.floor(np.cumsum(rates * lengths / PERIOD)), prepend=0.0)
    logged = signals(np.floor(true * 1e3) * 1e-3, np.round(counts * 0.37 / lengths, 2))
    assert restore_even_clock(logged, is_speed=True) == (logged, [])


def test_a_row_for_every_flank_is_on_no_clock() -> None:
    """There the count is even by row whatever the time was; also where a few were missed, or stand."""
    random = np.random.default_rng(5)
    time = np.cumsum(PERIOD * (1.0 + 0.2 * np.sin(np.arange(ROWS) / 9.0))) + 1e-3 * random.random(ROWS)
    flanks = np.arange(ROWS, dtype=np.float64)
    for position in (flanks, flanks + np.cumsum(random.random(ROWS) < 0.05)):
        logged = signals(time, position)
        assert restore_even_clock(logged) == (logged, [])


def test_runs_have_clocks_of_their_own_and_a_lost_row_is_a_gap() -> None:
    restored, said = restore_even_clock(replace(late(0.2), runs={"a": slice(0, 200), "b": slice(200, 400)}))
    for run in restored.runs.values():
        assert np.ptp(np.diff(restored.time[run])) <= 1
    assert len(said) == 1
    whole = late(0.2)
    lost = whole.only(~np.isin(np.arange(ROWS), [100, 300, 301]))
    restored, said = restore_even_clock(lost)
    steps = np.diff(restored.time) * 1e-9 / PERIOD
    assert len(said) == 1 and np.allclose(steps[[99, 298]], [2.0, 3.0], atol=0.01)
    assert np.allclose(np.delete(steps, [99, 298]), 1.0, atol=0.01)
    far = replace(whole, time=whole.time + (np.arange(ROWS) == 200) * 9_990_000_000 // 100)
    assert restore_even_clock(far)[1] == []  # ten rows late, once: that is no clock's


def test_somebody_may_say_it() -> None:
    logged = late(0.2)
    assert restore_even_clock(logged, False) == (logged, [])
    true = PERIOD * (np.arange(ROWS) + 0.2 * np.random.default_rng(1).random(ROWS))
    restored, said = restore_even_clock(signals(true, swing(true)), True)
    assert np.ptp(np.diff(restored.time)) <= 1 and said


@pytest.mark.parametrize(
    ("module", "limit", "value"),
    [
        (row_clock, "LEAST_ROWS", ROWS + 1),
        (row_clock, "LEAST_JITTER", 0.5),
        (row_clock, "MOST_JITTER", 0.1),
        (row_clock, "MOST_LATE", 2.0),
        (even_clock, "ITS_OWN", 0.0),
    ],
)
def test_every_limit_decides(module: ModuleType, limit: str, value: float, monkeypatch: pytest.MonkeyPatch) -> None:
    logged = late(0.2)
    monkeypatch.setattr(module, limit, value)
    assert restore_even_clock(logged) == (logged, [])


def test_an_import_says_it_and_lets_it_be_said(tmp_path: Path) -> None:
    logged = late(0.2)
    lines = "".join(f"{1e-9 * t:.6f},6,{c:.0f}\n" for t, c in zip(logged.time, logged.motion, strict=True))
    (tmp_path / "log.csv").write_text("t,u,c\n" + lines, encoding="utf-8")
    found = read_log(tmp_path / "log.csv", FORM)
    stamps = np.array([one.sample_time for one in found.runs[0].samples])
    assert any("--no-even-clock" in line for line in found.findings) and np.ptp(np.diff(stamps)) <= 1
    kept = read_log(tmp_path / "log.csv", replace(FORM, even_clock=False))
    assert np.ptp(np.diff([one.sample_time for one in kept.runs[0].samples])) > 1e6
    assert not any("even clock" in line for line in kept.findings)


def test_an_angle_that_wraps_every_few_rows_tells_the_clock_by_its_turns(tmp_path: Path) -> None:
    """At 80 degrees a row no window of rows is without a wrap."""
    logged = late(0.2)
    angle = 80.0 * np.arange(ROWS) + 40.0 * np.sin(0.02 * np.arange(ROWS))
    values = np.round(angle * 4096 / 360.0) * 360.0 / 4096
    lines = "".join(f"{1e-9 * t:.6f},6,{c:.6f}\n" for t, c in zip(logged.time, values % 360.0, strict=True))
    (tmp_path / "log.csv").write_text("t,u,c\n" + lines, encoding="utf-8")
    found = read_log(tmp_path / "log.csv", CsvForm("t", "u", "c", Kind.POSITION, "deg", edges_per_revolution=4096))
    assert any("--no-even-clock" in line for line in found.findings)
    assert any("wraps at 360 deg" in line for line in found.findings)
    assert np.ptp(np.diff([one.sample_time for one in found.runs[0].samples])) <= 1
