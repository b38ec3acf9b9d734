"""Whether what an effect takes away is likely and matters, on models of made-up gaps and likelihoods."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from stub_models import COUNT, FLOOR, LASTING_FLOOR, STEP, StubModel, late_by, stub_held, stub_model, stub_test

from motor_identification.diagnosis import candidate_test, thresholds
from motor_identification.diagnosis.candidate_model import Model, Score
from motor_identification.diagnosis.candidate_test import (
    CandidateTest,
    likelihood_threshold,
    share_explained,
    takes_away_more,
)
from motor_identification.noise.error_model import ErrorModel
from motor_model.effects import LAGS
from motor_model.parameters import PAPER_KA, PAPER_KV


@pytest.mark.parametrize(("gap", "lasting"), [(3.0, 3.0), (3.0, 1.0), (1.0, 0.0)])
def test_the_stubs_are_what_they_say(gap: float, lasting: float) -> None:
    held = stub_held(gap, lasting)
    assert held.gap == pytest.approx(gap) and held.floor(0.0) == pytest.approx(FLOOR)
    assert held.joined(0.1).gap == pytest.approx(lasting, abs=1e-12)
    assert held.joined(0.1).floor(0.0) == pytest.approx(LASTING_FLOOR)


def test_the_share_explained_is_of_squares_above_the_floor() -> None:
    assert share_explained(5.0, 1.0, 1.0) == pytest.approx(1.0)
    assert share_explained(5.0, 5.0, 1.0) == 0.0
    assert share_explained(5.0, 3.0, 1.0) == pytest.approx(16.0 / 24.0)
    assert share_explained(5.0, 6.0, 1.0) < 0.0
    assert share_explained(0.9, 0.8, 1.0) == 1.0  # nothing was there to explain


def test_evidence_is_the_logarithm_of_a_likelihood_ratio() -> None:
    before = stub_model(5.0, likelihood=-100.0)
    test = stub_test("coulomb_friction", before, 1.0, 30.0)
    assert test.evidence == pytest.approx(30.0) and test.explains == pytest.approx(1.0)


def beside_torque(gap: float, held_out: float, evidence: float = 0.0) -> Model:
    """A model beside a random torque, which 2000 intervals of even moments speak for."""
    errors, moments = ErrorModel(0.0, 0.0, 0.1, 0.1), np.full(200, evidence / 200)
    return replace(stub_model(gap), learned=errors, score=Score(0.0, held_out=held_out, scored=2000, moments=moments))


@pytest.mark.parametrize(
    ("effect", "growth", "said", "relevant"),
    [
        ("quadratic_drag", 1.0, 0.1, True),
        ("quadratic_drag", 1.001, 0.1, False),
        ("quadratic_drag", 0.999 * thresholds.GAP_CHANCE, 1.001 * likelihood_threshold(), True),
        ("quadratic_drag", 0.999 * thresholds.GAP_CHANCE, 0.999 * likelihood_threshold(), False),
        ("quadratic_drag", 1.0008, 4.8, True),  # a friction of counts of which a row has one or two
        ("quadratic_drag", 1.001 * thresholds.GAP_TIE, 4.8, False),
        ("quadratic_drag", 0.999 * thresholds.GAP_TIE, 1.01 * thresholds.TIE_LIKELIHOOD, True),
        ("quadratic_drag", 0.999 * thresholds.GAP_TIE, 0.99 * thresholds.TIE_LIKELIHOOD, False),
        ("quadratic_drag", 1.001 * thresholds.GAP_CHANCE, 100.0, False),  # it fits the torque instead of the motion
        ("torque_ripple", 0.999 * thresholds.GAP_CHANCE, 0.1, True),
        ("torque_ripple", 1.0, -0.1, False),
    ],
)
def test_beside_a_torque_a_gap_may_grow_by_chance_where_held_out_motion_speaks_for_an_effect(
    effect: str, growth: float, said: float, relevant: bool
) -> None:
    before, model = beside_torque(2.0, -100.0), beside_torque(2.0 * growth, -100.0 + said, 60.0)
    assert CandidateTest(effect, before, model).relevant is relevant


@pytest.mark.parametrize(
    ("growth", "lasting", "relevant"), [(1.031, 0.999, True), (1.031, 1.001, False), (1.029, 1.001, True)]
)
def test_what_lasts_grows_no_more_than_a_gap_may_by_chance(
    growth: float, lasting: float, relevant: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A drag was named, likelier by 27, by which what lasts grew by half, and a coarse sensor's gap by 7 %."""
    before, model = beside_torque(2.0, -100.0), beside_torque(2.0 * growth, -90.0, 60.0)
    after = SimpleNamespace(gap=2.0 * lasting * thresholds.GAP_CHANCE)
    monkeypatch.setattr(CandidateTest, "_join_lasting", lambda _: (SimpleNamespace(gap=2.0), after))
    assert CandidateTest("quadratic_drag", before, model).relevant is relevant


