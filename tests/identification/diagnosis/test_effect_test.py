"""Which effects a model can be given, and which of those that were tried is the finding."""

from dataclasses import replace
from functools import cache
from typing import cast

import numpy as np
import pytest
from diagnosed import fitted
from plant import record
from stub_models import rescored, stub_model, stub_test

from motor_identification.diagnosis import effect_test, thresholds
from motor_identification.diagnosis.candidate_fit import validate_model
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import CandidateTest
from motor_identification.diagnosis.effect_test import (
    choose_finding,
    count_parameters,
    is_over_too_soon,
    is_static,
    list_candidates,
    sort_by_table,
    try_effects,
    try_load_once_a_turn,
)
from motor_identification.diagnosis.evidence.likeness import find_rivals
from motor_identification.diagnosis.evidence.line_evidence import adds_only_lines, count_waves
from motor_identification.diagnosis.start import begin
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.request import Request
from motor_identification.measurement.intervals import index_intervals
from motor_identification.noise.error_model import ErrorModel
from motor_identification.recording import Floats, Recording, check
from motor_identification.validation.hold_out import HoldOut
from motor_model.effects import EFFECTS
from motor_model.parameters import Parameters
from motor_model.sample import Measurement


def sine(turns: Floats) -> Recording:
    """A motor under a sine of so many periods from sample to sample, 10 s."""
    time, volts = np.linspace(0.0, 10.0, len(turns)), 6.0 * np.sin(2.0 * np.pi * turns)
    return record({"kv": 0.07, "ka": 0.006}, time, volts, seed=1, name="driven")[0]


def test_candidates_are_what_a_model_lacks_and_can_have() -> None:
    names = list_candidates(())
    assert names == [name for name in (effect.name for effect in EFFECTS) if name in names]  # in the table's order
    assert "coulomb_friction" in names and "static_friction" not in names  # which comes with Coulomb friction
    assert "missed_edges" not in names  # recognised in every fit, never fitted
    held = stub_model(5.0).held
    one = replace(held, recordings=(sine(np.linspace(0.0, 20.0, 2001)),), seen=True)
    several = replace(one, recordings=2 * one.recordings)
    assert list_candidates((), replace(several, seen=False, confirms=False)) == names
    once, repeating = {"load_step", "warm_up"}, {"torque_ripple", "encoder_eccentricity"}
    assert set(names) - set(list_candidates((), one)) == {"warm_up"}
    assert set(names) - set(list_candidates((), several)) == once
    assert list_candidates((), one, beside_torque=True) == names
    assert set(names) - set(list_candidates((), several, beside_torque=True)) == once
    for response in (one, several):
        for beside in (False, True):
            response = replace(response, confirms=False)
            assert set(names) - set(list_candidates((), response, beside)) == once | repeating
    noisy = replace(one, seen=False, intervals=tuple(replace(data, independent=True) for data in one.intervals))
    assert set(names) - set(list_candidates((), noisy)) == {"encoder_eccentricity"}  # no disc
    for jitter, window, hidden in ((0.1, 0.01, {"encoder_eccentricity"}), (0.02, 0.01, set()), (0.1, 0.0, set())):
        row = np.arange(200.0)
        end = 0.01 * (row + 1.0 + jitter * (row % 2.0))
        rows = index_intervals(end - 0.01, end, np.ones(200), np.zeros(200), window=window)
        uneven = replace(one, seen=False, intervals=(rows,))
        assert set(names) - set(list_candidates((), uneven)) == hidden  # nor where rows of speeds are uneven
    swept = replace(one, seen=False, recordings=(sine(np.linspace(0.0, 6.0, 2001) ** 2),))
    assert set(names) - set(list_candidates((), swept)) == {"warm_up"}  # which goes with the frequency as well
    assert list_candidates((), replace(swept, recordings=(*swept.recordings, *one.recordings))) == names
    info = replace(sine(np.zeros(2)).info, sample_period=20.0, speed_window=1.0, measurement=Measurement.SPEED)
    steady = replace(one, seen=False, recordings=(replace(one.recordings[0], info=info),))
    assert list_candidates((), steady) == [name for name in names if is_static(name)]
    assert "warm_up" not in list_candidates((), steady) and "dead_zone" in list_candidates((), steady)
    assert list_candidates((), replace(steady, recordings=(*steady.recordings, *one.recordings))) == names
    sliding = list_candidates(("coulomb_friction",))
    assert "static_friction" in sliding and "coulomb_friction" not in sliding
    steps = replace(one.recordings[0], voltage=np.where(one.recordings[0].voltage > 0.0, 9.6, 0.0))
    for recording, told in ((one.recordings[0], True), (steps, False)):  # at which of one voltage it breaks away
        assert (
            "static_friction" in list_candidates(("coulomb_friction",), replace(one, recordings=(recording,)))
        ) is told


