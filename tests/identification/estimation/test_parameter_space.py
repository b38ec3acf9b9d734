"""θ in a box scaled by the recordings becomes a motor, and goes over to other unknowns."""

from dataclasses import replace

import numpy as np
import pytest
from small import THETA, TRUE, small_recording

from motor_identification.estimation.parameter_space import TURNING_SPEED, make_unknowns, map_theta, measure_extent
from motor_identification.recording import check
from motor_model.effects import INDEX, SPEC_BY_NAME
from motor_model.errors import ModelError

MOVING = check(small_recording().between(0.1, 0.7))


@pytest.mark.parametrize(
    ("edges", "rate", "cycles"), [(6, 200.0, 3.0), (2880, 200.0, 1), (0, 200.0, 1), (2880, 1e5, 1440.0)]
)
def test_a_ripple_is_as_fine_as_disc_and_samples_show(edges: int, rate: float, cycles: float) -> None:
    """Half a cycle a slot, and, where the motor turns slowly, half a cycle a stamp."""
    recording = small_recording()
    info = replace(recording.info, edges_per_revolution=edges, sample_period=1.0 / rate)
    extent = measure_extent([replace(recording, info=info)])
    expected = cycles if cycles != 1 else 2.0 * np.pi / (TURNING_SPEED * extent.speed / rate)
    assert extent.cycles == pytest.approx(expected)


@pytest.mark.parametrize("top", [3.0, 14.0, 30.0, 100.0, 500.0])
def test_the_largest_speed_is_no_single_count(top: float) -> None:
    """96 counts a turn, read every millisecond: a count is 65 rad/s, however slowly the motor turns."""
    speed = top * np.clip(np.sin(np.linspace(0.0, 6.0, 8000)) * 1.2, -1.0, 1.0)
    count = 2.0 * np.pi / 96
    seen = np.diff(np.floor(np.cumsum(speed * 1e-3) / count), prepend=0.0) * count / 1e-3
    recording = replace(small_recording().at_rows(np.zeros(8000, dtype=np.int64)), speed=seen)
    assert 0.9 * top < measure_extent([recording]).speed < 2.0 * top
    false = replace(recording, speed=np.where(np.arange(8000) == 4000, 1e5, seen))
    assert measure_extent([false]).speed < 2.0 * top or top < 65.0  # where no two samples in a row have a count


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


@pytest.mark.parametrize(("share", "believed"), [(0.02, False), (0.05, True)])
def test_bursts_of_false_speeds_move_the_box_only_so_far_that_it_holds_both(share: float, believed: bool) -> None:
    """What a filter makes of a potentiometer's gap: eight times the speed, over many rows, now and then."""
    row = np.arange(5000)
    speed = np.where(row % 1000 < 1000 * share, 320.0, 0.4 * (row % 100 + 1))
    recording = replace(small_recording().at_rows(np.zeros(5000, dtype=np.int64)), speed=speed)
    extent = measure_extent([recording])
    assert extent.speed == pytest.approx(320.0 if believed else 40.0)
    low, high = SPEC_BY_NAME["kv"].box(extent)
    assert low < extent.voltage / 320.0
    assert (high > extent.voltage / 40.0) is not believed
    wilder = measure_extent([replace(recording, speed=np.where(speed > 40.0, 4000.0, speed))])
    assert wilder.speed == pytest.approx(4000.0 if believed else 500.0)  # an eighth: kv is in the box if it was motion
