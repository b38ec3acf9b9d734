"""When rows were made shows in the motion, also behind a filter; and whether each was divided by its own length."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lfilter
from swinging import noisy
from tiers import keep_fast

from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.request import SearchConfig
from motor_identification.estimation.search.global_search import search_globally
from motor_identification.recording import Floats, Recording, check
from motor_identification.sensor.row_clock import measure_period
from motor_identification.sensor.speed_sensor import find_speed_sensor
from motor_identification.timing import row_times, speed_timing
from motor_identification.timing.row_times import AS_STAMPED, LONGEST, RowTimes, list_row_times
from motor_identification.timing.shaped_fit import Shaper
from motor_identification.timing.speed_filter import MEMORY, SpeedFilter
from motor_identification.timing.speed_timing import find_timing
from motor_identification.timing.timing import ASSUMED, Timing, read_again

PERIOD, ROWS = 0.02, 600  # [s]
KV, LAG = 0.05, 0.1  # [V·s/rad], [s]


def logged(
    lengths: Floats, late: Floats, edges: int = 0, nominal: bool = False, memory: float = 0.0, sigma: float = 0.05
) -> Recording:
    """Means over rows of some lengths [rows], counted or with white noise [rad/s], stamped late [rows]."""
    random, rows = np.random.default_rng(1), PERIOD * lengths
    voltage = np.repeat(random.uniform(-8.0, 8.0, ROWS // 8 + 1), 8)[:ROWS]
    speed, travel = 0.0, np.zeros(ROWS)
    for k in range(1, ROWS):
        end = voltage[k - 1] / KV
        left = (speed - end) * np.exp(-rows[k] / LAG)
        travel[k] = end * rows[k] + LAG * (speed - end - left)
        speed = end + left
    if edges:
        unit = 2.0 * np.pi / edges
        travel = np.diff(np.floor(np.cumsum(travel) / unit), prepend=0.0) * unit
    mean = travel / (PERIOD if nominal else rows) + (0.0 if edges else sigma) * random.standard_normal(ROWS)
    shown = np.round(lfilter([1.0 - memory], [1.0, -memory], mean), 7)
    stamps = np.cumsum(rows) + PERIOD * late
    blank = noisy(0.5).at_rows(np.zeros(ROWS, np.int64))
    return check(replace(blank, sample_time=np.round(1e9 * stamps).astype(np.int64), voltage=voltage, speed=shown))


EVEN, ON_TIME = np.ones(ROWS), np.zeros(ROWS)
LATE = 0.3 * np.random.default_rng(2).exponential(size=ROWS).clip(0.0, 0.9)
UNEVEN = 1.0 + 0.1 * np.random.default_rng(3).uniform(-2.0, 2.0, ROWS)


def timing_of(recording: Recording) -> Timing:
    """As a first fit of kv and ka has it."""
    estimate, _ = search_globally(make_problem([recording], ()), SearchConfig())
    return find_timing([recording], estimate) or ASSUMED


@pytest.mark.parametrize("memory", keep_fast([0.0, 0.7], 0.0))
def test_the_clock_that_stamps_are_late_on_shows_in_the_motion(memory: float) -> None:
    """Smoothed or not: rows are put on an even clock, and that is said."""
    recording = logged(EVEN, LATE, memory=memory)
    found = timing_of(recording)
    assert found.rows == RowTimes(0.0) and (found.filter is not None) == (memory > 0.0)
    timed = read_again(recording, found)
    assert np.ptp(np.diff(timed.sample_time)) <= 1 and timed.info.sample_period == pytest.approx(PERIOD, rel=1e-3)
    assert any(
        note.startswith("The rows are put on a clock of 20 ms, which their stamps are off by") for note in timed.notes
    )


@pytest.mark.parametrize("memory", keep_fast([0.0, 0.7], 0.0))
def test_rows_that_go_by_their_stamps_stay(memory: float) -> None:
    """However uneven they are, smoothed or not."""
    assert timing_of(logged(UNEVEN, ON_TIME, memory=memory)).rows == AS_STAMPED


@pytest.mark.parametrize(("limit", "kept"), [(1e2, False), (1e6, True)])
def test_a_clock_has_to_be_much_likelier(limit: float, kept: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(speed_timing, "LEAST_GAIN", limit)
    found = timing_of(logged(EVEN, LATE))
    assert (found.rows == AS_STAMPED) == kept


@pytest.mark.parametrize(("of_nominal", "nominal"), [(-3.1, False), (-2.9, True)])
def test_speeds_that_a_reading_leaves_out_do_not_speak_for_it(
    of_nominal: float, nominal: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of a log with lost rows the speeds behind them were halved: off the lattice then, a tenth of all was left out."""

    class Known:
        """Likelihoods a speed, of 1500 by the stamps and of 1350 where each is divided by its own row's length."""

        def __init__(self, shaper: Shaper, timing: Timing, count: int = 0) -> None:
            self.mean = of_nominal if shaper.rows.nominal else -3.0
            self.count = count or (1350 if shaper.rows.nominal else 1500)

        def of(self, passed: SpeedFilter | None) -> float:
            return self.count * self.mean

    recording = logged(UNEVEN, ON_TIME)
    estimate, _ = search_globally(make_problem([recording], ()), SearchConfig())
    monkeypatch.setattr(speed_timing, "Likelihood", Known)
    found = find_timing([recording], estimate, filtered=False) or ASSUMED
    assert found.rows == RowTimes(None, nominal)