@pytest.mark.parametrize(
    ("duration", "time_constant", "tried"),
    [
        (3.8, 0.106, False),  # seconds, and 36 time constants
        (9.99, 0.034, False),
        (10.01, 0.106, True),
        (3.01, 0.01, True),
        (2.99, 0.01, False),
    ],
)
def test_nothing_that_comes_slowly_is_looked_for_in_seconds(duration: float, time_constant: float, tried: bool) -> None:
    """A toy robot was said to warm up by 60 % within 3.8 s, and "It may be warm up" in a chirp of 4 s."""
    long = sine(np.linspace(0.0, 20.0, 2001))
    short, longer = (
        replace(long, sample_time=np.rint(long.sample_time * (much / long.duration)).astype(np.int64))
        for much in (duration, 20.0)
    )
    motor = Parameters({"kv": 0.07, "ka": 0.07 * time_constant})
    held = replace(stub_model(5.0).held, recordings=(short,), parameters=motor)
    assert ("warm_up" in list_candidates((), held)) is tried
    assert is_over_too_soon("warm_up", held) is not tried
    assert not is_over_too_soon("load_step", held) and not is_over_too_soon("quadratic_drag", held)
    both = replace(held, recordings=(short, longer))  # one of which is long enough
    assert "warm_up" in list_candidates((), both)


def test_the_most_likely_is_the_finding_not_the_most_relevant() -> None:
    before = stub_model(5.0)
    tests = [stub_test("load_bias", before, 2.0, 300.0), stub_test("dead_zone", before, 1.0, 200.0)]
    assert choose_finding(tests) is tests[0]


def test_what_is_likely_but_irrelevant_is_passed_over() -> None:
    before = stub_model(5.0)
    tests = [stub_test("load_bias", before, 4.99, 300.0), stub_test("dead_zone", before, 1.0, 200.0)]
    assert choose_finding(tests) is tests[1]
    assert choose_finding(tests[:1]) is None and choose_finding([]) is None


@pytest.mark.parametrize(("training", "found"), [(0.0, True), (-0.01, False)])
def test_what_fits_its_own_training_data_worse_is_no_finding(training: float, found: bool) -> None:
    """Of a ripple's phases in held-out motion, which are fitted anew with it, any effect may make a little more."""
    test = stub_test("load_bias", stub_model(5.0), 2.0, 300.0)
    test = replace(test, model=rescored(test.model, training=test.before.score.training + training))
    assert (choose_finding([test]) is test) is found


def test_of_equals_more_parameters_are_not_taken() -> None:
    """A load that appears once is as likely as a constant one, and has a parameter more: order in the table or not."""
    before = stub_model(5.0)
    load = stub_test("transport_delay", before, 1.0, 300.0)
    step = stub_test("load_step", before, 1.0, 299.9)
    assert count_parameters("load_step") > count_parameters("transport_delay")
    assert choose_finding([load, step]) is load
    assert find_rivals(load, [load, step]) == () and find_rivals(step, [load, step]) == ("transport_delay",)


