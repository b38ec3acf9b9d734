"""A motor that rests under a voltage is held: by friction or a dead zone, whatever else its model lacks."""

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from diagnosed import BASE, with_effect
from plant import profiles, record

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_fit import validate_model
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.evidence import standstill_evidence
from motor_identification.diagnosis.evidence.standstill_evidence import (
    count_departures,
    explains_standstills,
    find_held_intervals,
    list_hills,
    measure_false_motion,
)
from motor_identification.estimation.direction_correction import correct_directions
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.miscounts import find_miscounts
from motor_identification.estimation.problem import make_problem
from motor_identification.measurement.intervals import index_intervals
from motor_identification.recording import Recording, check
from motor_identification.validation.hold_out import make_hold_out
from motor_model.parameters import PAPER_KA, PAPER_KV


def started_from_rest(**hidden: float) -> tuple[Model, Callable[[str, dict[str, float]], Model]]:
    """The two-coefficient motor fitted to one that starts from rest under a growing voltage; and to add an effect."""
    ups = [profiles.through([volts], 1.0) for volts in (6.0, 9.0, -6.0, 7.0)]
    rest = profiles.pieces([0.0], 1.0)
    drive = profiles.joined(rest, *(part for up in ups for part in (up, rest)))
    train, other = (check(record(BASE | hidden, *drive, seed=seed, start_angle=float(seed))[0]) for seed in (1, 2))
    hold_out = make_hold_out([train], [other])
    estimate = correct_directions(fit_speeds(Estimate(make_problem([train], ()), np.log([PAPER_KV, PAPER_KA]))))
    estimate = fit_speeds(estimate.on(estimate.problem.without(find_miscounts(estimate))))
    hold_out = hold_out.correct_directions(estimate)
    return validate_model(hold_out, estimate), lambda *effect: validate_model(hold_out, with_effect(estimate, *effect))


def test_friction_explains_why_the_motor_rests_though_it_varies_with_the_angle() -> None:
    """What is not in the table leaves a part of the gap that no name explains; the friction under it is there."""
    bare, add = started_from_rest(ks=0.4, angle_friction=0.6)
    held, zone = add("coulomb_friction", {"ks": 0.5}), add("dead_zone", {"dead_zone_voltage": 0.3})
    assert held.above_floor
    assert explains_standstills(bare, held) and explains_standstills(bare, zone)
    assert not explains_standstills(bare, add("quadratic_drag", {"drag": 1e-5}))
    assert not explains_standstills(held, held)


@pytest.mark.parametrize(
    "hidden",
    [
        {"compliance_fraction": 0.4, "compliance_stiffness": 1.5, "compliance_damping": 0.01},
        {"slew_rate": 30.0, "drag": 1e-4},
    ],
)
def test_without_friction_there_is_nothing_to_explain(hidden: dict[str, float]) -> None:
    """A shaft that is not stiff, a bridge that is slow: no model moves where the motor stood."""
    bare, _ = started_from_rest(**hidden)
    assert bare.above_floor and measure_false_motion(bare) < thresholds.LEAST_FALSE_MOTION


@pytest.mark.parametrize(("times", "enough"), [(0.999, False), (1.001, True)])
def test_thresholds(monkeypatch: pytest.MonkeyPatch, times: float, enough: bool) -> None:
    def judge(before: float, after: float) -> bool:
        moved = iter((before, after))
        monkeypatch.setattr(standstill_evidence, "measure_false_motion", lambda model: next(moved))
        return explains_standstills(cast(Model, None), cast(Model, None))

    assert judge(times * thresholds.LEAST_FALSE_MOTION, 0.0) is enough
    assert judge(1e4, 1e4 * (1.0 - times * thresholds.HELD_SHARE)) is enough