def test_what_was_said_of_the_rows_lengths_stays() -> None:
    """`--no-nominal-period` of an import was not kept, and a fit divided again."""
    recording = logged(UNEVEN, ON_TIME)
    said = replace(recording, info=replace(recording.info, rows_said=True))
    assert any(rows.nominal for rows in list_row_times(recording))
    assert list_row_times(said) and not any(rows.nominal for rows in list_row_times(said))
    both = [RowTimes(nominal=True).set_on(one).speed for one in (recording, said)]
    assert not np.array_equal(both[0], recording.speed) and np.array_equal(both[1], recording.speed)
    assert len(RowTimes(nominal=True).describe(recording, recording)) == 1
    assert RowTimes(nominal=True).describe(said, said) == []


@pytest.mark.slow
def test_smoothed_counts_of_uneven_rows_are_divided_by_their_lengths() -> None:
    """Once what smoothed them is undone; to the count."""
    recording = logged(UNEVEN, ON_TIME, edges=480, nominal=True, memory=0.5)
    found = timing_of(recording)
    assert found == replace(ASSUMED, filter=SpeedFilter(MEMORY, 0.5), rows=RowTimes(None, True))
    timed = read_again(recording, found)
    right = logged(UNEVEN, ON_TIME, edges=480)
    share = measure_period(np.diff(recording.time)) / PERIOD  # what a program meant by a row is not known
    assert timed.speed[1:] == pytest.approx(share * right.speed[1:], abs=1e-3)
    assert any(note.startswith("The speeds were computed as if every row took") for note in timed.notes)


@pytest.mark.slow
def test_counts_of_their_own_rows_are_not_divided_again() -> None:
    assert timing_of(logged(UNEVEN, ON_TIME, edges=480, memory=0.5)).rows == AS_STAMPED


def test_a_row_after_a_gap_keeps_its_speed() -> None:
    """Nobody knows what was counted in it."""
    lengths = EVEN.copy()
    lengths[[200, 400]] = LONGEST - 1.0, LONGEST + 1.0
    recording = logged(lengths, ON_TIME)
    timed = RowTimes(nominal=True).set_on(recording)
    factors = timed.speed[[199, 200, 400]] / recording.speed[[199, 200, 400]]
    assert factors == pytest.approx([1.0, 1.0 / (LONGEST - 1.0), 1.0], rel=1e-6)


def test_what_is_tried_depends_on_the_stamps() -> None:
    assert list_row_times(logged(EVEN, ON_TIME)) == []
    assert RowTimes(None, True) in list_row_times(logged(UNEVEN, ON_TIME))
    late = list_row_times(logged(EVEN, LATE))
    assert RowTimes(0.0) in late and RowTimes(0.0, True) not in late
    on_time = logged(EVEN, ON_TIME)
    assert RowTimes(1.0).set_on(on_time) is on_time


@pytest.mark.slow
def test_uneven_rows_that_hold_the_voltage_until_them_are_read_so() -> None:
    """A row later is not a time later: nothing was found of such a log."""
    recording = logged(UNEVEN, ON_TIME)
    late = check(replace(recording, voltage=np.append(0.0, recording.voltage[:-1])))
    found = timing_of(late)
    assert (found.window, found.lag, found.filter, found.rows) == (1.0, -0.5, None, AS_STAMPED)
    timed = read_again(late, found)
    assert np.array_equal(timed.voltage[:-1], recording.voltage[:-1]) and timed.info == recording.info
    assert any("(--voltage-before says so to an import)" in note for note in timed.notes)


@pytest.mark.parametrize("blurred", [False, True])
def test_quotients_by_lengths_that_stamps_hide_are_on_no_other_clock(
    blurred: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Stamps that were right to half a millisecond were put on an even clock, 3.5 ms off, which no option forbade."""
    late = logged(EVEN, LATE)
    found = replace(find_speed_sensor(late), blurred=blurred)
    monkeypatch.setattr(row_times, "find_speed_sensor", lambda _: found)
    assert bool(list_row_times(late)) is not blurred