@pytest.mark.parametrize(("share", "first"), [(1.01, "dead_zone"), (0.99, "load_step")])
def test_what_needs_an_instant_comes_after_what_does_about_as_well(share: float, first: str) -> None:
    """A slow torque is worth more to a load that may begin anywhere than what little speaks against a friction."""
    before = stub_model(5.0)
    step = stub_test("load_step", before, 1.0, 300.0)
    zone = stub_test("dead_zone", before, 1.2, share * thresholds.COMES_FIRST * 300.0)
    chosen = choose_finding([step, zone])
    assert chosen is not None and chosen.effect == first
    assert choose_finding([step]) is step


@pytest.mark.parametrize(
    ("ripple", "friction", "first"),
    [(5.1, 3.5, "load_bias"), (4.9, 3.5, "dead_zone"), (5.1, 3.7, "dead_zone")],
)
def test_what_predicts_worse_is_none_where_another_takes_away_most(
    monkeypatch: pytest.MonkeyPatch, ripple: float, friction: float, first: str
) -> None:
    """A torque ripple beside a random torque left 1.08 of the gap, ten times as likely as a friction that left 0.4."""
    before = stub_model(5.0)
    tests = [stub_test("dead_zone", before, ripple, 400.0), stub_test("load_bias", before, friction, 40.0)]
    monkeypatch.setattr(CandidateTest, "relevant", True)
    chosen = choose_finding(tests)
    assert chosen is not None and chosen.effect == first


def test_effects_are_sorted_as_in_the_table() -> None:
    assert sort_by_table(["dead_zone", "coulomb_friction", "load_bias"]) == (
        "coulomb_friction",
        "load_bias",
        "dead_zone",
    )
    assert sort_by_table([]) == ()


@pytest.mark.parametrize("workers", [1, 2])
def test_friction_is_the_most_likely_of_what_is_tried(workers: int) -> None:
    estimate, hold_out = fitted(ks=0.4)
    heard: list[CandidateTest] = []
    names = ["coulomb_friction", "voltage_limit", "quadratic_drag"]
    tests = try_effects(validate_model(hold_out, estimate), hold_out, names, workers, heard.append)
    assert sorted(test.effect for test in heard) == sorted(names)
    assert [test.evidence for test in tests] == sorted((test.evidence for test in tests), reverse=True)
    assert tests[0].effect == "coulomb_friction" and tests[0].evidence > 1000.0
    assert tests[0].explains > 0.99 and choose_finding(tests) is tests[0]
    useless = next(test for test in tests if test.effect == "voltage_limit")
    assert useless.model is useless.before and useless.evidence == 0.0 and not useless.relevant  # nothing was promised


@cache
def tried(effect: str, **hidden: float) -> CandidateTest:
    """That effect, tried where it is hidden."""
    estimate, hold_out = fitted(**hidden)
    (test,) = try_effects(validate_model(hold_out, estimate), hold_out, [effect], 1, lambda test: None)
    return test


@pytest.mark.parametrize(("share", "found"), [(0.5, False), (1.5, True)])
def test_what_begins_with_the_recording_is_constant(share: float, found: bool) -> None:
    """However likely: an instant at the start is a load that is always there, or a wrong initial speed."""
    test = tried("load_step", ks=0.0, step_voltage=0.6, step_time=2.5)
    fit = test.model.estimate
    column = fit.problem.unknowns.names.index("step_time")
    assert choose_finding([test]) is test and 2.0 < fit.theta[column] < 3.0
    theta = fit.theta.copy()
    theta[column] = share * thresholds.FROM_THE_START * fit.problem.recordings[0].duration
    moved = replace(test, model=replace(test.model, estimate=replace(fit, theta=theta)))
    assert (choose_finding([moved]) is moved) is found


