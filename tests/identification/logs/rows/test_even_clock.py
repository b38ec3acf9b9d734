"""Rows of an even clock that were stamped when they came are put on it, and no others."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from position_rows import rows

from motor_identification.logs.form import CsvForm, Kind
from motor_identification.logs.log import read_log
from motor_identification.logs.rows import even_clock
from motor_identification.logs.rows.even_clock import restore_even_clock
from motor_identification.logs.signals import Signals

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


def test_a_row_for_every_flank_is_on_no_clock() -> None:
    """There the count is even by row whatever the time was."""
    time = np.cumsum(PERIOD * (1.0 + 0.5 * np.sin(np.arange(ROWS) / 9.0)))
    logged = signals(time, np.arange(ROWS, dtype=np.float64))
    assert restore_even_clock(logged) == (logged, [])


def test_runs_have_clocks_of_their_own_and_lost_rows_no_clock() -> None:
    restored, said = restore_even_clock(replace(late(0.2), runs={"a": slice(0, 200), "b": slice(200, 400)}))
    for run in restored.runs.values():
        assert np.ptp(np.diff(restored.time[run])) <= 1
    assert len(said) == 1
    whole = late(0.2)
    lost = whole.only(~np.isin(np.arange(ROWS), np.arange(190, 196)))
    assert restore_even_clock(lost) == (lost, [])


def test_somebody_may_say_it() -> None:
    logged = late(0.2)
    assert restore_even_clock(logged, False) == (logged, [])
    true = PERIOD * (np.arange(ROWS) + 0.2 * np.random.default_rng(1).random(ROWS))
    restored, said = restore_even_clock(signals(true, swing(true)), True)
    assert np.ptp(np.diff(restored.time)) <= 1 and said


@pytest.mark.parametrize(
    ("limit", "value"),
    [("LEAST_ROWS", ROWS + 1), ("LEAST_JITTER", 0.5), ("MOST_JITTER", 0.1), ("LEAST_STEPS", 3.0), ("BETTER", 0.0)],
)
def test_every_limit_decides(limit: str, value: float, monkeypatch: pytest.MonkeyPatch) -> None:
    logged = late(0.2)
    monkeypatch.setattr(even_clock, limit, value)
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
