"""A filter runs on the board, where no row is missing: what went into it is found though a log lacks some."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.signal import lfilter

from motor_identification.recording import Bools, Floats
from motor_identification.timing import whole_rows
from motor_identification.timing.speed_filter import BILINEAR, BUTTERWORTH, KINDS, MEAN, MEMORY, TWICE, SpeedFilter
from motor_identification.timing.whole_rows import undo_on_whole_rows

ROWS, PERIOD = 3000, 0.004  # [s]


def make_speeds() -> tuple[Floats, Floats]:
    """The voltage and the noisy speeds of a motor of twenty rows."""
    random = np.random.default_rng(0)
    voltage = np.repeat(random.uniform(-1.0, 1.0, ROWS // 60), 60)
    return voltage, 100.0 * lfilter([0.05], [1.0, -0.95], voltage) + random.standard_normal(ROWS)


def pass_through(passed: SpeedFilter, values: Floats) -> Floats:
    zeros = np.array([passed.poles.sum()])
    for rows in KINDS[passed.kind].means(passed.number):
        zeros = np.convolve(zeros, np.ones(rows) / rows)
    return np.asarray(lfilter(zeros, passed.poles, values))


def lose(share: float) -> Bools:
    """Which rows are logged: all but a share of them."""
    logged = np.ones(ROWS, dtype=bool)
    logged[1 + np.random.default_rng(1).choice(ROWS - 2, int(share * ROWS), replace=False)] = False
    return logged


@pytest.mark.parametrize(
    ("passed", "off"),
    [
        (SpeedFilter(MEAN, 10), 0.3),
        (SpeedFilter(MEAN, 2), 0.3),
        (SpeedFilter(MEMORY, 0.8), 0.5),
        (SpeedFilter(TWICE, 0.6), 0.4),
        (SpeedFilter(BILINEAR, 0.854), 0.4),
        (SpeedFilter(BUTTERWORTH, 0.7), 0.4),
    ],
)
def test_a_filter_is_undone_though_rows_are_missing(passed: SpeedFilter, off: float) -> None:
    """Row after row, one in twenty that is missing made speeds wrong by up to 300 times their noise."""
    _, went_in = make_speeds()
    logged, time = lose(0.05), PERIOD * np.arange(ROWS)
    came_out = pass_through(passed, went_in)[logged]
    assert np.std(passed.undo(came_out, time[logged]) - went_in[logged]) < off
    assert np.std(passed.undo(came_out) - went_in[logged]) > 2.0 * off


def test_without_a_missing_row_nothing_is_fitted() -> None:
    _, went_in = make_speeds()
    passed = SpeedFilter(MEAN, 10)
    came_out = pass_through(passed, went_in)
    assert np.array_equal(passed.undo(came_out, PERIOD * np.arange(ROWS)), passed.undo(came_out))


def test_what_was_in_a_mean_before_the_log_is_found_with_what_is_missing() -> None:
    _, went_in = make_speeds()
    logged, begin = lose(0.02), 1000  # in motion
    number = np.flatnonzero(logged[begin:])
    came_out = pass_through(SpeedFilter(MEAN, 10), went_in)[begin:][number]
    values = SpeedFilter(MEAN, 10).undo_whole(came_out, number)[number]
    assert np.std(values - went_in[begin:][number]) < 0.4


def test_what_is_missing_is_fitted_by_its_own_pattern() -> None:
    """What came out was off at one row, which was not logged: it went in at that one and the next."""
    values, went_in = np.full(100, 3.0), np.full(100, 3.0)
    values[50], went_in[50], went_in[51] = 5.0, 7.0, 1.0

    def undo(came_out: Floats) -> Floats:
        return 2.0 * came_out - np.append(came_out[0], came_out[:-1])

    number = np.delete(np.arange(100), 50)
    assert undo(values) == pytest.approx(went_in)
    whole = undo_on_whole_rows(undo, values[number], number, 0.0, 0)
    assert len(whole) == 100 and whole[number] == pytest.approx(np.full(99, 3.0), abs=1e-6)  # likelier than a bump


def test_many_missing_rows_are_found_in_seconds(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of 30,000 that are missing before a Butterworth filter, each trial of one took minutes; and no better."""
    _, went_in = make_speeds()
    passed, logged, time = SpeedFilter(BUTTERWORTH, 0.7), lose(0.15), PERIOD * np.arange(ROWS)
    came_out = pass_through(passed, went_in)[logged]
    off = []
    for rounds in (100_000, 100):
        monkeypatch.setattr(whole_rows, "ROUNDS", rounds)
        off.append(float(np.std(passed.undo(came_out, time[logged]) - went_in[logged])))
    assert off[1] == pytest.approx(off[0], rel=0.05)
    monkeypatch.setattr("scipy.sparse.linalg.splu", lambda *_, **__: SimpleNamespace(solve=lambda sums: 0.0 * sums))
    assert np.std(passed.undo(came_out, time[logged]) - went_in[logged]) > 10.0 * off[1]  # in few rounds it is far off
