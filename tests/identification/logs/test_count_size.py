"""How large one count is."""

from dataclasses import replace
from fractions import Fraction
from math import radians

import numpy as np
import pytest

from motor_identification.logs.count_size import FEWEST_COUNTS, FINE, count_size, doubt_counts, doubt_unit, doubt_window
from motor_identification.logs.form import CsvForm, Kind
from motor_model.errors import RecordingError
from motor_model.gearing.gear import edge_angle, exact_gear

DEGREES = CsvForm("t", "u", "y", Kind.POSITION, "deg")
MOTION = np.cumsum(np.random.default_rng(2).integers(-3, 9, 400))


def test_positions_without_steps_have_none() -> None:
    smooth = np.cumsum(np.random.default_rng(3).normal(1.0, 0.3, 400))
    count = count_size(DEGREES, smooth, np.zeros(400))
    assert FINE[0] <= count.edges <= FINE[1] and count.size == pytest.approx(360 / count.edges)
    assert "show no steps" in count.how and count.stands_for


def test_a_step_that_is_a_whole_share_of_a_turn_is_the_count() -> None:
    count = count_size(DEGREES, MOTION * 0.9, np.zeros(400))
    assert (count.size, count.edges, count.gear) == (pytest.approx(0.9), 400, 1)


def test_a_step_that_is_no_whole_share_of_a_turn_is_the_count_of_a_geared_encoder() -> None:
    """A potentiometer of ten turns on a converter of 10 bits, printed with two digits: least squares has its step."""
    printed = np.round(MOTION * 3.515625, 2)
    count = count_size(DEGREES, printed, np.zeros(400))
    assert (count.edges, count.gear, count.per_turn) == (102, Fraction(256, 255), 102.4)
    assert count.size == pytest.approx(3.515625, rel=1e-15)
    assert edge_angle(count.edges, exact_gear(float(count.gear))) == pytest.approx(radians(3.515625), rel=1e-15)
    assert count.how == " (assumed: values are multiples of it)" and not count.stands_for


@pytest.mark.parametrize(("turn", "edges"), [(7.9, 16), (7.6, 15), (3.3, 10), (0.7, 8), (8.4, 8)])
def test_coarse_steps_are_slots_of_a_slower_encoder(turn: float, edges: int) -> None:
    moved = np.cumsum(np.random.default_rng(2).integers(-1, 3, 400)) * 360.0 / turn
    count = count_size(DEGREES, moved, np.zeros(400))
    assert count.edges * float(count.gear) == pytest.approx(turn, rel=1e-9)
    assert count.edges == edges >= FEWEST_COUNTS


@pytest.mark.parametrize(("way", "kept"), [(29, True), (31, False)])
def test_a_lattice_too_fine_to_matter_is_stood_for_by_coarser_counts(way: int, kept: bool) -> None:
    moved = np.cumsum(np.where(np.arange(600) % 20 == 0, 1, way)) * 360.0 / 1496.6
    count = count_size(DEGREES, moved, np.zeros(600))
    assert (count.per_turn == 1496.6) is kept and count.stands_for is not kept
    assert kept or (count.edges == 1400 and "no whole share of a turn" in count.how)


def test_a_lattice_beside_zero_is_counted_from_where_it_is() -> None:
    count = count_size(DEGREES, MOTION * 3.515625 + 1.7, np.zeros(400))
    assert count.origin == pytest.approx(1.7)
    assert count_size(DEGREES, MOTION * 3.515625 + 0.17, np.zeros(400)).origin == 0.0  # 0.048 counts


@pytest.mark.parametrize(("said", "taken"), [(3.515625, True), (3.5156, True), (3.5160, False), (3.4, False)])
def test_a_count_that_was_said_and_is_no_whole_share_is_that_of_the_values(said: float, taken: bool) -> None:
    form = replace(DEGREES, count_quantum=said)
    printed = np.round(MOTION[:60] * 3.515625, 2)
    if taken:
        assert count_size(form, printed, np.zeros(60)).size == pytest.approx(said, rel=1e-9)
    else:
        with pytest.raises(RecordingError, match=r"per revolution, not a whole number: check --count-quantum"):
            count_size(form, printed, np.zeros(60))


def test_a_said_count_that_drifts_off_the_values_is_refused() -> None:
    far = np.cumsum(np.random.default_rng(2).integers(-3, 19, 900)) * 3.515625
    assert count_size(replace(DEGREES, count_quantum=3.515625), far, np.zeros(900)).edges == 102
    with pytest.raises(RecordingError, match="not a whole number"):
        count_size(replace(DEGREES, count_quantum=3.51555), far, np.zeros(900))  # 2e-5 of 7000 counts


