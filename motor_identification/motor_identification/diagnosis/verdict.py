"""What a diagnosis concludes from the way it took: findings, verdict, the experiment that would tell more."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from motor_identification.diagnosis.candidate_model import AT_FLOOR, LASTING, Model
from motor_identification.diagnosis.detectability import undetectable
from motor_identification.diagnosis.forward_selection import Step, Way
from motor_identification.diagnosis.result import Alternative, Diagnosis, Finding, Verdict
from motor_identification.discrepancy.region_text import describe_error
from motor_identification.estimation.whitened_fit import refine
from motor_identification.recording import Recording
from motor_identification.uncertainty.identifiability import telling_apart
from motor_identification.uncertainty.result import Fit, SearchReport, judge
from motor_model.effects import EFFECT_BY_NAME

MISSED = 5  # miscounted intervals from which on edges are missing


def concluded(
    base: Model, way: Way, recordings: Sequence[Recording], validation: Sequence[Recording], search: SearchReport
) -> Diagnosis:
    """Everything as a result, but for how long it took; `search` is that of the first fit."""
    last = way.model
    model, baseline = _as_fit(last, search), _as_fit(base, search)
    gaps = [step.before.held.gap for step in way.steps[1:]] + [last.held.gap]  # after each step, settled
    findings = tuple(_finding(step, model, gap) for step, gap in zip(way.steps, gaps, strict=False))
    share, missed = last.noise.share, _missed(last)
    before = base.held
    if missed is not None:
        findings = (*findings, missed)
    hidden = undetectable(last)
    verdict, suggestion = _verdict(findings, last, hidden)
    return Diagnosis(
        verdict=verdict,
        findings=findings,
        baseline=baseline,
        model=model,
        gap_before=before.gap,
        gap_after=last.held.gap,
        noise_floor=last.held.floor(share),
        undetectable=hidden,
        suggested_experiment=suggestion,
        before=before,
        after=last.held,
        slot_share=share,
        bags=tuple(recording.uri for recording in recordings),
        validation=tuple(recording.uri for recording in validation),
        miscounted=last.held.miscounted,
        left_out=sum(data.left_out for data in last.held.problem.intervals),
        trace=np.array([before.gap, *gaps[: len(way.steps)]]),
        duration=0.0,
    )


def _as_fit(model: Model, search: SearchReport) -> Fit:
    """A model with standard errors and everything else that an identification says."""
    refined, place, evaluations = refine(model.problem, model.place)
    return judge(refined, place, search, evaluations)


def _finding(step: Step, model: Fit, gap_after: float) -> Finding:
    effect, also = step.found.effect, step.rivals
    return Finding(
        effect=effect,
        gap_before=step.before.held.gap,
        gap_after=gap_after,
        evidence=step.found.evidence,
        where=_where(step),
        parameters={
            spec.name: (model.parameters.value(spec.name), model.standard_errors.get(spec.name, float("nan")))
            for spec in EFFECT_BY_NAME[effect].parameters
        },
        alternatives=tuple(
            Alternative(trial.effect, trial.model.held.gap, trial.evidence)
            for trial in step.trials
            if trial is not step.found
        ),
        ambiguous_with=also,
        suggested_experiment=telling_apart(also),
    )


def _where(step: Step) -> str:
    """Where the model without a finding was wrong, on stretches long enough to see it."""
    before, after = step.before.held, step.found.model
    at_floor = before.gap <= AT_FLOOR * after.floor
    return describe_error(before.joined(LASTING) if at_floor else before, after.noise.share)


def _missed(model: Model) -> Finding | None:
    """Missed edges as a finding: intervals that a complete model sees short by whole slots."""
    held = model.held
    short = total = 0.0
    for data, increments in zip(held.problem.intervals, held.problem.increments(held.place), strict=True):
        if data.slot == 0.0:
            return None
        counted = (data.slack == 0.0) & (data.edge[:, 0] >= 0)
        slots = np.round(np.abs(increments) / data.slot) * np.sign(increments * data.speed)
        short += float(np.sum(slots[counted & (slots > 0.0)]))
        total += float(np.sum(np.abs(data.edge[counted, 1] - data.edge[counted, 0])))
    if short < MISSED or held.miscounted < MISSED or model.above_floor:
        return None
    rate = short / (total + short)
    everything = replace(held, scored=tuple(np.ones_like(part) for part in held.scored))
    return Finding(
        effect="missed_edges",
        gap_before=everything.gap,
        gap_after=held.gap,
        evidence=short,
        where=f"{held.miscounted} intervals are short by whole slots, whatever the motor does",
        parameters={"miss_rate": (rate, float(np.sqrt(short)) / (total + short))},
        alternatives=(),
        ambiguous_with=(),
        suggested_experiment="",
    )


def _verdict(findings: Sequence[Finding], last: Model, hidden: tuple[str, ...]) -> tuple[Verdict, str]:
    """How it ended, and the profile to record next."""
    unclear = next((finding.suggested_experiment for finding in findings if finding.ambiguous_with), "")
    if last.above_floor:
        return Verdict.UNEXPLAINED, unclear or ("rich" if hidden else "")
    if unclear:
        return Verdict.UNDECIDED, unclear
    if hidden:
        return Verdict.UNDECIDED, EFFECT_BY_NAME[hidden[0]].shown_by  # the table begins with what is most common
    return (Verdict.EXPLAINED if findings else Verdict.NOTHING_MISSING), ""
