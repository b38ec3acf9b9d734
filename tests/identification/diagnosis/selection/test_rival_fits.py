"""What is tried in the place of a finding is fitted to the end from where it has as good a chance."""

from dataclasses import replace
from typing import cast

import pytest
from stub_models import stub_model, with_effects

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_test import CandidateTest
from motor_identification.diagnosis.selection import rival_fits as module
from motor_identification.diagnosis.selection.rival_fits import (
    catch_up,
    settle,
    start_from_same_size,
    start_where_found,
)
from motor_identification.diagnosis.selection.selection import SelectionStep
from motor_identification.estimation.estimate import Estimate
from motor_identification.noise.error_model import ErrorModel
from motor_identification.validation.hold_out import HoldOut

BELOW, ABOVE = 0.999, 1.001


@pytest.mark.parametrize(
    ("gap", "likelihood", "settled"),
    [(1.09, -600.0, True), (1.11, -600.0, False), (1.09, -499.0, False)],
)
def test_what_moves_nearly_alike_is_fitted_to_the_end_before_it_is_called_less_likely(
    monkeypatch: pytest.MonkeyPatch, gap: float, likelihood: float, settled: bool
) -> None:
    current = stub_model(1.0, 0.0, likelihood=-500.0)
    tried = CandidateTest("load_bias", stub_model(2.0, 0.0), stub_model(gap, 0.0, likelihood=likelihood))
    for end, better in ((-500.5, True), (-600.5, False)):
        again = stub_model(1.0, 0.0, likelihood=end)
        monkeypatch.setattr(module, "fit_again", lambda model, hold_out, again=again: again)
        found = settle(tried, current, cast(HoldOut, None)).model
        assert found is (again if settled and better else tried.model)


@pytest.mark.parametrize(
    ("gap", "likelihood", "again", "caught_up"),
    [
        (BELOW * thresholds.GAP_CHANCE, -499.0, -440.0, True),  # the other was fitted further, and is no better
        (ABOVE * thresholds.GAP_CHANCE, -499.0, -440.0, False),
        (BELOW * thresholds.GAP_CHANCE, -501.0, -440.0, False),
        (BELOW * thresholds.GAP_CHANCE, -499.0, -510.0, False),
    ],
)
def test_the_model_is_fitted_to_the_end_before_another_is_called_likelier(
    monkeypatch: pytest.MonkeyPatch, gap: float, likelihood: float, again: float, caught_up: bool
) -> None:
    current, fitted_again = stub_model(1.0, 0.0, likelihood=-500.0), stub_model(1.0, 0.0, likelihood=again)
    test = CandidateTest("load_step", stub_model(9.0), stub_model(gap, 0.0, likelihood=likelihood))
    monkeypatch.setattr(module, "fit_again", lambda *_: fitted_again)
    left = catch_up(current, [test], cast(HoldOut, None))
    assert left is (fitted_again if caught_up else current)


@pytest.mark.parametrize(
    ("loss", "beside", "rivals", "begun"),
    [
        (ABOVE * thresholds.RIVAL_MARGIN, True, ("coulomb_friction",), True),
        (BELOW * thresholds.RIVAL_MARGIN, True, ("coulomb_friction",), False),  # it is a rival already
        (ABOVE * thresholds.RIVAL_MARGIN, False, ("coulomb_friction",), False),
        (ABOVE * thresholds.RIVAL_MARGIN, True, (), False),
    ],
)
def test_a_rival_is_fitted_beside_a_torque_from_where_it_did_as_well_without(
    monkeypatch: pytest.MonkeyPatch, loss: float, beside: bool, rivals: tuple[str, ...], begun: bool
) -> None:
    """The torque that is left without both is most of what they explain: from there the motor ran away."""
    before, plain, better = stub_model(9.0), with_effects(stub_model(1.0), "coulomb_friction"), stub_model(1.0)
    plain = replace(plain, estimate=cast(Estimate, object()))
    found = CandidateTest("dead_zone", before, with_effects(stub_model(1.0), "dead_zone"))
    step = SelectionStep(before, found, (found, CandidateTest("coulomb_friction", before, plain)), rivals, 0.99)
    astray = with_effects(stub_model(1.0, likelihood=-loss), "coulomb_friction")
    current = replace(stub_model(1.0), learned=ErrorModel(0.0, 0.0, 0.1, 0.1) if beside else None)
    monkeypatch.setattr(module, "find_loss", lambda test, model, effect: loss)
    monkeypatch.setattr(module, "refine_beside_torque", lambda model, hold_out, begin: (model.learned, begin, better))
    test = CandidateTest("coulomb_friction", before, astray)
    left = start_where_found(test, step, current, cast(HoldOut, None))
    if begun:
        assert left.model == (current.learned, plain.estimate, better)
    else:
        assert left is test


@pytest.mark.parametrize(
    ("effect", "instead", "loss", "end", "again"),
    [
        ("dead_zone", "coulomb_friction", ABOVE, 50.0, True),
        ("dead_zone", "coulomb_friction", ABOVE, -50.0, False),  # which leads to worse
        ("dead_zone", "coulomb_friction", BELOW, 50.0, False),  # it is a rival already
        ("dead_zone", "load_bias", ABOVE, 50.0, False),  # which holds nothing
    ],
)
def test_what_holds_the_motor_is_fitted_from_the_size_of_what_it_stands_in_for(
    monkeypatch: pytest.MonkeyPatch, effect: str, instead: str, loss: float, end: float, again: bool
) -> None:
    """Beside a ripple a friction ended 12 % short of the gap that it leaves from a dead zone's size."""
    current = stub_model(1.0)
    test = CandidateTest(instead, stub_model(9.0), stub_model(2.0, likelihood=-loss * thresholds.RIVAL_MARGIN))
    better = stub_model(1.0, likelihood=test.model.likelihood + end)
    monkeypatch.setattr(module, "fit_in_place", lambda *_: better)
    left = start_from_same_size(test, effect, current, cast(HoldOut, None))
    assert left.model is (better if again else test.model)
