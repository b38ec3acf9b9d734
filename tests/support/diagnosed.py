"""A diagnosis put together from two fits, without and with a hidden effect: what reports are tested on."""

from dataclasses import replace
from functools import cache

import numpy as np
from plant import profiles, record

from motor_identification.diagnosis.result import Alternative, Diagnosis, Finding, Verdict
from motor_identification.discrepancy.region_text import describe_error
from motor_identification.estimation.direction_correction import correct_directions
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.miscounts import find_miscounts
from motor_identification.estimation.parameter_space import map_theta
from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.request import Descent, SearchReport
from motor_identification.estimation.whitened_fit import make_whitened
from motor_identification.noise.likelihood import estimate_noise
from motor_identification.recording import check
from motor_identification.uncertainty.result import Fit
from motor_identification.uncertainty.summary import summarise_fit
from motor_identification.validation.held_out import HeldOut
from motor_identification.validation.hold_out import HoldOut, make_hold_out
from motor_model.effects import EFFECT_BY_NAME
from motor_model.parameters import PAPER_KA, PAPER_KV

BASE = {"kv": PAPER_KV, "ka": PAPER_KA}


@cache
def fitted(**hidden: float) -> tuple[Estimate, HoldOut]:
    """The two-coefficient motor fitted to a plant that hides something, and what is held out."""
    disc = {"disc_seed": 1, "irregularity": 0.003}
    train = check(record(BASE | hidden, *profiles.compact(12.0), seed=1, name="train.bag", **disc)[0])
    other = check(record(BASE | hidden, *profiles.rich(9.0, seed=5), seed=2, name="held_out.bag", **disc)[0])
    hold_out = make_hold_out([train], [other])
    estimate = fit_speeds(Estimate(make_problem([train], ()), np.log([PAPER_KV, PAPER_KA])))
    estimate = correct_directions(estimate)
    estimate = fit_speeds(estimate.on(estimate.problem.without(find_miscounts(estimate))))
    return estimate, hold_out.correct_directions(estimate)


@cache
def held(**hidden: float) -> HeldOut:
    """The two-coefficient motor on held-out motion of that plant."""
    estimate, hold_out = fitted(**hidden)
    return hold_out.validate(estimate)


def held_with_true_gains(**hidden: float) -> HeldOut:
    """Held-out motion of that plant beside the true kv and ka, so that what is hidden is all that is missing."""
    estimate, hold_out = fitted(**hidden)
    return hold_out.validate(replace(estimate, theta=np.log([BASE["kv"], BASE["ka"]])))


def with_effect(estimate: Estimate, effect: str, guess: dict[str, float]) -> Estimate:
    """The fit with one more effect, from a guess of its parameters."""
    more = estimate.problem.with_effects((effect,))
    values = {name: np.array(value) for name, value in guess.items()}
    return fit_speeds(Estimate(more, map_theta(estimate.problem.unknowns, estimate.theta, more.unknowns, values)))


def as_fit(estimate: Estimate) -> Fit:
    descent = Descent(estimate.theta, 1.0, 1, 0)
    search = SearchReport(estimate.theta, 1.0, 1, np.array([1.0]), np.array([1]), (descent,), 1, 1, True)
    return summarise_fit(make_whitened(estimate), search, lambda: 1.0)


@cache
def diagnosis(effect: str, **hidden: float) -> Diagnosis:
    """That effect is found at the first step; drag is what else was tried."""
    estimate, hold_out = fitted(**hidden)
    before = hold_out.validate(estimate)
    more = with_effect(estimate, effect, {name: 0.7 * value for name, value in hidden.items()})
    other = with_effect(estimate, "quadratic_drag", {"drag": 1e-5})
    hold_out = hold_out.correct_directions(more)
    after = hold_out.validate(more)
    noise = estimate_noise(list(zip(more.problem.intervals, more.increments, strict=True)))
    model = as_fit(more)
    names = [spec.name for spec in EFFECT_BY_NAME[effect].parameters]
    finding = Finding(
        effect=effect,
        gap_before=before.gap,
        gap_after=after.gap,
        evidence=after.log_likelihood(noise) - before.log_likelihood(noise),
        where=describe_error(before, noise.share),
        parameters={name: (model.parameters.value(name), model.standard_errors[name]) for name in names},
        alternatives=(Alternative("quadratic_drag", hold_out.validate(other).gap, 12.5),),
        ambiguous_with=(),
        suggested_experiment="",
    )
    return Diagnosis(
        verdict=Verdict.EXPLAINED,
        findings=(finding,),
        baseline=as_fit(estimate),
        model=model,
        gap_before=before.gap,
        gap_after=after.gap,
        noise_floor=after.floor(noise.share),
        sensor_floor=after.floor(noise.share),
        disturbance=None,
        structure=(),
        undetectable=("warm_up",),
        suggested_experiment="",
        before=before,
        after=after,
        slot_share=noise.share,
        bags=("train.bag",),
        validation=("held_out.bag",),
        miscounted=after.miscounted,
        left_out=sum(data.left_out for data in after.intervals),
        trace=np.array([before.gap, after.gap]),
        duration=1.0,
    )