@pytest.mark.parametrize(
    ("effect", "falls", "likely"),
    [
        ("quadratic_drag", 0.999, True),
        ("quadratic_drag", 1.001, False),
        ("load_step", 0.5, False),  # which are fitted to a slow torque
        ("torque_ripple", 0.5, False),
    ],
)
def test_what_takes_away_much_of_the_gap_need_not_speak_all_the_time(effect: str, falls: float, likely: bool) -> None:
    """Beside a torque: what bends the motion between a few steps one way speaks in the moments in which they change."""
    before = beside_torque(2.0, -100.0)
    model = beside_torque(2.0 * thresholds.PREDICTING_GAP * falls, -90.0)
    few = np.zeros(200)
    few[:5] = 10.0
    model = replace(model, score=replace(model.score, likelihood=20.0, moments=few))
    test = CandidateTest(effect, before, model)
    assert test.steadiness == 0.0 and test.predicts is likely
    assert test.is_likely(19.0) is likely and not test.is_likely(21.0) and test.relevant is likely


@pytest.mark.parametrize(("times", "steady", "likely"), [(0.99, 9.0, False), (1.01, 9.0, True), (1.01, 7.0, False)])
def test_an_instant_beside_a_torque_is_one_of_many(times: float, steady: float, likely: bool) -> None:
    """It has to be likelier than what has none, and so without its few best moments, like anything."""
    before = beside_torque(2.0, -100.0)
    moments = np.full(200, steady / 190.0)
    model = beside_torque(1.0, -90.0)
    said = times * thresholds.INSTANT_LIKELIHOOD
    model = replace(model, score=replace(model.score, likelihood=said, moments=moments))
    test = CandidateTest("load_step", before, model)
    assert test.steadiness == pytest.approx(steady) and 7.0 < likelihood_threshold() < 9.0
    assert test.is_likely(likelihood_threshold()) is likely
    assert CandidateTest("load_bias", before, model).is_likely(likelihood_threshold())  # falls by half, too


@pytest.mark.parametrize(
    ("effect", "times", "seen", "likely"),
    [
        ("load_step", 0.99, True, False),
        ("load_step", 1.01, True, True),
        ("load_step", 0.99, False, True),
        ("load_bias", 0.99, True, True),
    ],
)
def test_an_instant_in_motion_that_was_fitted_is_one_of_many(
    effect: str, times: float, seen: bool, likely: bool
) -> None:
    """A real wheel that coasts at no command alone had a load step, likelier by 17, and a load to drive it before."""
    before = stub_model(2.0, likelihood=-100.0)
    before = replace(before, held=replace(before.held, seen=seen))
    test = CandidateTest(effect, before, stub_model(1.0, likelihood=times * thresholds.INSTANT_LIKELIHOOD - 100.0))
    assert test.is_likely(likelihood_threshold()) is likely


@pytest.mark.parametrize(
    ("times", "steady", "grows", "seen", "likely"),
    [
        (0.99, 9.0, 0.999, True, False),
        (1.01, 9.0, 0.999, True, True),
        (1.01, 7.0, 0.999, True, False),
        (1.01, 9.0, 1.001, True, False),
        (0.5, 9.0, 1.001, False, True),  # of motion that no fit has seen it is one effect of all
    ],
)
def test_what_comes_slowly_in_motion_that_was_fitted_is_what_a_slow_torque_does(
    times: float, steady: float, grows: float, seen: bool, likely: bool
) -> None:
    """It has to be as likely as what begins at an instant, and the gap must not grow."""
    before = beside_torque(2.0, -100.0)
    before = replace(before, held=replace(before.held, seen=seen))
    model = beside_torque(2.0 * grows, -90.0)
    said = times * thresholds.INSTANT_LIKELIHOOD
    model = replace(model, score=replace(model.score, likelihood=said, moments=np.full(200, steady / 190.0)))
    assert CandidateTest("warm_up", before, model).is_likely(likelihood_threshold()) is likely


@pytest.mark.parametrize(("times", "relevant"), [(0.99, False), (1.01, True)])
@pytest.mark.parametrize("rows", [100, 10_000, 1_000_000])
def test_rows_much_finer_than_a_motor_ask_for_no_more(rows: int, times: float, relevant: bool) -> None:
    """What is taken of the white rest is a share of a dozen rows a time constant, however many there are."""
    before, model = beside_torque(2.0, -100.0), beside_torque(1.9, -90.0)
    most = thresholds.RELEVANT_ROWS * COUNT * STEP * PAPER_KV / PAPER_KA
    assert 100 < most < 1000
    steady = times * 0.5 * thresholds.RELEVANT_WHITE_SHARE * min(rows, most)
    score = replace(model.score, scored=rows, moments=np.full(200, steady / 190.0))
    assert CandidateTest("quadratic_drag", before, replace(model, score=score)).relevant is relevant


