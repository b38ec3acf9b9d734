"""One wheel: its angle by counts, and every reason not to rely on it, from both sides."""

from dataclasses import replace
from math import nan, tau

import pytest

from motor_examples.diff_drive.wheel import (
    ANSWERS,
    MOST_HELD,
    OBEYED,
    SILENCE,
    UNAPPLIED,
    Wheel,
    awaits_answer,
    find_trouble,
    follow_controller,
    follow_sample,
)
from motor_model.sample import Info, Sample

TWO = Info(edges_per_revolution=100, single_channel=False, max_voltage=6.0)
ONE = replace(TWO, single_channel=True)


def turned(info: Info, steps: list[tuple[int, float]], sign: float = 1.0) -> Wheel:
    """A wheel after samples of a count and a speed [rad/s], 10 ms apart."""
    wheel = Wheel("left", sign, info, reference_timeout=0.5)
    for k, (count, speed) in enumerate(steps):
        wheel = follow_sample(wheel, Sample(10_000_000 * (k + 1), speed, 0.0, count), 0.01 * k)
    return wheel


def test_the_angle_is_that_of_the_counts_since_the_first_sample() -> None:
    assert turned(TWO, [(7, 0.0), (57, 9.0), (32, -9.0)]).angle == pytest.approx(0.25 * tau)
    assert turned(TWO, [(7, 0.0), (57, 9.0)], sign=-1.0).angle == pytest.approx(-0.5 * tau)
    assert turned(TWO, [(7, 0.0), (57, 9.0)], sign=-1.0).speed == -9.0


def test_the_angle_of_a_geared_motor_is_that_of_its_output() -> None:
    geared = replace(TWO, gear_ratio=34.014, edges_per_revolution=44)
    assert turned(geared, [(0, 0.0), (44 * 34014, 9.0)]).angle == pytest.approx(1000.0 * tau, rel=1e-15)


def test_a_single_channel_counts_down_where_the_speed_says_so() -> None:
    assert turned(ONE, [(0, 0.0), (50, 9.0), (75, -9.0), (80, 0.0)]).angle == pytest.approx(0.2 * tau)


def test_a_plant_that_starts_again_moves_nothing() -> None:
    wheel = turned(TWO, [(0, 0.0), (50, 9.0)])
    again = follow_sample(wheel, Sample(1_000_000, 0.0, 0.0, 0), 1.0)
    assert again.angle == wheel.angle
    assert follow_sample(again, Sample(11_000_000, 9.0, 0.0, 25), 1.0).angle == pytest.approx(0.75 * tau)


def test_a_board_that_counts_from_0_again_moves_nothing() -> None:
    """It was reset, and its driver's clock goes on."""
    before = follow_sample(turned(Info(), []), Sample(10_000_000, 9.0, 0.0, 5000, 9_000_000), 0.0)
    again = follow_sample(before, Sample(20_000_000, 0.0, 0.0, 0), 0.0)
    assert again.edges == before.edges and follow_sample(again, Sample(30_000_000, 9.0, 0.0, 3, 1), 0.0).edges == 3


def test_nothing_is_counted_before_it_is_known_what_a_count_is() -> None:
    wheel = follow_sample(follow_sample(Wheel("left"), Sample(1, 0.0, 0.0, 0), 0.0), Sample(2, 9.0, 0.0, 50), 0.0)
    assert replace(wheel, info=TWO).angle == 0.0


