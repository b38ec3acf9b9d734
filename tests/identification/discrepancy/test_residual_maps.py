"""Where a model is wrong: maps, words and torque, held against the plant's truth and against plain recomputation."""

import re
from dataclasses import replace
from math import tau

import numpy as np
import pytest
from diagnosed import BASE, fitted, held
from plant import profiles, record

from motor_identification.discrepancy.missing_torque import MissingTorque, describe_torque, estimate_missing_torque
from motor_identification.discrepancy.operating_conditions import find_conditions
from motor_identification.discrepancy.region_text import describe_error, describe_region
from motor_identification.discrepancy.residual_maps import AXES, map_residuals
from motor_identification.discrepancy.worst_regions import choose_thresholds, find_worst_regions, measure_contrast
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.problem import make_problem
from motor_identification.recording import Floats, check
from motor_identification.validation.held_out import HeldOut
from motor_identification.validation.hold_out import make_hold_out

SHARE = 0.003  # of a slot: what the disc of `diagnosed` has
FRICTION = {"ks": 0.4}
STEP = {"step_voltage": 0.5, "step_time": 11.0}
DISC = {"eccentricity": 0.03, "eccentricity_phase": 1.0}


def missing(**hidden: float) -> HeldOut:
    """Held-out motion judged by the true kv and ka, so that what is hidden is all that is missing."""
    estimate, hold_out = fitted(**hidden)
    return hold_out.validate(replace(estimate, theta=np.log([BASE["kv"], BASE["ka"]])))


def test_situations_are_what_the_motor_did() -> None:
    recording, truth = record(BASE | FRICTION, *profiles.reversals(8.0), seed=3)
    kept = make_hold_out([check(recording)], [check(recording)])
    problem = make_problem([check(recording)], ())
    seen = find_conditions(kept.validate(Estimate(problem, np.log([BASE["kv"], BASE["ka"]]))))
    moving = ~seen.still
    assert np.sum(moving) > 200
    speed = np.interp(seen.time, truth.time, truth.speed)
    fast = moving & (np.abs(speed) > 20.0)
    assert np.median(np.abs(seen.speed - speed)[fast]) < 0.3
    pushed = np.interp(seen.time, truth.time, np.gradient(np.abs(truth.speed), truth.time))
    strong = fast & (np.abs(pushed) > 100.0)
    assert np.median(np.abs(seen.acceleration / pushed - 1.0)[strong]) < 0.05
    turned = np.searchsorted(truth.reversal_time, seen.time) - 1
    after = fast & (turned >= 0)
    since = seen.time[after] - truth.reversal_time[turned[after]]
    assert np.max(np.abs(seen.since[after] - since)) < 0.06  # a slot takes that long where the motor is slowest
    at = np.searchsorted(recording.time, seen.time, side="right") - 1
    assert np.array_equal(seen.voltage, recording.voltage[at])


def test_the_angle_is_the_measured_one() -> None:
    """The disc is the same in every turn: the angle within a run advances as the truth does, to a fifth of a slot."""
    one = missing(**DISC)
    seen = find_conditions(one)
    recording, truth = record(
        BASE | DISC, *profiles.rich(9.0, seed=5), seed=2, disc_seed=1, irregularity=0.003
    )  # the held-out recording of `diagnosed`, with what really happened
    first = (seen.time < 4.0) & ~seen.still
    angle = np.interp(seen.time[first], truth.time, truth.angle)
    off = np.mod(seen.angle[first] - angle + np.pi, tau) - np.pi
    # The disc shows θ + e·sin: off by twice e at most, from the angle at the start.
    assert np.ptp(off) < 2.5 * DISC["eccentricity"]
    assert recording.duration > 30.0