@pytest.mark.parametrize(("share", "found"), [(0.5, False), (1.5, True)])
def test_what_begins_with_the_first_motion_is_constant(
    monkeypatch: pytest.MonkeyPatch, share: float, found: bool
) -> None:
    """A motor that was not driven for two seconds tells of no load in them."""
    test = tried("load_step", ks=0.0, step_voltage=0.6, step_time=2.5)
    fit = test.model.estimate
    instant = float(fit.theta[fit.problem.unknowns.names.index("step_time")])
    begin = instant - share * thresholds.FROM_THE_START * fit.problem.recordings[0].duration
    monkeypatch.setattr(effect_test, "list_first_motions", lambda problem: (begin,))
    assert (choose_finding([test]) is test) is found


@pytest.mark.parametrize(("share", "found"), [(0.9, False), (1.1, True)])
def test_what_begins_on_the_way_from_the_first_step_is_constant(
    monkeypatch: pytest.MonkeyPatch, share: float, found: bool
) -> None:
    """In a long recording 2 % are many time constants; in a short one the motor has shown no state without the load."""
    test = tried("load_step", ks=0.0, step_voltage=0.6, step_time=2.5)
    fit = test.model.estimate
    instant = float(fit.theta[fit.problem.unknowns.names.index("step_time")])
    begin = instant - share * thresholds.ON_ITS_WAY * fit.parameters.time_constant
    monkeypatch.setattr(thresholds, "FROM_THE_START", 0.0)
    monkeypatch.setattr(effect_test, "list_first_motions", lambda problem: (begin,))
    assert (choose_finding([test]) is test) is found


@pytest.mark.parametrize(("waves", "found"), [(0.9, False), (1.1, True)])
def test_a_line_comes_back_a_few_times(waves: float, found: bool) -> None:
    """Of fewer waves from one end of the motion to the other it is any slow torque."""
    test = tried("torque_ripple", ripple_voltage=0.4, ripple_cycles=6.0, ripple_phase=0.5)
    assert choose_finding([test]) is test
    fit = test.model.estimate
    theta = fit.theta.copy()
    cycles = waves * thresholds.LEAST_WAVES / test.model.turns
    theta[fit.problem.unknowns.names.index("ripple_cycles")] = cycles
    few = replace(test.model, estimate=replace(fit, theta=theta))
    few.__dict__["turns"] = test.model.turns
    assert count_waves(few, "torque_ripple") == pytest.approx(waves * thresholds.LEAST_WAVES)
    assert count_waves(few, "coulomb_friction") == np.inf == count_waves(test.before, "torque_ripple")
    assert (choose_finding([replace(test, model=few)]) is not None) is found
    disc = tried("encoder_eccentricity", eccentricity=0.05, eccentricity_phase=0.5)
    assert choose_finding([disc]) is disc and count_waves(disc.model, "encoder_eccentricity") == disc.model.turns


@pytest.mark.parametrize(
    ("turns", "limit", "explains", "found"),
    [
        (0.9, "LEAST_TURNS", 1.01, False),  # a third of a turn, to and fro, is no disc that comes back
        (1.1, "LEAST_TURNS", 1.01, True),
        (0.9, "LEAST_WAVES", 0.99, False),
        (1.1, "LEAST_WAVES", 0.99, True),
    ],
)
def test_a_disc_of_few_turns_takes_away_most_of_what_is_left(
    monkeypatch: pytest.MonkeyPatch, turns: float, limit: str, explains: float, found: bool
) -> None:
    disc = tried("encoder_eccentricity", eccentricity=0.05, eccentricity_phase=0.5)
    monkeypatch.setattr(thresholds, "MOST_OF_GAP", disc.explains / explains)
    within = replace(disc.model)
    within.__dict__["turns"] = turns * getattr(thresholds, limit)
    assert (choose_finding([replace(disc, model=within)]) is not None) is found


