"""What went into a filter is computed from what came out, whichever filter it was."""

import numpy as np
import pytest
from scipy.signal import butter, group_delay, lfilter

from motor_identification.recording import Floats
from motor_identification.timing import speed_filter
from motor_identification.timing.speed_filter import (
    BILINEAR,
    BUTTERWORTH,
    KINDS,
    MEAN,
    MEMORY,
    TWICE,
    SpeedFilter,
    parse_filter,
    undo_mean,
)
from motor_model.errors import ModelError

# As programs have them: numerator and denominator, powers of 1/z ascending.
PROGRAMS = {
    (MEMORY, 0.8): ([0.2], [1.0, -0.8]),
    (TWICE, 0.6): ([0.16], [1.0, -1.2, 0.36]),
    (BILINEAR, 0.854): ([0.073, 0.073], [1.0, -0.854]),
    (BUTTERWORTH, 0.8): butter(2, 0.2),
    (MEAN, 2): ([0.5, 0.5], [1.0]),
    (MEAN, 10): (np.full(10, 0.1), [1.0]),
}
NOISE, ROUND = 1.0, 1e-4


def motion() -> Floats:
    """A motor's answer to steps, from a standstill on, with white noise."""
    steps = np.repeat(np.append(0.0, np.random.default_rng(3).uniform(-100.0, 100.0, 99)), 30)
    noise = NOISE * np.random.default_rng(4).standard_normal(3000)
    return np.asarray(lfilter([0.05], [1.0, -0.95], steps) + np.where(np.arange(3000) < 30, 0.0, noise))


@pytest.mark.parametrize(("kind", "number"), PROGRAMS)
def test_what_went_in_is_computed_from_rounded_digits(kind: str, number: float) -> None:
    """Of poles to those digits; of a mean but for a part of the noise that gets lost at its zeros."""
    went_in = motion()
    came_out = np.round(lfilter(*PROGRAMS[kind, number], went_in) / ROUND) * ROUND
    beside = SpeedFilter(kind, number).undo(came_out) - went_in
    assert np.sqrt(np.mean(beside**2)) < (0.5 if KINDS[kind].means(number) else 0.1) * NOISE
    assert abs(np.mean(beside)) < 0.02 * NOISE


@pytest.mark.parametrize(("rows", "digit"), [(2, 0.1), (10, 0.02)])
def test_a_mean_is_taken_back_wherever_a_log_begins(rows: int, digit: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of rounded digits: zeros on the circle itself would keep every one of them for ever."""
    went_in = motion()
    came_out = np.round(lfilter(*PROGRAMS[MEAN, rows], went_in) / digit) * digit

    def miss(some: slice) -> float:
        beside = undo_mean(came_out[1000:], rows) - went_in[1000:]
        return float(np.sqrt(np.mean(beside[some] ** 2)))

    assert miss(slice(0, 100)) < 0.7 * NOISE and miss(slice(1500, None)) < 0.4 * NOISE
    monkeypatch.setattr(speed_filter, "FORGOTTEN", 0.0)
    assert miss(slice(1500, None)) > 0.5 * NOISE


@pytest.mark.parametrize(("kind", "number"), PROGRAMS)
def test_delay_density_and_likeness_are_those_of_the_program(kind: str, number: float) -> None:
    numerator, denominator = PROGRAMS[kind, number]
    passed = SpeedFilter(kind, number)
    late = group_delay((numerator, denominator), w=[1e-3])[1][0]
    assert passed.delay == pytest.approx(late, rel=0.05)
    assert passed.log_first == pytest.approx(np.log(numerator[0]), abs=0.06)
    white = lfilter(numerator, denominator, np.random.default_rng(1).standard_normal(200_000))
    assert passed.log_likeness == pytest.approx(np.log(np.std(white) / numerator[0]), abs=0.06)


@pytest.mark.parametrize(
    ("kind", "number", "text"),
    [
        (MEMORY, 0.8, "each keeps 0.8 of the one before, a filter of 22.4 ms"),
        (TWICE, 0.6, "twice, and each keeps 0.6 of the one before, a filter of 9.79 ms"),
        (BILINEAR, 0.854, "each keeps 0.854 of the one before, a low-pass of 5 Hz by the bilinear transform"),
        (BUTTERWORTH, 0.8, "by a Butterworth filter of second order with a corner of 20 Hz"),
        (MEAN, 10.0, "each is the mean of 10 rows, over 50 ms"),
    ],
)
def test_a_filter_is_said_and_read_again(kind: str, number: float, text: str) -> None:
    """At 200 Hz."""
    passed = SpeedFilter(kind, number)
    assert passed.describe(0.005) == text
    assert parse_filter(str(passed)) == passed


@pytest.mark.parametrize(
    "text", ["memory 1", "memory 0", "memory", "mean 1", "mean 65", "mean 2.5", "kalman 0.3", "bilinear nan", "twice x"]
)
def test_what_is_no_filter_is_refused(text: str) -> None:
    with pytest.raises(
        ModelError, match=r"^speed_filter is '.*', and must be 'mean' and 2 to 64 rows, or one of memory,"
    ):
        parse_filter(text)
    assert parse_filter("") is None and parse_filter("mean 64") == SpeedFilter(MEAN, 64)


@pytest.mark.parametrize("rows", [2, 10])
def test_a_mean_of_counts_is_taken_back_to_the_count(rows: int) -> None:
    """Also where the log begins while the motor turns; forgetting zeros were off by a part of a count for long."""
    counts = np.diff(np.floor(np.cumsum(3.0 + 2.0 * np.sin(np.arange(2000) / 150.0))))
    means = lfilter(*PROGRAMS[MEAN, rows], counts)
    for begin in (0, 500):
        assert undo_mean(np.round(means[begin:], 6), rows)[rows:] == pytest.approx(counts[begin + rows :], abs=1e-4)


def test_digits_are_no_counts_of_a_mean(monkeypatch: pytest.MonkeyPatch) -> None:
    """They would walk away: kept as counts where every walk is allowed."""
    went_in = motion()
    came_out = np.round(lfilter(*PROGRAMS[MEAN, 2], went_in) / 0.1) * 0.1
    right = np.std(undo_mean(came_out, 2) - went_in)
    monkeypatch.setattr(speed_filter, "WALK", 100.0)
    assert np.std(undo_mean(came_out, 2) - went_in) > 2.0 * right


@pytest.mark.parametrize(("rows", "late"), [(2, 0.0064), (6, 0.0249), (20, 0.0853)])
def test_what_is_computed_back_of_a_mean_is_as_late_as_its_zeros_are_pulled_in(rows: int, late: float) -> None:
    """A transport delay of half a millisecond was made of it. Counts are computed back to the row."""
    passed = SpeedFilter(MEAN, rows)
    went_in = 0.1 * np.arange(4000.0) + 0.0137 * np.sin(np.arange(4000.0))
    came_out = lfilter(np.full(rows, 1.0 / rows), [1.0], went_in)
    assert passed.measure_delay_left(came_out) == pytest.approx(late, rel=0.03)
    lag = went_in - passed.undo(came_out)
    assert np.mean(lag[2000:]) / 0.1 == pytest.approx(late, rel=0.03)
    counts = np.floor(20.0 + 15.0 * np.sin(np.arange(4000.0) / 90.0) + np.random.default_rng(1).uniform(0.0, 1.0, 4000))
    counts[:rows] = 0.0
    assert passed.measure_delay_left(lfilter(np.full(rows, 1.0 / rows), [1.0], counts)) == 0.0
    assert SpeedFilter(MEMORY, 0.8).measure_delay_left(came_out) == 0.0
