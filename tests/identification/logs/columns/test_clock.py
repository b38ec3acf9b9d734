"""The unit of times by when they are, and by how often rows come."""

import numpy as np
import pytest

from motor_identification.logs.columns.clock import are_days, can_be_longer, find_clock, guess_time_unit, runs_forward


@pytest.mark.parametrize(
    ("first", "step", "unit"),
    [
        (0.0, 0.02, "s"),
        (708.416, 0.011, "s"),
        (0.0, 0.39, "s"),
        (0.0, 1.0, "ms"),  # 1 kHz, and no log of a row a second
        (8859.0, 11.0, "ms"),
        (17800.0, 1100.0, "ms"),  # a static curve: multiples of 100 are no microseconds
        (12345678.0, 1000.0, "us"),  # however even, from anywhere on: a motor's answer tells, if one is as quick
        (17801.0, 5003.0, "us"),
        (17801.0, 5000.0, "us"),
        (17801.0, 503.0, "us"),  # unless the motion tells
        (0.0, 4900.0, "ms"),  # a static curve
        (0.0, 5000.0, "us"),  # 200 Hz of a computer that writes what it wanted
        (0.0, 390_000.0, "us"),
        (0.0, 1_000_037.0, "ns"),
        (1.76e9, 0.005, "s"),
        (1.76e12, 5.0, "ms"),
        (1.76e15, 5000.0, "us"),
        (1.76e18, 5e6, "ns"),
    ],
)
def test_units(first: float, step: float, unit: str) -> None:
    assert guess_time_unit(first + step * np.arange(100))[0] == unit


def test_times_go_on() -> None:
    even = np.arange(50.0)
    assert runs_forward(even) and runs_forward(even // 3 * 2 + even % 3) and not runs_forward(-even)
    assert not runs_forward(np.sin(even)) and not runs_forward(np.cumsum(even**2)) and not runs_forward(even[:3])


def test_a_clock_of_many_digits_may_have_late_rows() -> None:
    """As where a small computer writes its file: the clock goes on in every row, some of which take three times."""
    steps = np.full(100, 0.0061)
    steps[::6] = 0.021
    assert runs_forward(np.cumsum(steps)) and not runs_forward(np.repeat(np.cumsum(steps), 2))
    steps[::4] = 0.021
    assert not runs_forward(np.cumsum(steps))


def test_times_are_told_from_an_angle_that_goes_on_too() -> None:
    time = np.round(0.018 + np.cumsum(np.resize([0.005, 0.006, 0.006, 0.007], 300)), 3)
    angle = np.floor(400.0 * (time + 0.05 * np.exp(-20.0 * time) - 0.05))
    assert runs_forward(angle), "it can be one"
    assert find_clock({"angle": angle, "time": time}) == "time" == find_clock({"time": time, "angle": angle})
    assert find_clock({"angle": -angle, "down": -time}) is None and find_clock({}) is None
    even = np.arange(300.0)
    assert find_clock({"uneven": even + 0.4 * (even % 2), "even": even}) == "even"
    twice = np.round(np.arange(300) * 0.01 - 0.004, 2)
    twice[7] = twice[6]  # a clock of whole hundredths says one of them twice
    counts = np.cumsum(np.concatenate([np.arange(1.0, 49.0), np.full(252, 48.0)]))
    assert find_clock({"counts": counts, "time": twice}) == "time"


@pytest.mark.parametrize("time_constant", [30.0, 100.0])
def test_whole_milliseconds_are_told_from_counts_that_go_on_as_evenly(time_constant: float) -> None:
    """As of a LEGO motor that starts: 3 and 4 ms in turn, two degrees in nearly every row, and pauses."""
    time = np.floor(5027.0 + 3.35 * np.arange(300) + 200.0 * (np.arange(300) // 120))
    since = time - time[0]
    angle = np.floor(0.56 * (since + time_constant * (np.exp(-since / time_constant) - 1.0)))
    assert find_clock({"angle": angle, "time": time}) == "time" == find_clock({"time": time, "angle": angle})


@pytest.mark.parametrize(
    ("first", "step", "days"),
    [
        (45_413.5, 0.01 / 86_400.0, True),
        (739_007.5, 0.3 / 86_400.0, True),
        (45_413.5, 0.5 / 86_400.0, False),  # slower than a log of motion
        (1000.0, 1e-7, False),
        (45_413.5, 0.01, False),  # seconds
        (1e5, 1e-7, False),
    ],
)
def test_days(first: float, step: float, days: bool) -> None:
    assert are_days(first + step * np.arange(100)) is days


def test_an_angle_as_even_as_the_clock_is_told_by_its_first_rows() -> None:
    """As of a step that stayed for 4 s: whatever the clock is late by, the angle is, too."""
    for seed in range(8):
        rows = np.random.default_rng(seed).uniform(0.004, 0.006, 1500)
        exact = np.cumsum(rows) - rows[0]
        time, angle = np.round(0.02 + exact, 3), np.floor(3280.0 * (exact - 0.01 * (1.0 - np.exp(-100.0 * exact))))
        assert runs_forward(angle) and find_clock({"angle": angle, "time": time}) == "time"
    running = 820.0 * (np.arange(300) * 0.005) + 0.3 * np.sin(np.arange(300.0))
    assert find_clock({"angle": running, "time": np.arange(300) * 0.005}) == "time", "one that ran already is less even"
    uneven = np.concatenate((np.full(20, 0.012), np.full(200, 0.006)))  # a program that was slow at first
    time = np.cumsum(uneven) - 0.012
    angle = np.rint(500.0 * (time - 0.08 * (1.0 - np.exp(-time / 0.08))))
    assert runs_forward(angle) and find_clock({"angle": angle, "time": time + 0.02}) == "time"
    coasting = np.cumsum(np.linspace(9.0, 4.0, 300))
    assert find_clock({"coasting": coasting, "time": np.arange(300) * 0.005}) == "time", "it was fast at first"
    late = np.concatenate(([0.0, 0.001, 0.002, 0.003], 0.01 * np.arange(1.0, 300.0)))
    assert find_clock({"late": late}) == "late"


def test_ticks_of_four_microseconds_are_no_milliseconds() -> None:
    """As an Arduino's micros() counts, logged in a loop that is as fast as it can be."""
    steps = np.resize([364.0, 368.0, 360.0, 404.0, 412.0, 364.0, 2576.0], 200)
    unit, why = guess_time_unit(np.cumsum(steps))
    assert unit == "us" and why.startswith("all are multiples of 4")
    for other in (
        np.cumsum(steps) + 1.0,
        np.cumsum(np.resize([364.0, 368.0, 360.0], 200)),  # few kinds of steps
        np.cumsum(steps)[:40],  # few rows
        np.cumsum(np.resize([40.0, 48.0, 56.0, 64.0, 80.0, 88.0], 200)),  # all multiples of 8
        np.cumsum(np.resize([4.0, 4.0, 4.0, 8.0, 12.0, 16.0, 20.0, 4.0], 200)),  # 250 Hz, of which rows are missing
    ):
        assert guess_time_unit(other)[0] == "ms"


def test_what_nothing_but_its_rows_tells_may_be_in_a_longer_unit() -> None:
    assert can_be_longer(503.0 * np.arange(100)) and can_be_longer(0.5 * np.arange(100))
    assert not can_be_longer(1.76e12 + 5.0 * np.arange(100))
    assert not can_be_longer(np.cumsum(np.resize([364.0, 368.0, 360.0, 404.0, 412.0, 364.0, 2576.0], 200)))
