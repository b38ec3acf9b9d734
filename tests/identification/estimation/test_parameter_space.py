"""θ in a box scaled by the recordings becomes a motor, and goes over to other unknowns."""

from dataclasses import replace

import numpy as np
import pytest
from small import THETA, TRUE, small_recording

from motor_identification.estimation.parameter_space import make_unknowns, map_theta
from motor_identification.recording import check
from motor_model.effects import INDEX, SPEC_BY_NAME
from motor_model.errors import ModelError

MOVING = check(small_recording().between(0.1, 0.7))


def test_the_box_is_scaled_by_voltage_speed_and_duration() -> None:
    recording = small_recording()
    unknowns = make_unknowns([recording], ("coulomb_friction", "load_step"))
    assert unknowns.extent.voltage == 9.0
    assert unknowns.extent.duration == pytest.approx(recording.duration)
    assert 100.0 < unknowns.extent.speed < 9.0 / TRUE["kv"]
    assert unknowns.extent.sample == recording.sample_period
    assert unknowns.extent.cycles == 48.0  # of 96 edges
    ks = unknowns.names.index("ks")
    spec = SPEC_BY_NAME["ks"]
    assert (unknowns.low[ks], unknowns.high[ks]) == pytest.approx((spec.low * 9.0, spec.high * 9.0))
    assert np.all(unknowns.low < unknowns.high)
    with pytest.raises(ModelError, match="'gravity' is not an effect"):
        make_unknowns([recording], ("gravity",))


def test_one_false_speed_does_not_move_the_box() -> None:
    recording = small_recording()
    speed = recording.speed.copy()
    speed[20] = 1e4
    assert make_unknowns([replace(recording, speed=speed)], ()).extent.speed == pytest.approx(
        make_unknowns([recording], ()).extent.speed
    )
    speed[21] = 1e4  # two in a row may be motion: the box holds both
    assert make_unknowns([replace(recording, speed=speed)], ()).extent.speed == pytest.approx(1250.0)


def test_theta_is_a_motor_and_logarithms_have_relative_errors() -> None:
    unknowns = make_unknowns([small_recording()], ("coulomb_friction",))
    motor = unknowns.parameters(THETA, "name")
    assert motor.values == pytest.approx(TRUE) and motor.name == "name" and motor.effects == ("coulomb_friction",)
    errors = unknowns.value_errors(THETA, np.array([0.01, 0.02, 0.03]))
    assert errors == pytest.approx({"kv": 0.01 * TRUE["kv"], "ka": 0.02 * TRUE["ka"], "ks": 0.03})


@pytest.mark.parametrize(("breakaway", "held"), [(0.2, 0.4), (0.4, 0.4), (0.9, 0.9)])
def test_a_motor_does_not_hold_less_than_it_slides(breakaway: float, held: float) -> None:
    unknowns = make_unknowns([small_recording()], ("coulomb_friction", "static_friction"))
    theta = np.array([*THETA, breakaway, 5.0])
    vectors, _ = unknowns.decode(theta[None])
    assert vectors[0, 0, INDEX["breakaway_voltage"]] == pytest.approx(held)


def test_a_moving_start_is_an_unknown_of_its_recording() -> None:
    unknowns = make_unknowns([small_recording(), MOVING], ("coulomb_friction",))
    assert unknowns.turning.tolist() == [False, True] and len(unknowns.low) == 4
    start = float(MOVING.speed[0])
    assert unknowns.low[3] < start < unknowns.high[3] and unknowns.low[3] > 0.3 * start
    _, starts = unknowns.decode(np.append(THETA, start)[None])
    assert starts[0].tolist() == [0.0, start]


def test_theta_goes_over_to_more_unknowns_and_back() -> None:
    recordings = [small_recording(), MOVING]
    small = make_unknowns(recordings, ("coulomb_friction",))
    large = make_unknowns(recordings, ("coulomb_friction", "load_step"))
    theta = np.append(THETA, 77.0)
    values = {"step_voltage": np.array(0.3), "step_time": np.array([0.1, 0.2])}
    moved = map_theta(small, theta, large, values)
    assert large.parameters(moved, "").values == pytest.approx(TRUE | {"step_voltage": 0.3, "step_time": 0.1})
    assert large.decode(moved[None])[0][0, 1, INDEX["step_time"]] == pytest.approx(0.2)
    assert moved[-1] == 77.0 and map_theta(large, moved, small, {}) == pytest.approx(theta)
    far = map_theta(small, theta, large, values | {"step_voltage": np.array(1e3)})
    assert far[large.names.index("step_voltage")] == large.high[large.names.index("step_voltage")]


def test_a_motor_that_turns_by_another_timing_alone_begins_around_what_it_shows_there() -> None:
    """Seven steps whose rows were stamped a row late ended in an error: one timing began turning, the other did not."""
    still, moving = make_unknowns([small_recording()] * 2, ()), make_unknowns([MOVING, small_recording()], ())
    assert (still.turning.tolist(), moving.turning.tolist()) == ([False, False], [True, False])
    theta = map_theta(still, THETA[:2], moving, {})
    assert theta[:2] == pytest.approx(THETA[:2]) and len(theta) == 3
    assert theta[2] == pytest.approx(0.5 * (moving.low[2] + moving.high[2])) and theta[2] != 0.0
    assert map_theta(moving, theta, still, {}) == pytest.approx(THETA[:2])
    both = make_unknowns([MOVING, MOVING], ())
    begun = 0.7 * moving.low[2] + 0.3 * moving.high[2]
    over = map_theta(moving, np.append(theta[:2], begun), both, {})
    assert over[2] == pytest.approx(begun) and over[3] == pytest.approx(0.5 * (both.low[3] + both.high[3]))