def test_maps_add_up_to_the_gap() -> None:
    one = held(**FRICTION)
    drawn = map_residuals(one, SHARE)
    assert {each.axis.name for each in drawn} == {axis.name for axis in AXES}
    whole = float(np.concatenate([data.duration for data in one.intervals])[one.counted].sum())
    for each in drawn:
        known = each.seconds > 0.0
        assert np.array_equal(known, np.isfinite(each.gap)) and len(each.edges) == len(each.gap) + 1
        if each.axis.name in ("acceleration", "since"):  # a standstill is on neither
            assert 0.8 * whole < each.seconds.sum() < whole
            continue
        assert each.seconds.sum() == pytest.approx(whole)
        for bins, total in ((each.gap, one.gap), (each.floor, one.floor(SHARE))):
            assert np.sqrt(np.average(bins[known] ** 2, weights=each.seconds[known])) == pytest.approx(total)


def test_a_bin_is_what_it_says() -> None:
    one = held(**FRICTION)
    seen = find_conditions(one)
    speed = next(each for each in map_residuals(one, SHARE) if each.axis.name == "speed")
    k = int(np.searchsorted(speed.edges, 30.0)) - 1
    inside = (seen.speed >= speed.edges[k]) & (seen.speed < speed.edges[k + 1])
    weight = seen.duration[inside] / seen.duration[inside].sum()
    assert speed.gap[k] == pytest.approx(np.sqrt(weight @ one.residuals[inside] ** 2))
    assert speed.mean[k] == pytest.approx(weight @ one.residuals[inside])
    assert speed.floor[k] == pytest.approx(np.sqrt(weight @ one.floors(SHARE)[inside] ** 2))
    assert speed.gap[k] > 10.0 * speed.floor[k] and speed.mean[k] > 0.7 * speed.gap[k]  # without friction: too fast
    k = int(np.searchsorted(speed.edges, -30.0)) - 1
    assert speed.mean[k] < -0.7 * speed.gap[k]


def test_a_complete_model_is_at_the_floor_everywhere() -> None:
    for each in map_residuals(held(), SHARE):
        full = (each.seconds > 0.5) & (each.floor > 0.05)
        ratio = each.gap[full] / each.floor[full]
        assert len(ratio) >= 2 and ratio.min() > 0.6 and ratio.max() < 1.4


SENTENCE = re.compile(
    r"largest error at \|ω\| < ([\d.]+) rad/s \(RMS ([\d.]+) rad/s, ([\d.]+) × the noise floor; "
    r"(\d+) % of the excess error in ([\d.]+) % of the time; "
    r"the simulation is ([\d.]+) rad/s too fast\)"
)


def test_where_says_what_can_be_recomputed() -> None:
    one = held(**FRICTION)
    found = SENTENCE.fullmatch(describe_error(one, SHARE))
    assert found, describe_error(one, SHARE)
    limit, gap, times, excess, time, fast = map(float, found.groups())
    data, marks = one.intervals[0], one.scored[0]
    left = one.residuals_of[0][marks]
    seconds, speed, still = data.duration[marks], data.speed[marks], data.slack[marks] > 0.0
    floor = one.floors(SHARE)
    inside = ~still & (np.abs(speed) < limit)
    assert 20.0 < limit < 90.0  # friction is missed at low speed: at high speed a wrong kv stands in for it
    here = seconds[inside] / seconds[inside].sum()
    assert gap == pytest.approx(np.sqrt(here @ left[inside] ** 2), rel=0.005)
    assert times == pytest.approx(np.sqrt(here @ left[inside] ** 2) / np.sqrt(here @ floor[inside] ** 2), rel=0.05)
    squares = seconds * (left**2 - floor**2)
    assert excess == pytest.approx(100.0 * squares[inside].sum() / squares.sum(), abs=0.51)
    assert time == pytest.approx(100.0 * seconds[inside].sum() / seconds.sum(), rel=0.05)
    assert fast == pytest.approx(here @ (left * np.sign(speed))[inside], rel=0.05)
    assert excess > 70.0 and time < 60.0


def test_where_nothing_is_wrong() -> None:
    one = held()
    found = re.fullmatch(
        r"the error is at the noise floor everywhere \(RMS ([\d.]+) rad/s, ([\d.]+) × the noise floor\)",
        describe_error(one, SHARE),
    )
    assert found and float(found[1]) == pytest.approx(one.gap, rel=0.005) and 0.8 < float(found[2]) < 1.1