@pytest.mark.parametrize(("waves", "alone"), [(0.9, False), (1.1, True)])
def test_lines_of_many_waves_are_their_own_evidence(waves: float, alone: bool) -> None:
    test = tried("torque_ripple", ripple_voltage=0.4, ripple_cycles=6.0, ripple_phase=0.5)
    line = replace(test.model)
    seen = count_waves(test.model, "torque_ripple") / test.model.turns
    line.__dict__["turns"] = waves * thresholds.MANY_WAVES / seen
    assert adds_only_lines(line, test.before) is alone
    assert not adds_only_lines(line, line)  # what adds nothing adds no line
    friction = tried("coulomb_friction", ks=0.5)
    assert not adds_only_lines(friction.model, friction.before)


@pytest.mark.parametrize(
    ("evidence", "gap", "gains", "fits"),
    [
        (0.1, 5.0, [9.0, 9.0, 9.0, 9.0], thresholds.REFINEMENTS),
        (0.1, 5.0, [1.01 * thresholds.TIE_LIKELIHOOD, 0.99 * thresholds.TIE_LIKELIHOOD, 9.0], 2),
        (-0.99 * thresholds.HELD_BACK, 0.99 * thresholds.HELD_BACK_GAP * 5.0, [0.0], 1),
        (-0.99 * thresholds.HELD_BACK, 1.01 * thresholds.HELD_BACK_GAP * 5.0, [0.0], 0),
        (-1.01 * thresholds.HELD_BACK, 0.99 * thresholds.HELD_BACK_GAP * 5.0, [0.0], 0),
    ],
)
def test_a_candidate_is_fitted_beside_the_torque_that_it_leaves_as_long_as_that_helps(
    monkeypatch: pytest.MonkeyPatch, evidence: float, gap: float, gains: list[float], fits: int
) -> None:
    """Beside the torque that a model without an asymmetry leaves, half of it is the likeliest."""
    before = replace(stub_model(5.0), learned=ErrorModel(0.0, 0.0, 1.0, 1.0))
    candidate = stub_test("direction_asymmetry", before, gap, evidence).model
    fitted_again: list[Model] = []

    def refine(model: Model, hold_out: object) -> Model:
        fitted_again.append(model)
        return rescored(model, likelihood=model.likelihood + gains[len(fitted_again) - 1])

    monkeypatch.setattr(effect_test, "fit_with_effect", lambda *rest: object())
    monkeypatch.setattr(effect_test, "validate_model", lambda *rest: candidate)
    monkeypatch.setattr(effect_test, "refine_beside_torque", refine)
    whole = replace(before, estimate=cast(Estimate, object()))
    (test,) = try_effects(whole, cast(HoldOut, object()), ["direction_asymmetry"], 1, lambda test: None)
    assert len(fitted_again) == fits
    assert test.evidence == pytest.approx(evidence + sum(gains[:fits]))


def test_a_torque_once_a_turn_is_told_from_a_disc_however_few_turns_there_are() -> None:
    """The spectrum promises next to nothing of so few waves."""
    time = 0.01 * np.arange(800)
    volts = np.repeat([3.0, 6.0, 4.0, 7.0], 200)
    load = {"ripple_voltage": 1.2, "ripple_cycles": 1.0, "ripple_phase": 0.3}
    start = begin([check(record({"kv": 2.0, "ka": 0.2, **load}, time, volts, seed=1)[0])], (), Request(), bool)
    current, hold_out = start.selection.model, start.selection.hold_out
    assert 1.0 < current.turns < thresholds.LEAST_WAVES
    test = try_load_once_a_turn(current, hold_out)
    (disc,) = try_effects(current, hold_out, ["encoder_eccentricity"], 1, lambda test: None)
    assert test.evidence > disc.evidence + thresholds.RIVAL_MARGIN
    found = test.model.estimate.parameters
    assert found.value("ripple_voltage") == pytest.approx(1.2, rel=0.05)
    assert found.value("ripple_cycles") == pytest.approx(1.0, abs=0.02)
