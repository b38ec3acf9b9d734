"""The lattice that positions lie on."""

import numpy as np
import pytest

from motor_identification.logs.position_lattice import LEAST_LEVELS, find_position_lattice, position_step, printed_digit

MOTION = np.cumsum(np.random.default_rng(2).integers(-3, 9, 400))


@pytest.mark.parametrize("step", [0.9, 1.0, 360 / 2800, 1 / 8192])
def test_the_step_of_positions_with_printed_digits(step: float) -> None:
    assert position_step(np.round(MOTION * step, 7)) == pytest.approx(step, rel=1e-5)
    assert position_step(MOTION[: LEAST_LEVELS - 1] * 1.0) == 0.0


@pytest.mark.parametrize("step", [30.0, 360 / 20])
def test_positions_of_a_fast_shaft_are_never_one_step_apart(step: float) -> None:
    """Of 12 counts a turn, 23 to 28 a row."""
    way = np.random.default_rng(4).integers(23, 29, 400)
    way[:20] = np.arange(20) + 4
    moved = np.cumsum(way) * step
    assert position_step(moved) == pytest.approx(step, rel=1e-9)
    beside = moved + step * np.random.default_rng(5).uniform(-0.2, 0.2, 400)
    assert position_step(beside) == 0.0


def test_positions_without_steps_have_none() -> None:
    assert position_step(np.cumsum(np.random.default_rng(3).normal(1.0, 0.3, 400))) == 0.0


def test_the_step_of_rounded_digits_is_as_sure_as_it_says() -> None:
    """54 levels of 3.515625 deg with two digits: uniform rounding leaves 0.01/√12/√(Σ(n − n̄)²) = 2.5e-5 deg."""
    lattice = find_position_lattice(np.round(np.arange(-26, 28) * 3.515625, 2))
    assert lattice is not None and lattice.error == pytest.approx(2.5e-5, rel=0.2)
    assert abs(lattice.step - 3.515625) < 2.0 * lattice.error
    assert lattice.holds(np.array([35.16, -7.03])) and not lattice.holds(np.array([35.56]))


@pytest.mark.parametrize(("largest", "found"), [(1e99, True), (1e101, False), (9e307, False), (float("inf"), False)])
def test_numbers_whose_squares_are_none_have_no_lattice(largest: float, found: bool) -> None:
    values = np.append(np.arange(20.0), largest) if largest > 1e100 else np.arange(20.0) * largest / 20.0
    assert (find_position_lattice(values) is not None) == found


@pytest.mark.parametrize(("digits", "found"), [(2, True), (1, False)])
def test_steps_of_a_magnetic_encoder_in_printed_digits(digits: int, found: bool) -> None:
    """4096 a turn, 0.0879 deg: with two digits neighbours are 0.08, 0.09 or 0.1 apart; one digit leaves no lattice."""
    numbers = np.random.default_rng(6).integers(0, 4096, 300)
    lattice = find_position_lattice(np.round(numbers * 360.0 / 4096, digits))
    assert (lattice is not None and lattice.step == pytest.approx(360 / 4096, rel=1e-5)) == found


@pytest.mark.parametrize(("values", "digit"), [([1.25, 3.5], 0.01), ([30.0, 7.0], 1.0), ([0.1234567], 0.0)])
def test_the_last_digit_that_was_printed(values: list[float], digit: float) -> None:
    assert printed_digit(np.array(values)) == pytest.approx(digit)


def test_an_even_motion_is_no_lattice_of_its_ways() -> None:
    """All ways from row to row are within 8 % of each other, and add up to anything."""
    assert position_step(np.cumsum(np.random.default_rng(8).uniform(9.6, 10.4, 300))) == 0.0


@pytest.mark.parametrize("unit", [1.0, 0.1, 0.01])
@pytest.mark.parametrize("ways", [(2, 3, 5, 6, 7, 8, 9), (4, 5), (5, 6, 8), (7,)])
def test_the_step_of_a_motor_that_runs_evenly(ways: tuple[int, ...], unit: float) -> None:
    """As of whole degrees in each row: they are few different ones, of which none is the step."""
    moved = np.cumsum(np.random.default_rng(9).choice(ways, 168))
    expected = 1.0 if len(ways) > 1 else 7.0
    assert position_step(np.round(moved * unit, 3)) == pytest.approx(expected * unit, rel=1e-9)
    assert position_step(np.round(moved * unit, 3)[: LEAST_LEVELS - 1]) == 0.0


def test_few_ways_that_nothing_was_printed_of_are_no_lattice() -> None:
    moved = np.cumsum(np.random.default_rng(9).choice([np.sqrt(2.0), np.sqrt(3.0)], 168))
    assert position_step(moved) == 0.0 == position_step(np.cumsum(np.resize([2e30, 3e30], 60)))