def test_every_trouble_is_said_and_nothing_else() -> None:
    well = follow_controller(turned(TWO, [(0, 0.0)]), "running", "", 3.0, 0.0)
    assert find_trouble(well, 0.0, 9.0) == ""
    assert "no motor: start its plant in the namespace left" in find_trouble(Wheel("left", info=TWO), 0.0, 0.0)
    assert "no motor" in find_trouble(replace(well, info=None), 0.0, 0.0)
    assert "has no controller" in find_trouble(turned(TWO, [(0, 0.0)]), 0.0, 0.0)
    later = follow_sample(well, Sample(20_000_000, 0.0, 1.0), 1.0)
    assert "has no controller" in find_trouble(later, 1.0, 0.0)
    assert find_trouble(well, 0.99 * SILENCE, 9.0) == ""
    assert "No sample of the left wheel for 0.3 s" in find_trouble(well, 1.01 * SILENCE, 9.0)
    for state, driven, words in (
        ("stopped", 0.0, "does not run: It is blocked."),
        ("no_samples", 0.0, "does not run"),
        ("disabled", 1.01 * OBEYED, "does not run"),
        ("disabled", 0.99 * OBEYED, ""),
    ):
        said = find_trouble(follow_controller(well, state, "It is blocked.", 0.0, 0.0), 0.0, driven)
        assert words in said and bool(words) == bool(said)


def test_a_controller_that_would_go_on_alone_is_not_relied_on() -> None:
    well = follow_controller(turned(TWO, [(0, 0.0)]), "running", "", 3.0, 0.0)
    for timeout, words in (
        (None, "does not say how long it would go on"),
        (0.5, ""),
        (MOST_HELD, ""),
        (1.01 * MOST_HELD, "would go on for 2.02 s if this drive died"),
        (3600.0, "The controller of the left wheel would go on for 3600 s if this drive died"),
        (0.0, "would go on if this drive died"),
        (nan, "would go on for nan s if this drive died"),
    ):
        said = find_trouble(replace(well, reference_timeout=timeout), 0.0, 9.0)
        assert words in said and bool(words) == bool(said)


def test_a_controller_is_waited_for_until_it_has_said_how_long_it_goes_on_alone() -> None:
    well = follow_controller(turned(TWO, [(0, 0.0)]), "running", "", 3.0, 0.0)
    assert not awaits_answer(well) and find_trouble(well, 0.0, 9.0) == ""
    asked = replace(well, reference_timeout=None, unsaid_since=0.0)
    assert awaits_answer(asked) and find_trouble(asked, 0.0, 0.0) == ""
    assert "does not say how long it would go on" in find_trouble(asked, 0.0, 0.02)  # it is driven, and is another now
    for known in (None, 0.5):  # one that has said it before may have ended since, or hang
        heard = follow_controller(replace(well, heard=2.99, reference_timeout=known), "running", "", 3.0, 2.99)
        assert find_trouble(replace(heard, unsaid_since=2.99 - 0.99 * ANSWERS), 2.99, 0.0) == ""
        assert "left wheel does not say" in find_trouble(replace(heard, unsaid_since=2.99 - 1.01 * ANSWERS), 2.99, 0.0)


def test_two_controllers_are_one_too_many() -> None:
    well = follow_controller(turned(TWO, [(0, 0.0)]), "running", "", 3.0, 0.0)
    assert "(/left/a, /left/b)" in find_trouble(replace(well, rivals="/left/a, /left/b"), 0.0, 0.0)


def test_an_output_that_is_off_is_said_after_a_moment() -> None:
    wheel = follow_controller(turned(TWO, [(0, 0.0)]), "running", "", 3.0, 0.0)
    wheel = follow_sample(wheel, Sample(20_000_000, 0.0, 0.0), 0.0)
    assert find_trouble(wheel, 0.99 * UNAPPLIED, 1.0) == ""
    assert "call left/motor/enable" in find_trouble(wheel, 1.01 * UNAPPLIED, 1.0)
    assert find_trouble(follow_sample(wheel, Sample(30_000_000, 0.0, 3.0), 0.0), 0.2, 1.0) == ""
    little = follow_controller(wheel, "running", "", 0.1, 0.0)  # may be rounded to no duty
    assert find_trouble(follow_sample(little, Sample(30_000_000, 0.0, 0.0), 0.0), 0.2, 1.0) == ""
