"""Make findings of the steps of a selection: what each took away, how large it is, what else it may be, and where."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.effect_test import sort_by_table
from motor_identification.diagnosis.evidence.line_evidence import list_unseen_disc
from motor_identification.diagnosis.evidence.missed_edges import count_missed_edges
from motor_identification.diagnosis.evidence.standstill_evidence import list_hills
from motor_identification.diagnosis.result import Alternative, Finding, Nearest
from motor_identification.diagnosis.selection.selection import Selection, SelectionStep
from motor_identification.discrepancy.region_text import describe_error
from motor_identification.sensor.pulses.missed_edges import average_shares
from motor_identification.uncertainty.identifiability import suggest_profile
from motor_identification.uncertainty.result import Fit
from motor_identification.validation.held_out import HeldOut
from motor_model.effects import EFFECT_BY_NAME, LAGS

BY_PAIRS = "edges that follow each other come sooner than the count of those in between says, whatever the motor does"
BY_WHOLE_SLOTS = "{} intervals are short by whole slots, whatever the motor does"


def list_findings(selection: Selection, model: Fit, gaps: Sequence[float]) -> tuple[Finding, ...]:
    """List what was found in the order of the steps, then missed edges."""
    findings = [
        _make_finding(step, model, gap, _list_unseen(selection.model, step.found.effect))
        for step, gap in zip(selection.steps, gaps, strict=True)
    ]
    missed = find_missed_edges(selection.model)
    return (*findings, *([] if missed is None else [missed]))


def list_gaps(selection: Selection) -> list[float]:
    """List the gap [rad/s] after each step, once everything was fitted again."""
    after = [step.before for step in selection.steps[1:]] + [selection.model]
    return [model.held.gap for _, model in zip(selection.steps, after, strict=False)]


def _list_unseen(model: Model, effect: str) -> tuple[str, ...]:
    """List what a recording could not have told from an effect, whatever the likelihoods."""
    return (*list_unseen_disc(model, effect), *list_hills(model, effect))


def _make_finding(step: SelectionStep, model: Fit, gap_after: float, unseen: Sequence[str] = ()) -> Finding:
    effect, also = step.found.effect, sort_by_table({*step.rivals, *unseen})
    return Finding(
        effect=effect,
        gap_before=step.before.held.gap,
        gap_after=gap_after,
        evidence=step.found.evidence,
        where=_locate(step),
        parameters={
            spec.name: (model.parameters.value(spec.name), model.standard_errors.get(spec.name, float("nan")))
            for spec in EFFECT_BY_NAME[effect].parameters
        },
        alternatives=tuple(
            Alternative(trial.effect, trial.model.held.gap, trial.evidence)
            for trial in step.tests
            if trial is not step.found
        ),
        ambiguous_with=also,
        suggested_experiment=suggest_profile(also),
        beside_torque=step.before.beside_torque,
        given_up=tuple(name for name in step.before.effects if name not in model.parameters.effects),
    )


def _locate(step: SelectionStep) -> str:
    """Describe where the model without a finding was wrong, on stretches long enough to see it."""
    before, after = step.before.held, step.found.model
    at_floor = before.gap <= thresholds.EXPLAINED_GAP * after.floor
    return describe_error(step.before.lasting if at_floor else before, after.noise.share)


def find_missed_edges(model: Model) -> Finding | None:
    """Find missed edges: by the edges themselves, or by as many as no wrong stamps make, of a complete model."""
    held, missed = model.held, count_missed_edges(model)
    share = average_shares([data.missed for data in held.intervals])
    if share is not None:
        return _make_missed_edges(held, 0.5 * (share.share / share.error) ** 2, share.share, share.error, BY_PAIRS)
    if missed is None or not missed.certain or held.miscounted < thresholds.LEAST_MISSED_EDGES or not model.complete:
        return None
    where = BY_WHOLE_SLOTS.format(held.miscounted)
    return _make_missed_edges(held, missed.short, missed.rate, missed.rate_error, where)


def _make_missed_edges(held: HeldOut, evidence: float, rate: float, error: float, where: str) -> Finding:
    everything = replace(held, scored=tuple(np.ones_like(part) for part in held.scored))
    return Finding(
        effect="missed_edges",
        gap_before=everything.gap,
        gap_after=held.gap,
        evidence=evidence,
        where=where,
        parameters={"miss_rate": (rate, error)},
        alternatives=(),
        ambiguous_with=(),
        suggested_experiment="",
    )


def doubt_lags(findings: Sequence[Finding]) -> tuple[Finding, ...]:
    """Doubt of findings those that make a motion late: speeds that were smoothed or late before the log do so, too."""
    return tuple(replace(one, sensor_may_lag=one.effect in LAGS) for one in findings)


def leave_out_named(hidden: Sequence[str], findings: Sequence[Finding], undetermined: Sequence[str]) -> tuple[str, ...]:
    """Leave out of the effects that could not be shown those that may be there: a rival, or one without a size."""
    named = {*undetermined, *(rival for one in findings for rival in one.ambiguous_with)}
    return tuple(effect for effect in hidden if effect not in named)


def find_nearest(kept: Selection, base: float) -> Nearest | None:
    """Find the first few effects of a selection that take away most of what all of it does, if that is much.

    kept: what left the smallest gap on the way, though it explained not enough to be named. base: [rad/s] the gap
    without any of it. Of motion that the fits have seen it has to be more.
    """
    gaps = list_gaps(kept)
    if not gaps or gaps[-1] > (thresholds.HALVED_GAP if kept.model.held.seen else thresholds.NEAREST_GAP) * base:
        return None
    enough = base**2 - thresholds.MOST_OF_NEAREST * (base**2 - gaps[-1] ** 2)
    count = next(number for number, gap in enumerate(gaps, 1) if gap**2 <= enough)
    return Nearest(tuple(step.found.effect for step in kept.steps[:count]), gaps[count - 1])