@pytest.mark.parametrize(("offset", "seen"), [(0.0, True), (0.3, False)])
def test_a_fast_shaft_shows_its_counts_within_a_turn(offset: float, seen: bool) -> None:
    """A quarter of a turn a row, 4096 counts a turn: no two of all angles are near each other; modulo 360 they are."""
    numbers = np.cumsum(np.random.default_rng(7).integers(1000, 1200, 300))
    turning = np.round(numbers % 4096 * 360.0 / 4096, 2) + 360.0 * (numbers // 4096)
    levels = turning % 360.0
    assert count_size(DEGREES, turning, np.zeros(300)).stands_for
    count = count_size(DEGREES, turning + offset * 360.0 / 4096 * (numbers % 3), np.zeros(300), levels)
    assert (count.edges == 4096 and not count.stands_for) == seen


@pytest.mark.parametrize(("far", "seen"), [(114.0, False), (0.9, True)])
def test_the_rounding_of_numbers_of_32_bits_is_no_encoders_step(far: float, seen: bool) -> None:
    """Of a position of a hundred turns as ODrive prints it, the last digits are 131,072 a turn."""
    turns = CsvForm("t", "u", "y", Kind.POSITION, "rev")
    fine = np.float32(far + np.cumsum(np.random.default_rng(5).integers(-40, 90, 400)) / 2.0**17)
    count = count_size(turns, fine.astype(np.float64), np.zeros(400))
    assert (count.edges == 2**17) == seen and count.stands_for != seen
    exact = far + np.cumsum(np.random.default_rng(5).integers(-40, 90, 400)) / 1e5
    assert not count_size(turns, exact, np.zeros(400)).stands_for


@pytest.mark.parametrize(("far", "seen"), [(51.0, False), (0.9, True)])
def test_turns_of_32_bits_that_are_printed_as_radians_show_no_encoders_step(far: float, seen: bool) -> None:
    """ODrive keeps turns, and a ROS driver makes radians of them: 262,144 a turn are the last digits at fifty."""
    radians = CsvForm("t", "u", "y", Kind.POSITION, "rad")
    turns = np.float32(far + np.cumsum(np.random.default_rng(5).integers(-40, 90, 400)) / 2.0**18)
    printed = np.round(2.0 * np.pi * turns.astype(np.float64), 9)
    count = count_size(radians, printed, np.zeros(400))
    assert (count.edges == 2**18) == seen and count.stands_for != seen


@pytest.mark.parametrize(("bits", "turns"), [(12, 3000.0), (13, 1500.0), (14, 700.0)])
@pytest.mark.parametrize("unit", ["rad", "rev"])
def test_counts_of_a_power_of_two_a_turn_are_an_encoders_however_far_it_turned(
    bits: int, turns: float, unit: str
) -> None:
    """Near its end 32 bits hold such turns exactly, and resolve no more; near its beginning they resolve more."""
    way = np.cumsum(np.abs(np.random.default_rng(5).normal(1.0, 0.3, 6000)))
    counted = np.floor(way * (turns / way[-1]) * 2.0**bits) / 2.0**bits
    form = CsvForm("t", "u", "y", Kind.POSITION, unit)
    count = count_size(form, counted * (2.0 * np.pi if unit == "rad" else 1.0), np.zeros(6000))
    assert count.edges == 2**bits and not count.stands_for


@pytest.mark.parametrize(
    ("counts", "period", "step", "digit", "said"),
    [
        (3813.9, 2.14793e-3, 0.767, 0.0, "such as 2 ms (of 4096 counts then, and speeds 7.4 % too large)"),
        (3272.73, 0.011, 1.667, 1e-3, "such as 10 ms (of 3600 counts then, and speeds 10 % too large)"),
        (517.24, 4.8e-3, 2.53, 0.0, "such as 5 ms (of 496.55 counts then, and speeds 4 % too small)"),
        (102.4, 0.01, 6.1359, 1e-4, "with a period that the rows did not have, were rounded, or are those of a gear's"),
        (8376.7, 0.01, 0.01, 0.01, "and 0.01 the last decimal: more likely the speeds were rounded to it"),
    ],
)
def test_counts_that_are_no_whole_ones_are_doubted(
    counts: float, period: float, step: float, digit: float, said: str
) -> None:
    """A motor's four encoders of 4,096 counts had 3813.9 in rows of 2.15 ms, and 0.01 m/s was one of 8376.7."""
    assert said in doubt_counts(counts, period, step, digit)


@pytest.mark.parametrize(
    ("counts", "period", "doubted"),
    [
        (432.02, 0.01, False),
        (432.04, 0.01, False),
        (432.05, 0.01, True),
        (4095.8, 0.0020001, False),  # 50 ppm of a crystal
        (3813.9, 0.0021476, True),
        (3813.99, 0.0021476, False),
    ],
)
def test_counts_within_what_decimals_and_clocks_leave_are_not(counts: float, period: float, doubted: bool) -> None:
    assert bool(doubt_counts(counts, period, 0.7272, 1e-4)) is doubted


@pytest.mark.parametrize(
    ("unit", "counts", "step", "said"),
    [
        ("rpm", 687.6, 4.363, "In rad/s it would be 72: check --unit."),
        ("rad/s", 4189.4, 1.5, "A count is a round 1.5 in rpm or deg/s"),  # in rows of 1 ms that a crystal leaves open
        ("rad/s", 628.3185, 0.5, ""),  # as rounding to halves leaves
        ("rad/s", 432.0, 1.45444, ""),
        ("rad/s", 432.3, 1.45343, ""),  # whole in no other unit either
        ("rpm", 687.9, 4.361, ""),
        ("m/s", 687.6, 4.363, ""),
    ],
)
def test_a_unit_is_doubted_by_a_step_that_it_does_not_make(unit: str, counts: float, step: float, said: str) -> None:
    doubt = doubt_unit(unit, counts, step, 0.001)
    assert said in doubt if said else doubt == ""


@pytest.mark.parametrize(("rate", "step"), [(60.0, 0.06), (30.0, 0.03), (40.0, 0.04), (60.0, 0.12), (30.0, 0.15)])
def test_a_round_step_of_an_angle_that_was_printed_in_radians_is_one_of_those(rate: float, step: float) -> None:
    assert doubt_unit("rad/s", 2.0 * np.pi * rate / step, step, 1.0 / rate) == ""
    assert "check --unit" in doubt_unit("rad/s", 2.0 * np.pi * rate / step, step, 1.5 / rate)


def test_a_window_is_doubted_where_speeds_stay_for_more_rows() -> None:
    said = doubt_window(16384.02, 0.0005, 2)
    assert said.startswith(" But most values stay for 2 rows: if a new one came every 1 ms, it has 8192 (--speed-w")
    assert "(--speed-window 0.001)" in said and doubt_window(16384.0, 0.0005, 0) == ""
