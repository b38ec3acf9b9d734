"""What a column of motion holds, by its numbers alone."""

from math import tau

import numpy as np
import pytest

from motor_identification.logs.columns.motion.movement import (
    OF_COUNTS,
    guess_kind,
    guess_position_unit,
    guess_speed_unit,
    is_encoders_angle,
    is_kind_sure,
)
from motor_identification.logs.form import UNITS, Kind

RANDOM = np.random.default_rng(5)
DRIVE = np.repeat(RANDOM.choice([-3.0, 2.0, 5.0], 40), 25)


def speeds() -> "np.ndarray[tuple[int], np.dtype[np.float64]]":
    """[rad/s] of a first-order motor at 100 Hz, with a time constant of 60 ms."""
    speed = np.zeros(len(DRIVE))
    for k in range(1, len(DRIVE)):
        speed[k] = speed[k - 1] + (DRIVE[k - 1] / 0.05 - speed[k - 1]) * (1.0 - np.exp(-0.01 / 0.06))
    return speed


def test_a_speed_forgets_and_a_position_does_not() -> None:
    assert guess_kind(speeds(), DRIVE) is Kind.SPEED
    assert guess_kind(np.cumsum(speeds()) * 0.01, DRIVE) is Kind.POSITION
    assert guess_kind(np.cumsum(np.abs(speeds())) * 0.01, np.abs(DRIVE)) is Kind.POSITION


def test_a_short_run_may_be_of_either() -> None:
    assert is_kind_sure(speeds(), DRIVE) and is_kind_sure(np.cumsum(speeds()) * 0.01, DRIVE)
    few = slice(0, 25)  # a quarter of a second, four time constants
    assert not is_kind_sure(speeds()[few], DRIVE[few])
    angle = np.zeros(len(DRIVE))  # a controlled position: as slow a loop forgets as a speed does
    for k in range(1, 500):
        angle[k] = angle[k - 1] + 0.02 * (1.0 - angle[k - 1])
    assert guess_kind(angle[:500], DRIVE[:500]) is Kind.SPEED and not is_kind_sure(angle[:500], DRIVE[:500])


@pytest.mark.parametrize(("other", "sure"), [(0.0, False), (1.0, True)])
def test_under_a_proportional_controller_nobody_knows_which_it_is(other: float, sure: bool) -> None:
    """A camera's head that came to 105 degrees at no voltage was asked for a speed's unit."""
    angle = 105.0 * (1.0 - np.exp(-np.arange(80) / 3.0))
    effort = 0.1 * (110.0 - angle) + other * np.sin(np.arange(80))
    assert guess_kind(angle, effort) is Kind.SPEED and is_kind_sure(angle, effort) == sure


@pytest.mark.parametrize("unit", ["rad/s", "deg/s", "rpm"])
def test_the_unit_of_speeds_by_the_counts_of_a_turn(unit: str) -> None:
    """Counts of 97 or 2,800 a turn within 10 ms; what is whole in rpm is so in deg/s too, six times as much."""
    size = UNITS[Kind.SPEED][unit] or 0.0
    for edges in (97, 2800):
        values = np.rint(speeds() * 0.01 * edges / tau) * tau / edges / 0.01 / size
        found = guess_speed_unit(np.round(values, 8), 0.01)
        if unit == "rpm":
            assert found.name == "" and found.candidates == ("deg/s", "rpm")
        else:
            assert found.name == unit and f"{edges} counts a turn in {unit}" in found.why


def test_speeds_without_counts_do_not_tell_their_unit() -> None:
    for values in (speeds(), np.round(speeds(), 1), speeds()[:10]):
        found = guess_speed_unit(values, 0.01)
        assert found.name == "" and found.candidates == ("rad/s", "deg/s", "rpm")
    counted = np.rint(speeds() * 0.01 * 360 / tau) * tau / 360 / 0.01 * 60 / tau  # 360 a turn: 2,160 in deg/s
    assert set(guess_speed_unit(counted, 0.01).candidates) == {"deg/s", "rpm"}


@pytest.mark.parametrize(
    ("step", "window", "of_counts"),
    [(100.0, 0.01, True), (100.0, 0.00998, True), (100.0 / 3.0, 0.03, True), (50.0, 0.01, False), (1.0, 1.0, False)],
)
def test_one_of_a_unit_within_a_window_is_a_count_of_it(step: float, window: float, of_counts: bool) -> None:
    """Nobody prints hundreds alone; whole numbers may be digits."""
    found = guess_speed_unit(step * np.rint(speeds() * 0.5), window)
    assert found.name == "" and (found.candidates == OF_COUNTS) == of_counts


