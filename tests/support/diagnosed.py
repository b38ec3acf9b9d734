"""A diagnosis put together from two fits, without and with a hidden effect: what reports are tested on."""

from functools import cache

import numpy as np
from plant import profiles, record

from motor_identification.diagnosis.result import Alternative, Diagnosis, Finding, Verdict
from motor_identification.discrepancy.region_text import describe_error
from motor_identification.estimation.direction_correction import redirected
from motor_identification.estimation.least_squares import Speeds, descend
from motor_identification.estimation.miscounts import find_miscounted
from motor_identification.estimation.parameter_space import carried
from motor_identification.estimation.problem import Problem, make_problem
from motor_identification.estimation.whitened_fit import Refined, learn
from motor_identification.noise.likelihood import likely_noise
from motor_identification.recording import Floats, check
from motor_identification.uncertainty.result import Fit, SearchReport, judge
from motor_identification.validation.held_out import HeldOut, Kept, keep_out
from motor_model.effects import EFFECT_BY_NAME
from motor_model.parameters import PAPER_KA, PAPER_KV

BASE = {"kv": PAPER_KV, "ka": PAPER_KA}


@cache
def fitted(**hidden: float) -> tuple[Problem, Floats, Kept]:
    """The two-coefficient motor fitted to a plant that hides something, and what is held out."""
    disc = {"disc_seed": 1, "irregularity": 0.003}
    train = check(record(BASE | hidden, *profiles.rich(12.0), seed=1, name="train.bag", **disc)[0])
    other = check(record(BASE | hidden, *profiles.rich(9.0, seed=5), seed=2, name="held_out.bag", **disc)[0])
    problem, kept = make_problem([train], ()), keep_out([train], [other])
    place, _ = descend(problem, Speeds(problem), np.log([PAPER_KV, PAPER_KA]))
    problem = redirected(problem, place)
    problem = problem.without(find_miscounted(problem, place))
    place, _ = descend(problem, Speeds(problem), place)
    return problem, place, kept.redirected(problem, place)


@cache
def held(**hidden: float) -> HeldOut:
    """The two-coefficient motor on held-out motion of that plant."""
    problem, place, kept = fitted(**hidden)
    return kept.judged(problem, place)


def joined(problem: Problem, place: Floats, effect: str, guess: dict[str, float]) -> tuple[Problem, Floats]:
    """The fit with one more effect, from a guess of its parameters."""
    more = problem.with_effects((effect,))
    start = carried(problem.unknowns, place, more.unknowns, {name: np.array(value) for name, value in guess.items()})
    return more, descend(more, Speeds(more), start)[0]


def as_fit(problem: Problem, place: Floats) -> Fit:
    refined = Refined(problem, learn(problem, place))
    return judge(refined, place, SearchReport(np.array([1.0]), 1, 1, 1, True), 1)


@cache
def diagnosis(effect: str, **hidden: float) -> Diagnosis:
    """That effect is found at the first step; drag is what else was tried."""
    problem, place, kept = fitted(**hidden)
    before = kept.judged(problem, place)
    more, there = joined(problem, place, effect, {name: 0.7 * value for name, value in hidden.items()})
    other, elsewhere = joined(problem, place, "quadratic_drag", {"drag": 1e-5})
    kept = kept.redirected(more, there)
    after = kept.judged(more, there)
    noise = likely_noise(list(zip(more.intervals, more.increments(there), strict=True)))
    model = as_fit(more, there)
    names = [spec.name for spec in EFFECT_BY_NAME[effect].parameters]
    finding = Finding(
        effect=effect,
        gap_before=before.gap,
        gap_after=after.gap,
        evidence=after.log_likelihood(noise) - before.log_likelihood(noise),
        where=describe_error(before, noise.share),
        parameters={name: (model.parameters.value(name), model.standard_errors[name]) for name in names},
        alternatives=(Alternative("quadratic_drag", kept.judged(other, elsewhere).gap, 12.5),),
        ambiguous_with=(),
        suggested_experiment="",
    )
    return Diagnosis(
        verdict=Verdict.EXPLAINED,
        findings=(finding,),
        baseline=as_fit(problem, place),
        model=model,
        gap_before=before.gap,
        gap_after=after.gap,
        noise_floor=after.floor(noise.share),
        undetectable=("warm_up",),
        suggested_experiment="",
        before=before,
        after=after,
        slot_share=noise.share,
        bags=("train.bag",),
        validation=("held_out.bag",),
        miscounted=after.miscounted,
        left_out=sum(data.left_out for data in after.problem.intervals),
        trace=np.array([before.gap, after.gap]),
        duration=1.0,
    )
