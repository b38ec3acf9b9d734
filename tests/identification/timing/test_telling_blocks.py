"""Of long recordings some thousand rows tell how speeds were made: those in which the command swings."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lfilter
from swinging import noisy

from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.request import SearchConfig
from motor_identification.estimation.search.global_search import search_globally
from motor_identification.measurement.intervals import Intervals
from motor_identification.noise.error_data import ErrorData, make_error_data
from motor_identification.recording import Floats, Recording, check
from motor_identification.timing import telling_blocks
from motor_identification.timing.speed_filter import MEMORY, SpeedFilter
from motor_identification.timing.speed_timing import find_timing
from motor_identification.timing.telling_blocks import choose_blocks, take_blocks


def long(voltage: Floats) -> Recording:
    """Rows of 20 ms, of which only the voltages matter."""
    blank, rows = noisy(0.5), len(voltage)
    time = np.arange(rows, dtype=np.int64) * 20_000_000
    return replace(blank.at_rows(np.zeros(rows, np.int64)), sample_time=time, voltage=voltage)


def swing(rows: int, *parts: slice) -> Floats:
    """6 V, and ±6 V by turns of 50 rows within some parts."""
    voltage = np.full(rows, 6.0)
    for part in parts:
        voltage[part] *= np.where(np.arange(rows)[part] // 50 % 2, 1.0, -1.0)
    return voltage


def test_all_of_what_is_short_is_looked_at() -> None:
    some = [long(swing(3000)), long(swing(5000))]
    assert choose_blocks(some) == [[(-np.inf, np.inf)]] * 2
    assert choose_blocks([long(swing(3000)), long(swing(5001))]) != [[(-np.inf, np.inf)]] * 2


def test_blocks_in_which_the_command_swings_are_chosen(monkeypatch: pytest.MonkeyPatch) -> None:
    """Neighbours as one, each recording's by its length."""
    monkeypatch.setattr(telling_blocks, "MOST_ROWS", 4000)
    one = long(swing(9000, slice(3000, 5000), slice(7000, 8000)))
    spans = choose_blocks([one, long(swing(3000, slice(2000, 3000)))])
    assert len(spans) == 2 and np.array(spans[0]) == pytest.approx(np.array([[60.0, 100.0], [140.0, 160.0]]))
    assert spans[1] == [(40.0, np.inf)]


def test_increments_of_blocks_forget_what_was_before() -> None:
    recording = check(noisy(0.5))
    data: Intervals = make_problem([recording], ()).intervals[0]
    whole = make_error_data(data, np.arange(len(data.first), dtype=np.float64))
    end = data.time[data.last]
    (everything,) = take_blocks(whole, end, [(-np.inf, np.inf)])
    assert np.array_equal(everything.increments, whole.increments)
    parts: list[ErrorData] = take_blocks(whole, end, [(1.0, 2.0), (5.0001, 5.001), (8.0, np.inf)])
    assert [len(part.increments) for part in parts] == [50, np.count_nonzero(end >= 8.0)]
    assert all(part.fresh[0] and part.pause[0] == np.inf for part in parts)


@pytest.mark.slow
def test_a_filter_is_found_in_a_few_of_many_rows(monkeypatch: pytest.MonkeyPatch) -> None:
    plain = noisy(0.5)
    logged = check(replace(plain, speed=np.round(lfilter([0.2], [1.0, -0.8], plain.speed), 5)))
    monkeypatch.setattr(telling_blocks, "ROWS", 100)
    monkeypatch.setattr(telling_blocks, "MOST_ROWS", 600)
    estimate, _ = search_globally(make_problem([logged], ()), SearchConfig())
    found = find_timing([logged], estimate)
    assert found is not None and found.filter is not None and found.filter.kind == MEMORY
    assert found.filter.number == pytest.approx(SpeedFilter(MEMORY, 0.8).number, abs=0.04)