def test_a_load_that_comes_is_dated() -> None:
    found = re.match(r"largest error at t > ([\d.]+) s \(RMS ", describe_error(missing(**STEP), SHARE))
    assert found and 9.0 < float(found[1]) < 13.0


def test_a_disc_is_seen_in_every_turn() -> None:
    assert describe_error(held(**DISC), SHARE).startswith("the error repeats once per revolution (RMS ")
    assert "per revolution" not in describe_error(held(**FRICTION), SHARE)


def test_a_ripple_is_counted() -> None:
    """On a motor with friction, which is known: it stops on its ripple and does not swing there."""
    estimate, hold_out = fitted(ks=0.5, ripple_voltage=0.4, ripple_cycles=6.0, ripple_phase=0.5)
    theta = np.array([*np.log([BASE["kv"], BASE["ka"]]), 0.5])
    sliding = Estimate(estimate.problem.with_effects(("coulomb_friction",)), theta)
    said = describe_error(hold_out.validate(sliding), SHARE)
    found = re.match(
        r"the error repeats 6 times per revolution \(RMS [\d.]+ rad/s, .* about (\d+) % of the excess error\)", said
    )
    assert found and 60 < int(found[1]) < 90


def test_the_worst_regions_do_not_overlap() -> None:
    one = held(**FRICTION)
    regions = find_worst_regions(one, SHARE)
    assert 1 <= len(regions) <= 3 and f"largest error {describe_region(regions[0])}" == describe_error(one, SHARE)
    assert np.max(np.sum([region.inside for region in regions], axis=0)) == 1
    assert sum(region.excess for region in regions) <= 1.0 + 1e-9
    for region in regions:
        assert region.time == pytest.approx(one.weight[region.inside].sum())
    assert regions[0].excess > regions[-1].excess or len(regions) == 1


def test_contrast_prefers_much_in_little() -> None:
    much = measure_contrast(np.array([0.9, 0.9, 0.3, 0.5, 0.2]), np.array([0.1, 0.5, 0.1, 0.5, 0.4]))
    assert much[0] > much[1] > 0.0 and much[0] > much[2] > 0.0
    assert much[3] == pytest.approx(0.0) and much[4] == 0.0
    assert choose_thresholds(np.array([0.0, 123.4]))[0] == 1.2 and choose_thresholds(np.zeros(2)) == []


def shape(one: HeldOut, axis: str) -> MissingTorque:
    return next(each for each in estimate_missing_torque(one) if each.axis == axis)


def within(one: MissingTorque, truth: Floats, which: Floats) -> None:
    """Known bins are within 3 % of 0.4 V, or 4 standard errors, of the truth."""
    known = np.isfinite(one.torque) & which.astype(bool)
    assert np.sum(known) >= 10
    off = np.abs(one.torque - truth)[known]
    assert np.all(off < np.maximum(0.012, 4.0 * one.error[known]))
    assert np.median(off) < 0.01


def test_missing_friction_has_the_shape_of_friction() -> None:
    one = shape(missing(**FRICTION), "speed")
    middle = 0.5 * (one.edges[1:] + one.edges[:-1])
    within(one, 0.4 * np.sign(middle), np.abs(middle) > 10.0)
    words = describe_torque(estimate_missing_torque(missing(**FRICTION)))
    found = re.fullmatch(r"Residual torque over the speed: (-[\d.]+) to ([\d.]+) V, largest near .*rad/s\.", words)
    assert found and -0.5 < float(found[1]) < -0.38 and 0.38 < float(found[2]) < 0.5


def test_a_missing_load_step_has_its_size_and_time() -> None:
    one = shape(missing(**STEP), "time")
    before, after = one.edges[1:] < 10.9, one.edges[:-1] > 11.1
    within(one, np.where(after, 0.5, 0.0), before | after)


def test_nothing_is_left_of_a_complete_model() -> None:
    assert describe_torque(estimate_missing_torque(missing())) == ""