def test_held_intervals_are_without_motion_under_a_voltage_that_came_and_none_against_it() -> None:
    time = np.arange(80.0)
    voltage = np.zeros(80)
    voltage[10:30], voltage[30:60], voltage[60:70] = 1.0, -1.0, 0.001
    recording = cast(Recording, SimpleNamespace(time=time, voltage=voltage, sample_period=1.0))
    start, end = np.array([1.0, 5.0, 15.0, 31.0, 40.0]), np.array([9.0, 28.5, 40.5, 55.5, 65.0])
    data = index_intervals(start, end, np.zeros(5), np.full(5, 0.1), slot=1.0)
    expected = [False, True, False, True, False]  # nothing applied, held, reversed, held, switched off
    assert find_held_intervals(recording, data, 1.0).tolist() == expected
    for slots, held in ((1.49, expected), (1.51, [False] * 5)):
        assert find_held_intervals(recording, replace(data, speed=slots / data.duration), 1.0).tolist() == held
    brief = index_intervals(start, start + 19.0, np.full(5, 1.0 / 19.0), np.full(5, 0.1), slot=1.0)
    assert not find_held_intervals(recording, brief, 1.0).any()


@pytest.mark.parametrize(
    ("sigmas", "rows", "lag", "window", "held"),
    [
        (0.99, 2, 0.99, 1.0, True),
        (1.01, 2, 0.99, 1.0, False),  # it creeps
        (0.99, 2, 1.01, 1.0, False),  # it has not answered yet
        (0.99, 1, 0.1, 1.0, False),  # it passes standstill
        (0.99, 2, 0.99, 0.0, False),  # between measured angles slots tell it
    ],
)
def test_logged_speeds_within_their_noise_are_a_standstill_if_that_lasts(
    sigmas: float, rows: int, lag: float, window: float, held: bool
) -> None:
    """A motor that broke away at 2.3 V stood behind a filter that was undone, which leaves no zeros."""
    start = np.arange(6.0)
    voltage = np.where((start >= 2.0) & (start < 2.0 + rows), -1.0, 0.0)
    recording = cast(
        Recording, SimpleNamespace(time=np.arange(7.0), voltage=np.append(voltage, 0.0), sample_period=1.0)
    )
    data = index_intervals(start, start + 1.0, np.full(6, 5.0), np.full(6, 0.1), window=window)
    near = sigmas * thresholds.STILL_SIGMA * data.sigma
    data = replace(data, speed=np.where(voltage != 0.0, near * [1, -1, 1, -1, 1, -1], 5.0))
    lag *= rows / thresholds.STILL_CONSTANTS
    assert find_held_intervals(recording, data, lag).tolist() == [held and bool(one) for one in voltage]


def test_departures_are_counted_in_every_recording() -> None:
    """Two recordings of five rests each."""
    bare, _ = started_from_rest(ks=0.4)
    assert count_departures(bare) == 10


def test_a_first_count_that_comes_late_is_a_standstill() -> None:
    """Counts without stamps have no slot: the motor stood for 60 ms, ran, and stood once more."""
    time = np.concatenate([[0.0], 0.06 + 0.002 * np.arange(50), [0.5], 0.502 + 0.002 * np.arange(50)])
    travel = np.concatenate([[0.008], np.full(49, 0.016), [0.016], np.full(50, 0.016)])
    data = index_intervals(time[:-1], time[1:], travel / np.diff(time), np.zeros(len(travel)))
    recording = cast(Recording, SimpleNamespace(sample_period=0.002))
    held = SimpleNamespace(recordings=(recording,), intervals=(data,), increments=(travel,))
    problem, parameters = SimpleNamespace(recordings=(recording,)), SimpleNamespace(time_constant=0.05)
    model = SimpleNamespace(estimate=SimpleNamespace(parameters=parameters, problem=problem), held=held)
    assert count_departures(cast(Model, model)) == 2


@pytest.mark.parametrize(
    ("effect", "unknown", "departures", "hills"),
    [
        ("static_friction", ("stribeck_speed",), thresholds.FEW_DEPARTURES, ("torque_ripple",)),
        ("static_friction", ("stribeck_speed",), thresholds.FEW_DEPARTURES + 1, ()),
        ("static_friction", (), thresholds.FEW_DEPARTURES, ()),  # it is seen to fall with the speed
        ("coulomb_friction", ("ks",), 1, ()),
    ],
)
def test_one_start_from_rest_tells_no_breakaway_from_a_hill(
    effect: str, unknown: tuple[str, ...], departures: int, hills: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(standstill_evidence, "count_departures", lambda model: departures)
    model = SimpleNamespace(uncertainty=SimpleNamespace(not_identifiable=unknown), effects=(effect,))
    assert list_hills(cast(Model, model), effect) == hills
    model.effects = (effect, "torque_ripple")
    assert list_hills(cast(Model, model), effect) == ()