@pytest.mark.parametrize(
    ("more", "torque", "falls", "taken"),
    [
        (("transport_delay",), 0.0, 1.001, False),
        (("transport_delay",), 0.0, 0.999, True),
        (("transport_delay",), 0.1, 1.001, True),
        (("armature_inductance",), 0.0, 1.001, False),
        (("coulomb_friction",), 0.0, 1.001, True),
    ],
)
def test_a_lag_beside_no_torque_has_to_take_away_of_the_gap(
    monkeypatch: pytest.MonkeyPatch, more: tuple[str, ...], torque: float, falls: float, taken: bool
) -> None:
    """It may be of the recording: a clock, a filter."""
    plain, model = stub_model(2.0), stub_model(2.0 * thresholds.SHRINKING_GAP * falls, estimate=late_by(0.1))
    effects: dict[int, Any] = {id(model): more}
    monkeypatch.setattr(StubModel, "effects", property(lambda self: effects.get(id(self), ())))
    monkeypatch.setattr(StubModel, "errors", ErrorModel(0.0, 0.0, torque, 1.0))
    assert takes_away_more(model, plain) is taken


@pytest.mark.parametrize(("falls", "taken"), [(1.001, False), (0.999, True)])
def test_a_lag_may_take_away_of_what_lasts_alone(monkeypatch: pytest.MonkeyPatch, falls: float, taken: bool) -> None:
    """From row to row a coarse sensor hides it."""
    lasting = thresholds.SHRINKING_LASTING_GAP * falls
    plain, model = stub_model(2.0, 1.0), stub_model(2.0, lasting, estimate=late_by(0.1))
    effects: dict[int, Any] = {id(model): ("armature_inductance",)}
    monkeypatch.setattr(StubModel, "effects", property(lambda self: effects.get(id(self), ())))
    assert takes_away_more(model, plain) is taken


@pytest.mark.parametrize("lag", LAGS)
@pytest.mark.parametrize(("rows", "taken"), [(0.49, False), (0.51, True)])
def test_a_lag_longer_than_rows_are_late_is_the_motors(
    monkeypatch: pytest.MonkeyPatch, lag: str, rows: float, taken: bool
) -> None:
    """A delay of a row of 1 ms, known within a hundredth of it, was taken for one of the recording."""
    plain, model = stub_model(2.0), stub_model(2.0, estimate=late_by(rows))
    effects: dict[int, Any] = {id(model): (lag,)}
    monkeypatch.setattr(StubModel, "effects", property(lambda self: effects.get(id(self), ())))
    assert takes_away_more(model, plain) is taken


@pytest.mark.parametrize(
    ("effect", "falls", "relevant"),
    [
        ("coulomb_friction", 0.999, True),
        ("dead_zone", 0.999, True),
        ("static_friction", 0.999, False),
        ("transport_delay", 0.999, False),
        ("coulomb_friction", 1.001, False),  # the gap has to fall at all
    ],
)
def test_a_friction_that_explains_most_of_the_time_is_relevant_whatever_is_left_in_few_moments(
    monkeypatch: pytest.MonkeyPatch, effect: str, falls: float, relevant: bool
) -> None:
    monkeypatch.setattr(candidate_test, "explains_standstills", lambda *_: False)
    before = stub_model(20.0)
    test = stub_test(effect, before, 20.0 * falls, 100.0)
    assert not test.relevant
    monkeypatch.setattr(
        candidate_test, "explains_calm", lambda without, model: without is before and model is test.model
    )
    assert not stub_test(effect, before, 20.0 * falls, 100.0).relevant  # another model
    assert replace(test).relevant is relevant


@pytest.mark.parametrize(
    ("gap", "share", "relevant"),
    [
        (1.02 * thresholds.NEAR_FLOOR_SEEN, 1.02 * thresholds.RELEVANT_SHARE_NEAR_FLOOR, True),
        (1.02 * thresholds.NEAR_FLOOR_SEEN, 0.98 * thresholds.RELEVANT_SHARE_NEAR_FLOOR, False),
        (0.98 * thresholds.NEAR_FLOOR_SEEN, 1.02 * thresholds.RELEVANT_SHARE_NEAR_FLOOR, False),  # the sensor hides it
    ],
)
def test_what_takes_most_from_row_to_row_needs_not_last_where_the_sensor_leaves_little(
    gap: float, share: float, relevant: bool
) -> None:
    """A friction beside a dead time in rows of half a time constant, which joined intervals did not show."""
    left = np.sqrt(gap**2 - share * (gap**2 - FLOOR**2))
    before, after = stub_model(gap, 0.7 * FLOOR), stub_model(left, 0.8 * FLOOR, likelihood=30.0)
    assert CandidateTest("quadratic_drag", before, after).relevant is relevant


