"""A timing reads speeds as they were made, where nobody said otherwise, and says so."""

from dataclasses import replace

import numpy as np
import pytest
from swinging import noisy, recorded

from motor_identification.recording import check
from motor_identification.timing.speed_filter import MEAN, MEMORY, SpeedFilter
from motor_identification.timing.timing import ASSUMED, INSTANT, Timing, read_again


def test_what_was_said_of_a_recording_to_validate_by_is_believed_too() -> None:
    plain = check(noisy(0.05, 1))
    said = replace(plain, info=replace(plain.info, edges_per_revolution=960))
    open_one, other = Timing(INSTANT, 0.0, "values").set_on([check(noisy(0.05)), said])
    assert open_one.info.speed_lag == 0.0 and other is said
    assert Timing(INSTANT, 0.0, "values").set_on([said]) == (said,)


def test_a_timing_is_set_on_every_recording_and_said_of_the_first() -> None:
    first, second = Timing(INSTANT, 0.0, "values").set_on([noisy(1.0), noisy(1.0, 1)])
    assert first.info.speed_window == second.info.speed_window == pytest.approx(0.0004)
    assert first.info.speed_lag == second.info.speed_lag == 0.0
    assert second.notes == noisy(1.0, 1).notes and "taken as values" in first.notes[-1]
    assert "--speed-window 0.0004 --speed-lag 0 " in first.notes[-1]


def test_a_converters_steps_are_said_to_be_read_at_once() -> None:
    """Not that means fit worse, which these may not."""
    plain = noisy(1.0)
    steps = replace(plain, speed=5.0 / 1023.0 * np.rint(plain.speed / 0.05))
    said = Timing(INSTANT, 0.0, "values").set_on([steps])[0].notes[-1]
    assert "taken as values, as a converter reads them" in said and "--speed-window 0.0004 --speed-lag 0 " in said


def test_smoothed_speeds_are_read_as_what_was_smoothed() -> None:
    """The filter y = m·y + (1 − m)·x undone, to the last digit; edges have nothing that was smoothed."""
    logged = noisy(0.3)
    smooth = logged.speed.copy()
    for k in range(1, len(smooth)):
        smooth[k] = 0.8 * smooth[k - 1] + 0.2 * logged.speed[k]
    timing = replace(ASSUMED, filter=SpeedFilter(MEMORY, 0.8))
    read = read_again(replace(logged, speed=smooth), timing)
    assert read.speed == pytest.approx(logged.speed, abs=1e-9) and read.info == logged.info
    assert read.notes[-1].startswith("The speeds are smoothed: each keeps 0.8 of the one before, a filter of 89.6 ms")
    assert read_again(logged, None) is logged
    stamped = recorded()
    assert read_again(stamped, timing) == stamped


def test_what_a_mean_leaves_of_its_delay_is_in_the_lag_of_what_went_in() -> None:
    logged = noisy(0.3)
    passed = SpeedFilter(MEAN, 10)
    mean = replace(logged, speed=np.convolve(logged.speed, np.full(10, 0.1))[: len(logged)])
    lag = read_again(mean, replace(ASSUMED, filter=passed)).info.speed_lag
    assert lag - logged.info.speed_lag == pytest.approx(passed.measure_delay_left(mean.speed) * 0.02) and lag > 0.0105