@pytest.mark.parametrize(
    ("edges", "scatter", "unit"),
    [
        (360, 3e-5, "rad/s"),
        (5056, 3e-5, ""),
        (4096, 3e-5, "rad/s"),
        (341, 1e-4, "rad/s"),
        (12, 2e-2, "rad/s"),
        (341, 4e-3, ""),
    ],
)
def test_many_counts_tell_no_unit_where_rows_are_not_that_regular(edges: int, scatter: float, unit: str) -> None:
    """Steps of 843 a turn in rpm were 5,056 in deg/s, to a tenth of one; the mean of many rows is known better."""
    lengths = 0.01 * (1.0 + np.random.default_rng(1).normal(0.0, scatter, len(DRIVE)))
    values = np.rint(speeds() * 0.01 * edges / tau) * tau / edges / 0.01
    values *= 1.0 if unit else 360 / tau
    assert guess_speed_unit(values, 0.01).name
    assert guess_speed_unit(values, 0.01, np.cumsum(lengths)).name == unit


def test_the_unit_of_positions_by_wraps_and_steps() -> None:
    angle = np.cumsum(speeds()) * 0.01
    assert guess_position_unit(np.cumsum(np.abs(speeds())) * 0.01 % tau).name == "rad"
    assert guess_position_unit(np.degrees(np.cumsum(np.abs(speeds())) * 0.01) % 360).name == "deg"
    assert guess_position_unit(np.rint(angle * 1440 / tau) * tau / 1440).name == "rad"
    assert guess_position_unit(np.rint(angle * 1440 / tau) * 360 / 1440).name in ("deg", "")
    assert guess_position_unit(np.rint(angle * 97 / tau) * 360 / 97).name == "deg"
    assert guess_position_unit(np.rint(np.degrees(angle))).candidates == ("count", "deg")
    assert guess_position_unit(angle).candidates == ("rad", "deg", "rev", "count")
    six = np.round(np.rint(angle * 6 / tau) / 6, 5)  # of three magnets, or 2,160 counts in degrees
    assert guess_position_unit(six).candidates == ("deg", "rev")


def test_steps_too_coarse_for_a_turn_in_other_units_are_degrees() -> None:
    """A potentiometer on ten turns of a converter's 1,024 steps, in degrees: 1.8 of them a turn if it were in rad."""
    levels = np.rint(np.cumsum(speeds()) * 0.02)
    found = guess_position_unit(np.round(levels * 3600.0 / 1024.0, 2))
    assert found.name == "deg" and "102.4 counts a turn in deg, and fewer than 8 in other units" in found.why
    fine = guess_position_unit(np.round(levels * 0.7 * tau / 8.0, 4))  # 11 of them a turn in rad: it may be either
    assert fine.name == "" and fine.candidates == ("rad", "deg", "rev", "count")


@pytest.mark.parametrize(("counts", "name"), [(6, ""), (2, "deg")])
def test_steps_of_so_few_counts_a_turn_may_be_radians(counts: int, name: str) -> None:
    """Six counts a turn in rad are 343.8 a turn if they were degrees; of two, no encoder is made."""
    levels = np.rint(np.cumsum(speeds()) * 0.02)
    found = guess_position_unit(np.round(levels * tau / counts, 5))
    assert found.name == name
    if not name:
        assert found.candidates == ("rad", "deg", "rev", "count")


def test_counts_that_are_nearly_whole_by_chance_tell_no_unit() -> None:
    """A LEGO motor of 114.703 counts a turn, in rad with four digits: 6572.016 counts a turn if it were in degrees."""
    step = 0.0547777
    values = np.round(np.cumsum(RANDOM.integers(0, 3, 800)) * step, 4)
    assert guess_position_unit(values).name == ""
    right = np.round(np.cumsum(RANDOM.integers(0, 3, 800)) * 360.0 / 6572, 4)
    assert guess_position_unit(right).name == "deg"


def test_every_second_or_fifth_digit_is_a_printed_one_too() -> None:
    counts = RANDOM.integers(0, 100, 800)
    for step in (0.1, 0.2, 0.05):
        assert guess_speed_unit(counts * step, 0.004).name == "", "0.2 rad/s in 4 ms: 7853.98 counts a turn"
    assert guess_speed_unit(counts * tau / 2800 / 0.004, 0.004).name == "rad/s"


def test_an_encoders_angle_in_rad_is_no_voltage() -> None:
    way = np.cumsum(np.random.default_rng(3).integers(-2, 6, 2000))
    for counts, told in ((1000, True), (4096, True), (4100, False)):
        assert is_encoders_angle(way * tau / counts) is told
    for step in (0.01, 12.0 / 255.0, 5.0 / 1024.0):
        assert not is_encoders_angle(way * step)
    assert not is_encoders_angle(np.repeat([0.0, 5.0, 0.0], 100)), "a step of 5 V is no wrap"


@pytest.mark.parametrize("still", [0, 90])
def test_a_standstill_before_a_single_step_tells_nothing_of_the_kind(still: int) -> None:
    """A log of one step begins a second before it, in a program that logs no drive: 4 V were said for all rows."""
    speed = 5.0 * (1.0 - np.exp(-np.arange(90.0) / 5.0))
    speed = np.concatenate((np.zeros(still), 0.18 * np.rint(speed / 0.18 + 0.4 * np.sin(np.arange(90.0) * 2.4))))
    drive = np.full(90 + still, 4.0)
    assert guess_kind(speed, drive) is Kind.SPEED
    assert guess_kind(np.cumsum(speed), drive) is Kind.POSITION
