"""Runs of a battery differ by its charge: that is named neither as an effect, nor does it hide one."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from diagnosed import with_effect
from plant import record
from stub_selections import step_of

from motor_identification.diagnose import diagnose
from motor_identification.diagnosis import candidate_fit, candidate_model
from motor_identification.diagnosis.candidate_fit import judge_beside_torque, validate_model
from motor_identification.diagnosis.candidate_test import CandidateTest, likelihood_threshold
from motor_identification.diagnosis.detectability import find_undetectable
from motor_identification.diagnosis.result import Diagnosis
from motor_identification.diagnosis.run_gains import find_gap_less_gains, gains_may_differ, may_be_of_gains
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.problem import make_problem
from motor_identification.noise.error_model import ErrorModel
from motor_identification.recording import Recording, check
from motor_identification.reporting.diagnosis_text import summarize_diagnosis
from motor_identification.reporting.html.limits import list_limits
from motor_identification.validation.hold_out import make_hold_out
from motor_model.parameters import PAPER_KA, PAPER_KV

LEVELS = 12.0 * np.array([0.3, -0.5, 0.9, -0.3, 0.5, -0.9, 0.25, -0.7])
GAINS = 1.0 + 0.015 * np.array([1.0, -1.2, -0.4, 0.9, -0.9, 0.6, 0.8, -0.8])


@cache
def runs(ks: float = 0.0, gains: tuple[float, ...] = tuple(GAINS)) -> tuple[Recording, ...]:
    """A step of half a second at each level, logged as if all had the same supply."""
    time, made = 0.005 * np.arange(120), []
    for number, (level, gain) in enumerate(zip(LEVELS, gains, strict=False)):
        command = np.where(time < 0.05, 0.0, level)
        values = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": ks}
        recording, _truth = record(values, time, command * gain, seed=number, irregularity=0.003, disc_seed=1)
        made.append(check(replace(recording, voltage=recording.voltage / gain)))
    return tuple(made)


@cache
def found(ks: float) -> Diagnosis:
    return diagnose(runs(ks))


@pytest.mark.slow
def test_nothing_is_named_for_a_supply_that_differs() -> None:
    assert not found(0.0).findings and found(0.0).verdict.value != "unexplained"
    assert found(0.0).model.parameters.value("kv") == pytest.approx(PAPER_KV, rel=0.03)


@pytest.mark.slow
def test_a_friction_is_named_beside_it_and_the_scatter_is_told() -> None:
    (finding,) = found(0.8).findings
    assert "coulomb_friction" in (finding.effect, *finding.ambiguous_with)
    assert found(0.8).gain_scatter == pytest.approx(np.std(GAINS), rel=0.2)
    value, sigma = found(0.8).model.parameters.value("kv"), found(0.8).model.standard_errors["kv"]
    assert abs(value - PAPER_KV) < 3.0 * sigma and 0.003 < sigma / PAPER_KV < 0.02  # the gains are most of it
    assert not any("disagree" in note for note in found(0.8).model.notes)
    assert "differed by 1 % (RMS)" in summarize_diagnosis(found(0.8))
    assert "gains that differ by 1 % from run to run" in "".join(list_limits(found(0.8)))


def true_motor(recordings: tuple[Recording, ...]) -> Estimate:
    problem = make_problem(recordings, ())
    specs = problem.unknowns.specs
    values = zip((PAPER_KV, PAPER_KA), specs, strict=True)
    return Estimate(problem, np.array([np.log(x) if spec.logarithmic else x for x, spec in values]))


def test_a_gap_is_measured_without_what_the_gains_add() -> None:
    estimate, hold_out = true_motor(runs()), make_hold_out(runs(), ())
    model = judge_beside_torque(validate_model(hold_out, estimate), hold_out, None, 120)
    assert gains_may_differ(model) and model.errors.gain == pytest.approx(np.std(GAINS), rel=0.2)
    assert find_gap_less_gains(model) < 0.3 * model.held.gap
    assert find_gap_less_gains(model) < 1.3 * model.sensor_floor
    assert 0.7 < model.held.gap / model.noise_floor < 1.4  # of which the gains are the most


def list_certain(recordings: tuple[Recording, ...]) -> list[str]:
    """What is predicted of what the true motor leaves, beside a slow torque."""
    model = validate_model(make_hold_out(recordings, ()), true_motor(recordings))
    model = replace(model, learned=ErrorModel(0.02, 0.0, 0.05, 0.3))
    return [one.variable for one in model.structure if one.certain]


def test_what_a_run_alone_has_is_no_structure(monkeypatch: pytest.MonkeyPatch) -> None:
    """One of ten steps of a real motor ran 4 % slower; a curve over the voltage tells runs of one level by that."""
    slower, rubbing = runs(0.0, (1.0, 1.0, 0.95, *[1.0] * 5)), runs(0.8, (1.0,) * 8)
    assert list_certain(slower) == []
    assert "voltage" in list_certain(rubbing)  # of which it is a curve
    monkeypatch.setattr(candidate_model, "learn_own_gains", lambda *_: None)
    assert "voltage" in list_certain(slower)


def test_a_scatter_has_its_price_the_larger_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    estimate, hold_out = true_motor(runs()), make_hold_out(runs(), ())
    priced = judge_beside_torque(validate_model(hold_out, estimate), hold_out, None, 120)
    monkeypatch.setattr(candidate_fit, "price_scatter", lambda scatter: 0.0)
    free = judge_beside_torque(validate_model(hold_out, estimate), hold_out, None, 120)
    assert free.errors.gain == priced.errors.gain > 0.01
    assert free.likelihood - priced.likelihood == pytest.approx(priced.errors.gain / 0.02, rel=1e-6)


@pytest.mark.parametrize(("scatter", "hidden"), [(0.003, False), (0.05, True)])
def test_gains_hide_what_is_like_them(scatter: float, hidden: bool) -> None:
    """A friction in steps of one level each; a delay is like no gain."""
    estimate, hold_out = true_motor(runs()), make_hold_out(runs(), ())
    model = judge_beside_torque(validate_model(hold_out, estimate), hold_out, None, 120)
    told = find_undetectable(replace(model, learned=replace(model.errors, gain=scatter)))
    assert ("coulomb_friction" in told) is hidden and "transport_delay" not in told


def test_a_single_recording_to_validate_by_has_a_gain_of_its_own_too() -> None:
    estimate, hold_out = true_motor(runs()[1:]), make_hold_out(runs()[1:], runs()[:1])
    model = judge_beside_torque(validate_model(hold_out, estimate), hold_out, None, 120)
    assert model.errors.gain == pytest.approx(np.std(GAINS), rel=0.3)
    assert find_gap_less_gains(model) < 0.3 * model.held.gap < model.noise_floor


@pytest.mark.parametrize(("count", "gains"), [(6, (1.0,) * 8), (4, tuple(GAINS))], ids=["agree", "few"])
def test_runs_that_agree_and_few_runs_have_no_gains(count: int, gains: tuple[float, ...]) -> None:
    recordings = runs(0.0, gains)[:count]
    hold_out = make_hold_out(recordings, ())
    model = validate_model(hold_out, true_motor(recordings))
    assert not gains_may_differ(model) and find_gap_less_gains(model) == model.held.gap


@pytest.mark.parametrize(
    ("ks", "effect", "guess", "of_gains"),
    [
        (0.0, "direction_asymmetry", {"reverse_gain": 0.99}, True),
        (0.8, "coulomb_friction", {"ks": 0.5}, False),
    ],
)
def test_a_step_that_was_found_may_be_of_the_gains(
    ks: float, effect: str, guess: dict[str, float], of_gains: bool
) -> None:
    """Both have evidence where all runs are to have one gain; the friction is there."""
    estimate, hold_out = true_motor(runs(ks)), make_hold_out(runs(ks), ())
    before = validate_model(hold_out, fit_speeds(estimate))
    step = step_of(CandidateTest(effect, before, validate_model(hold_out, with_effect(before.estimate, effect, guess))))
    assert step.found.evidence > likelihood_threshold()
    assert may_be_of_gains(step, hold_out) is of_gains


def test_a_larger_supply_is_less_of_every_volt() -> None:
    estimate = true_motor(runs())
    larger = estimate.problem.angles(estimate.problem.unknowns.scale_supply(estimate.theta, 0.1))
    assert larger[2][-1] / estimate.angles[2][-1] == pytest.approx(1.1, rel=1e-3)
    assert estimate.supply_responses[2] == pytest.approx(estimate.angles[2], rel=0.01, abs=0.01)
