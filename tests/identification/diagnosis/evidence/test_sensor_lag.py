"""A sensor may lag that nobody described, unless its values are counts of a row each or times between edges."""

from dataclasses import replace

import numpy as np
from recorded import as_speed, without_count
from scipy.signal import lfilter
from swinging import noisy, recorded

from motor_identification.diagnosis.evidence.sensor_lag import may_lag
from motor_identification.recording import Recording, check
from motor_identification.sensor.speed_sensor import MOST_COUNTS
from motor_identification.timing.speed_filter import MEMORY, SpeedFilter
from motor_identification.timing.timing import ASSUMED, OTHERS, Timing


def lags(recording: Recording, timing: Timing = ASSUMED) -> bool:
    return may_lag([recording], timing.set_on([recording]))


def test_a_speed_with_noise_may_have_been_smoothed_unless_it_was_said_how_it_was_made() -> None:
    recording = check(noisy(0.5))
    assert lags(recording) and lags(recording, OTHERS[0])
    for said in ({"speed_window": 0.03}, {"speed_lag": 0.0}, {"edges_per_revolution": 96}):
        assert not lags(replace(recording, info=replace(recording.info, **said)))


def test_what_passed_a_filter_may_have_passed_another() -> None:
    smoothed = replace(recording := check(noisy(0.5)), speed=lfilter([0.5], [1.0, -0.5], recording.speed))
    assert lags(smoothed, replace(ASSUMED, filter=SpeedFilter(MEMORY, 0.5)))


def test_counts_and_times_between_edges_are_told() -> None:
    counted = without_count(as_speed(recorded(edges=96)))
    assert not lags(counted)
    smoothed = replace(counted, speed=np.round(lfilter([0.5], [1.0, -0.5], counted.speed), 5))
    assert lags(smoothed) and not lags(smoothed, replace(ASSUMED, filter=SpeedFilter(MEMORY, 0.5)))
    assert not lags(check(noisy(0.5)), replace(OTHERS[0], slot=0.1))


def in_steps(turn: float, noise: float) -> Recording:
    """Up to 100 steps of which a turn has so many in a row, with so much noise [steps]."""
    exact = check(noisy(0.0))
    step = 2.0 * np.pi / turn / exact.info.sample_period
    share = exact.speed / np.max(np.abs(exact.speed))
    values = np.round(100.0 * share + noise * np.random.default_rng(1).standard_normal(len(share)))
    return replace(exact, speed=step * values)


def test_steps_that_may_be_a_converters_are_not_told() -> None:
    """More of them a turn than an encoder has; or no whole number of them, noisier than counts are."""
    assert lags(in_steps(2.3 * MOST_COUNTS, 0.2)) and not lags(in_steps(0.2 * MOST_COUNTS, 0.2))
    assert lags(in_steps(0.2 * MOST_COUNTS + 0.3, 2.6)) and not lags(in_steps(0.2 * MOST_COUNTS + 0.3, 0.2))
