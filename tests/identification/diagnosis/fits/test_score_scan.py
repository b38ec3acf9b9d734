"""What one or two effects more promise to gain: as much as a fit, and of sizes that they can be."""

from dataclasses import replace

import numpy as np
import pytest
from one_way import HIDING, fit_levels

from motor_identification.diagnosis.candidate_model import learn_errors
from motor_identification.diagnosis.fits.disturbed_fit import make_disturbed_residuals
from motor_identification.diagnosis.fits.effect_fit import fit_promised
from motor_identification.diagnosis.fits.score_scan import Promise, can_be_scanned, scan_scores
from motor_identification.estimation.estimate import Estimate
from motor_model.effects import EFFECT_BY_NAME

TRIED = ("coulomb_friction", "quadratic_drag", "voltage_limit", "supply_sag", "transport_delay")
PAIR = ("coulomb_friction", "quadratic_drag")


def scan(estimate: Estimate) -> tuple[tuple[Promise, ...], tuple[Promise, ...]]:
    return scan_scores(estimate, learn_errors(estimate), TRIED)


def gain_of_fit(estimate: Estimate, promise: Promise) -> float:
    """What a fit from the promised sizes gains of log likelihood beside the same errors."""
    errors = learn_errors(estimate)
    target, larger = make_disturbed_residuals(estimate, errors), fit_promised(estimate, promise, errors)
    before, after = target.residuals(estimate.theta), replace(target, problem=larger.problem).residuals(larger.theta)
    return 0.5 * float(before @ before - after @ after)


@pytest.mark.parametrize("seed", [1, 2])
def test_two_that_hide_each_other_are_found_together(seed: int) -> None:
    singles, pairs = scan(fit_levels(seed, **HIDING))
    assert singles[0].gain < 6.0 and pairs[0].effects == PAIR and pairs[0].gain > 25.0
    (friction, drag) = pairs[0].sizes
    assert friction["ks"] == pytest.approx(HIDING["ks"], rel=0.25) and drag["drag"] == pytest.approx(7e-5, rel=0.35)


def test_a_promise_is_about_what_a_fit_gains() -> None:
    estimate = fit_levels(1, **HIDING)
    _, (first, *_) = scan(estimate)
    assert gain_of_fit(estimate, first) == pytest.approx(first.gain, rel=0.1)


def test_nothing_is_promised_where_nothing_is_missing() -> None:
    singles, pairs = scan(fit_levels(1))
    assert singles[0].gain < 3.0 and pairs[0].gain < 5.0


def test_only_a_limit_cannot_be_scanned() -> None:
    """A little of it, far above every command, does nothing."""
    assert [effect for effect in EFFECT_BY_NAME if not can_be_scanned(effect)] == ["voltage_limit"]


def test_promises_come_best_first_and_once() -> None:
    for promises in scan(fit_levels(1, **HIDING)):
        gains = [one.gain for one in promises]
        assert gains == sorted(gains, reverse=True) and len({one.effects for one in promises}) == len(promises)


def test_no_friction_drives_a_motor() -> None:
    """What helps the motor is no friction, however much it gains; a load may."""
    estimate = fit_levels(1, bias_voltage=-0.5)
    singles, _ = scan_scores(estimate, learn_errors(estimate), ("coulomb_friction", "load_bias"))
    (only,) = singles
    assert only.effects == ("load_bias",) and only.gain > 15.0
    assert only.sizes[0]["bias_voltage"] == pytest.approx(-0.5, rel=0.25)


def test_what_is_the_same_beside_another_is_no_pair() -> None:
    """In motion one way a load is a friction."""
    estimate = fit_levels(1, ks=0.5)
    singles, pairs = scan_scores(estimate, learn_errors(estimate), ("coulomb_friction", "load_bias"))
    assert len(singles) == 2 and singles[0].gain == pytest.approx(singles[1].gain, rel=1e-3) and not pairs


def test_a_breakaway_is_counted_from_the_friction() -> None:
    estimate = fit_levels(1, ks=0.5)
    rubbing = fit_promised(estimate, scan(estimate)[0][0], learn_errors(estimate))
    assert rubbing.problem.unknowns.effects == ("coulomb_friction",)
    target = make_disturbed_residuals(rubbing, learn_errors(rubbing))
    singles, _ = scan_scores(rubbing, learn_errors(rubbing), ("static_friction",))
    least = float(rubbing.parameters.values["ks"])
    assert all(one.sizes[0]["breakaway_voltage"] > least for one in singles)
    assert np.all(np.isfinite(target.residuals(rubbing.theta)))
