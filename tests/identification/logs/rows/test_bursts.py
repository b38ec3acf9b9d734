"""Rows that a link handed on in bursts."""

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from position_rows import rows as rows_of

from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import CsvForm, Kind
from motor_identification.logs.rows.bursts import FEWEST, cut_stalls, spread_bursts
from motor_identification.logs.rows.parts import GAP, split_at_gaps
from motor_identification.logs.signals import Signals, read_signals

PERIOD, WITHIN = 0.01, 0.002  # [s] on the board, within a burst


def handed_on(bursts: int, seed: int = 0, pause: tuple[int, int] = (5, 12)) -> NDArray[np.float64]:
    """[s] when a program took rows that a board makes every 10 ms, and that a link stores while the program draws."""
    random = np.random.default_rng(seed)
    times: list[float] = []
    for rows in random.integers(*pause, bursts):
        last = (len(times) + rows - 1) * PERIOD + random.uniform(0.0, 0.003)
        times += [last - WITHIN * k for k in range(rows - 1, -1, -1)]
    return np.array(times)


def timed(times: NDArray[np.float64]) -> Signals:
    rows = {"t": [f"{time:.6f}" for time in times], "u": ["1"] * len(times), "y": ["2"] * len(times)}
    table = Table(Path("log.csv"), tuple(range(2, 2 + len(times))), rows)
    return read_signals(table, CsvForm("t", "u", "y", Kind.SPEED, "rad/s"), {"": slice(0, len(times))})


def spread(times: NDArray[np.float64], gap: float = 0.02) -> tuple[Signals, list[str]]:
    return spread_bursts(timed(times), np.diff(times, prepend=times[0]) > gap)


@pytest.mark.parametrize("seed", range(5))
def test_the_times_of_the_board(seed: int) -> None:
    signals, said = spread(handed_on(60, seed))
    steps = np.diff(signals.time) * 1e-9
    assert np.ptp(steps) < 2e-9 and steps[0] == pytest.approx(PERIOD, rel=0.01)
    assert said[0].startswith("Rows come in bursts, about 8 at a time, as a link hands them on")
    assert "ms apart (assumed; otherwise: --sample-period)." in said[0]


def test_a_board_that_pauses_has_a_clock_of_its_own() -> None:
    """The pauses are as long, however many rows came before."""
    rows = np.random.default_rng(1).integers(5, 12, 60)
    begins = np.cumsum(WITHIN * rows + 0.05)
    times = np.concatenate([begin + WITHIN * np.arange(count) for begin, count in zip(begins, rows, strict=True)])
    assert not spread(times)[1]


@pytest.mark.parametrize(("one_in", "told"), [(20, True), (4, False)])
def test_bursts_that_end_beside_an_even_clock_keep_their_times(one_in: int, told: bool) -> None:
    """One in so many is handed on 20 ms late; a row more takes as long as before, on average."""
    times = handed_on(120)
    late = np.cumsum(np.diff(times, prepend=times[0]) > 2.0 * WITHIN) % one_in == 1
    assert bool(spread(times + 0.02 * late)[1]) == told


@pytest.mark.parametrize(("bursts", "told"), [(FEWEST + 1, True), (FEWEST, False)])
def test_ten_bursts_tell(bursts: int, told: bool) -> None:
    assert bool(spread(handed_on(bursts))[1]) == told


def test_bursts_of_equal_length_tell_nothing() -> None:
    assert not spread(handed_on(60, pause=(8, 9)))[1]


def test_such_rows_are_one_run() -> None:
    """Pauses of more than 20 times the distance within a burst, and more rows than a pause alone would be cut for."""
    times = handed_on(40, pause=(30, 60))
    parts, said = split_at_gaps(timed(times))
    assert np.max(np.diff(times)) > GAP * WITHIN and len(parts.runs) == 1 and "in bursts, about 4" in said[0]


def held_back(begin: int, length: int, catching_up: int, every: int = 5) -> NDArray[np.float64]:
    """Positions of a motor that gains speed, new in every so many rows; a link holds them back for some rows."""
    row = np.arange(1200)
    told = row // every * every
    late = (row >= begin) & (row < begin + length)
    told[late] = (begin - 1) // every * every
    behind = slice(begin + length, begin + length + catching_up)
    told[behind] = np.linspace(begin, begin + length + catching_up, catching_up).astype(int) // every * every
    return 10.0 * told + 0.01 * told**2


def test_rows_of_a_link_that_stood_still_are_left_out() -> None:
    position = held_back(600, 100, 8)
    signals, said = cut_stalls(rows_of(position), "y")
    first, second = signals.runs.values()
    assert 600 <= first.stop <= 606 and 490 <= second.stop - second.start <= 500
    assert "rows from line 60" in said[0] and "2 runs, a bag each" in said[0]
    even = np.diff(signals.motion[first])
    assert even.max() < 5 * 25.0  # as far as it goes in five rows
    for catching_up in (8, 20):
        cut, _ = cut_stalls(rows_of(held_back(600, 100, catching_up)), "y")
        assert np.max(np.diff(cut.motion[list(cut.runs.values())[1]])) < 5 * 36.0


@pytest.mark.parametrize(
    ("what", "position"),
    [
        ("it goes on as before", held_back(600, 0, 0)),
        ("too short", held_back(600, 15, 3)),
        ("caught up as slowly as a motor may", held_back(600, 100, 90)),
        (
            "it stood",
            np.concatenate([10.0 * (np.arange(600) // 5), np.full(100, 1190.0), 1200.0 + 10.0 * (np.arange(500) // 5)]),
        ),
        (
            "it stopped slowly, stood, and started",
            np.cumsum(
                np.concatenate([np.full(500, 10.0), np.linspace(10.0, 0.1, 50), np.zeros(100), np.full(500, 8.0)])
            ),
        ),
        ("it sticks and slips", np.cumsum(np.where(np.arange(1200) % 40 < 5, 80.0, 0.0))),
    ],
)
def test_rows_of_a_motor_that_stood_are_not(what: str, position: NDArray[np.float64]) -> None:
    signals, said = cut_stalls(rows_of(position), "y")
    assert said == [] and len(signals) == len(position), what


def test_a_motor_that_turned_back_before_it_stood_was_not_held_back() -> None:
    """Its last changes before the stand went nowhere: no speed says how far it would have gone."""
    there_and_back = np.tile(np.repeat([1.0, 0.0, -1.0, 0.0], 5), 30)
    position = np.concatenate([there_and_back, np.zeros(100), there_and_back])
    with np.errstate(all="raise"):
        assert cut_stalls(rows_of(position), "y")[1] == []


@pytest.mark.parametrize(("missing", "held"), [(20, False), (20, True), (60, False), (60, True)])
def test_rows_that_are_missing_are_no_stall(missing: int, held: bool) -> None:
    """The motor went on as fast; in a stall rows come that repeat a value."""
    position = 10.0 * np.arange(600)
    position[300 : 300 + missing] = position[299]
    there = (np.arange(600) < 300) | (np.arange(600) >= 300 + missing)
    _, said = cut_stalls(rows_of(position).only(there | held), "y")
    assert bool(said) is held