@pytest.mark.parametrize(
    ("effect", "falls", "relevant"),
    [
        ("coulomb_friction", 0.999, True),
        ("dead_zone", 0.999, True),
        ("static_friction", 0.999, True),
        ("quadratic_drag", 0.999, False),  # it holds nothing
        ("coulomb_friction", 1.001, False),  # the gap has to fall at all
    ],
)
def test_what_holds_a_motor_where_it_stood_under_a_voltage_is_relevant_whatever_is_left_in_motion(
    monkeypatch: pytest.MonkeyPatch, effect: str, falls: float, relevant: bool
) -> None:
    """A wheel on the floor stood for 44 % of the time; what its dips left was 45 times the floor with a friction."""
    before = stub_model(20.0)
    test = stub_test(effect, before, 20.0 * falls, 100.0)
    monkeypatch.setattr(candidate_test, "explains_calm", lambda *_: False)
    monkeypatch.setattr(
        candidate_test, "explains_standstills", lambda without, model: without is before and model is test.model
    )
    assert not stub_test(effect, before, 20.0 * falls, 100.0).relevant  # another model
    assert replace(test).relevant is relevant


@pytest.mark.parametrize(("lasting", "moves", "relevant"), [(0.99, 0.9, False), (0.99, 1.1, True), (1.01, 0.9, True)])
def test_what_moves_a_model_at_the_sensors_floor_by_next_to_nothing_is_no_finding(
    lasting: float, moves: float, relevant: bool
) -> None:
    """However likely: a load of 5e-5 V of 9 V beside a sag, by which the gap fell from 2.460238 to 2.460234 rad/s."""
    floor = thresholds.RELEVANT_GAP * LASTING_FLOOR
    before, model = beside_torque(1.0, -100.0), beside_torque(1.0, -10.0, 60.0)
    shift = moves * thresholds.SAME_MOTION * FLOOR
    before = replace(before, held=stub_held(1.0, lasting * floor))
    held = stub_held(1.0, lasting * floor)
    (angle,) = held.angles
    model = replace(model, held=replace(held, angles=(angle - shift * np.append(0.0, STEP * np.arange(1, COUNT + 1)),)))
    assert CandidateTest("load_bias", before, model).relevant is relevant


@pytest.mark.parametrize(
    ("effect", "above", "rms", "lasts", "of_torque"),
    [
        ("static_friction", 0.999 * thresholds.BREAKAWAY_SIGMA * 0.1, 0.1, 1.0, True),
        ("static_friction", 1.001 * thresholds.BREAKAWAY_SIGMA * 0.1, 0.1, 1.0, False),
        ("static_friction", 0.1, 0.1, 0.99, False),  # rather the sensor's noise
        ("static_friction", 0.1, None, 1.0, False),  # beside none
        ("coulomb_friction", 0.1, 0.1, 1.0, False),
    ],
)
def test_a_breakaway_that_a_random_torque_makes_is_not_likely(
    effect: str, above: float, rms: float | None, lasts: float, of_torque: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of a friction and a ripple a breakaway 1.76 times the torque above the friction was likelier by 90."""
    monkeypatch.setattr(candidate_test, "was_held", lambda model: False)
    row = 0.005
    values = {"ks": 0.4, "breakaway_voltage": 0.4 + above}
    estimate: Any = SimpleNamespace(
        parameters=SimpleNamespace(value=values.__getitem__), problem=SimpleNamespace(sample_period=row)
    )
    errors = ErrorModel(0.0, 0.0, rms or 0.0, lasts * row)
    moments = np.full(200, 90.0 / 200)

    class Disturbed(StubModel):
        @property
        def errors(self) -> ErrorModel:  # type: ignore[override]
            return errors

    def model(likelihood: float, moments: np.ndarray) -> Model:
        score = Score(likelihood, held_out=likelihood, scored=2000, moments=moments)
        stub = stub_model(1.0)
        return Disturbed(estimate, stub.held, stub.noise, score, None if rms is None else errors)

    test = CandidateTest(effect, model(0.0, np.zeros(200)), model(90.0, moments))
    assert test.is_of_torque is of_torque and test.is_likely(likelihood_threshold()) is not of_torque
