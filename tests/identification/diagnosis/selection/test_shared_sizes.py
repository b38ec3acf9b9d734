"""Half of what a friction alone explains may be a dead zone's: then the two are told with an "or"."""

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from plant import profiles, record
from stub_models import same_errors, stub_model, stub_test
from stub_selections import step_of

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import likelihood_threshold
from motor_identification.diagnosis.effect_test import try_effects
from motor_identification.diagnosis.selection.selection import Selection, SelectionStep, begin_selection
from motor_identification.diagnosis.selection.shared_sizes import doubt_shared_sizes, list_sharing, may_have_half
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.problem import make_problem
from motor_identification.recording import check
from motor_identification.validation.hold_out import make_hold_out
from motor_model.parameters import PAPER_KA, PAPER_KV

BELOW, ABOVE = 0.999, 1.001


@pytest.mark.parametrize(
    ("found", "other", "share", "evidence", "listed"),
    [
        ("coulomb_friction", "dead_zone", ABOVE, 100.0, True),
        ("coulomb_friction", "dead_zone", BELOW, 100.0, False),  # it does not do most of what the friction does
        ("dead_zone", "coulomb_friction", ABOVE, 100.0, True),
        ("coulomb_friction", "load_bias", ABOVE, 100.0, False),  # which holds no motor
        ("coulomb_friction", "static_friction", ABOVE, 100.0, False),  # which comes with the friction
        ("coulomb_friction", "dead_zone", ABOVE, 1.0, False),  # neither is likely
    ],
)
def test_what_does_most_of_what_a_finding_does_may_share_its_size(
    found: str, other: str, share: float, evidence: float, listed: bool
) -> None:
    before, evidence = stub_model(9.0), evidence * likelihood_threshold()
    step = step_of(
        stub_test(found, before, 1.0, evidence),
        stub_test(other, before, 1.1, share * (1.0 - thresholds.HOLDING_LEAD) * evidence),
    )
    assert list_sharing(step, (found,)) == ([other] if listed else [])
    assert list_sharing(step, ()) == []  # the finding has gone
    assert list_sharing(step, (found, other)) == []
    rival = SelectionStep(step.before, step.found, step.tests, (other,), 0.5)
    assert list_sharing(rival, (found,)) == []


def half(friction: float, dead_zone: float, error: float, beside_torque: float | None = None) -> bool:
    names = ("kv", "ka", "ks", "dead_zone_voltage")
    unknowns = SimpleNamespace(names=names)
    fit = SimpleNamespace(theta=np.array([1.0, 1.0, friction, dead_zone]), problem=SimpleNamespace(unknowns=unknowns))
    told = None if beside_torque is None else (fit, same_errors(beside_torque))
    model: Any = SimpleNamespace(whitened=fit, uncertainty=same_errors(error), told_beside_torque=told)
    return may_have_half(cast(Model, model), "coulomb_friction", "dead_zone")


def test_half_is_another_effects_within_its_standard_error() -> None:
    most = (0.5 * 1.2 - 0.3) / thresholds.SURE_SIZE
    assert half(0.9, 0.3, ABOVE * most) and not half(0.9, 0.3, BELOW * most)
    assert half(0.5, 0.7, 1e-3) and not half(1.2, 0.0, 0.1)
    assert half(1.2, 0.0, float("nan"))  # of which nothing is known
    # What knows of the random torque tells: of 0.5 V of friction half was doubted beside 0.15 V.
    assert half(0.9, 0.3, BELOW * most, ABOVE * most) and not half(0.9, 0.3, ABOVE * most, BELOW * most)


def rivals(profile: profiles.Profile, **hidden: float) -> tuple[str, ...]:
    """What a friction, found first, is told with."""
    drive = {"kv": PAPER_KV, "ka": PAPER_KA, **hidden}
    recording = check(record(drive, *profile, seed=2, irregularity=0.003)[0])
    hold_out = make_hold_out([recording], [])
    problem = hold_out.restrict(make_problem([recording], ()))
    start = begin_selection(fit_speeds(Estimate(problem, np.log([PAPER_KV, PAPER_KA]))), hold_out, 1)
    names = ["coulomb_friction", "dead_zone"]
    tests = try_effects(start.model, start.hold_out, names, 1, lambda test: None)
    found = next(test for test in tests if test.effect == "coulomb_friction")
    selection: Selection = start.add([SelectionStep(start.model, found, tuple(tests), (), 1.0)])
    return doubt_shared_sizes(selection).steps[0].rivals


@pytest.mark.parametrize(
    ("hidden", "told"),
    [
        ({"ks": 0.6, "dead_zone_voltage": 0.6}, ("dead_zone",)),
        ({"ks": 0.3}, ()),
    ],
)
def test_a_friction_that_is_half_a_dead_zone_is_not_told_alone(hidden: dict[str, float], told: tuple[str, ...]) -> None:
    """Of 0.6 V each 1.204 ± 0.004 V of friction were named, and no dead zone."""
    assert rivals(profiles.staircase(seconds=0.8), **hidden) == told
