"""Conclude a verdict from a stepwise selection: findings, what is left, the experiment that would tell more."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.detectability import find_undetectable, list_unturned_discs
from motor_identification.diagnosis.effect_test import is_over_too_soon, list_candidates, sort_by_table
from motor_identification.diagnosis.evidence.command_evidence import find_falling, find_ignored, goes_with_sweep
from motor_identification.diagnosis.evidence.line_evidence import list_unseen_disc
from motor_identification.diagnosis.evidence.missed_edges import count_missed_edges
from motor_identification.diagnosis.evidence.standstill_evidence import list_hills
from motor_identification.diagnosis.result import Alternative, Diagnosis, Finding, Nearest, Verdict, list_vague
from motor_identification.diagnosis.selection.selection import Selection, SelectionStep
from motor_identification.discrepancy.free_curves import BY_SPEED, BY_TIME
from motor_identification.discrepancy.region_text import describe_error
from motor_identification.discrepancy.structure import LEAST_SHARE, OVER_THE_DISC
from motor_identification.estimation.request import SearchReport
from motor_identification.recording import Recording
from motor_identification.sensor.pulses.missed_edges import average_shares
from motor_identification.uncertainty.identifiability import suggest_profile
from motor_identification.uncertainty.result import Fit
from motor_identification.uncertainty.summary import summarise_fit
from motor_identification.validation.held_out import HeldOut
from motor_identification.validation.instants import comes_slowly
from motor_model.effects import EFFECT_BY_NAME, LAGS

BY_PAIRS = "edges that follow each other come sooner than the count of those in between says, whatever the motor does"
BY_WHOLE_SLOTS = "{} intervals are short by whole slots, whatever the motor does"


def conclude(
    base: Model,
    selection: Selection,
    recordings: Sequence[Recording],
    validation: Sequence[Recording],
    search: SearchReport,
    elapsed: Callable[[], float],
    undetermined: tuple[str, ...] = (),
    sensor_may_lag: bool = False,
) -> Diagnosis:
    """Conclude a diagnosis; `search` is that of the first fit, `elapsed` [s] since the diagnosis began.

    undetermined: effects one of which may be missing, though the recordings determine nothing of it. sensor_may_lag:
    whether what makes the motion late may be of a sensor that nobody described. Findings with which kv ends at a limit
    of the search are told without a size, beside the model without them.
    """
    last = selection.model
    undetermined = undetermined or list_unjudged_effects(selection)
    undetermined = sort_by_table({*undetermined, *list_unturned_discs(selection)})
    base = base if selection.steps else last  # the same effects: one gap, not one of either fit
    model = summarise_fit(last.whitened, search, elapsed)
    gaps = _list_gaps(selection)
    findings, hidden = _list_findings(selection, model, gaps), find_undetectable(last)
    findings = doubt_lags(findings) if sensor_may_lag else findings
    possible = tuple(
        name for name in hidden if not is_over_too_soon(name, last.held)
    )  # what cannot have come yet is none
    verdict, suggestion = decide(findings, selection, possible, undetermined)
    found = Diagnosis(
        verdict=verdict,
        findings=findings,
        baseline=model if base is last else summarise_fit(base.whitened, search, elapsed),
        model=model,
        gap_before=base.held.gap,
        gap_after=last.held.gap,
        noise_floor=last.noise_floor if last.complete else last.sensor_floor,
        sensor_floor=last.sensor_floor,
        disturbance=last.estimate_disturbance() if last.complete else None,  # else structure is in it
        structure=selection.structure,
        undetectable=leave_out_named(hidden, findings, undetermined),
        suggested_experiment=suggestion,
        before=base.held,
        after=last.held,
        slot_share=last.errors.share,
        bags=tuple(recording.uri for recording in recordings),
        validation=tuple(recording.uri for recording in validation),
        miscounted=last.held.miscounted,
        left_out=sum(data.left_out for data in last.held.intervals),
        trace=np.array([base.held.gap, *gaps]),
        duration=elapsed(),
        undetermined=undetermined,
        gain_scatter=last.errors.gain,
    )
    if found.is_of_no_motor and selection.steps:
        nothing = replace(selection, steps=(), model=base, outside=None)
        named = {name for one in findings for name in (one.effect, *one.ambiguous_with)}
        may_be = sort_by_table({*undetermined, *named})
        return conclude(base, nothing, recordings, validation, search, elapsed, may_be)
    return replace(found, verdict=Verdict.UNDECIDED) if found.is_of_no_motor else found


def list_unjudged_effects(selection: Selection) -> tuple[str, ...]:
    """List the effects that what is left goes with, by time, angle or speed, and that could not be judged.

    Nothing says then that it is outside the table. Under a sweep whatever depends on the frequency goes with the time,
    and times between edges do not count the angle. Measured: a warming-up by 0.24 beside a dead time, of which the time
    predicts 76 %, and an eccentric disc of which the angle does 100. Under voltages of one size the speed does 100 % of
    what a breakaway leaves beside a friction at every reversal. What cannot have come yet is none of them.
    """
    last = selection.model
    certain = [one for one in selection.structure if one.certain]
    if not certain or certain[0].cause:
        return ()
    families: dict[str, Callable[[str], bool]] = {
        BY_TIME: comes_slowly,
        OVER_THE_DISC: _is_periodic,
        BY_SPEED: lambda name: EFFECT_BY_NAME[name].implies in last.effects,
    }
    belongs = families.get(certain[0].variable)
    if belongs is None:
        return ()
    known = {*last.effects, *list_candidates(last.effects, last.held, last.beside_torque)}
    names = [name for name in EFFECT_BY_NAME if belongs(name) and name not in known]
    return tuple(name for name in names if not is_over_too_soon(name, last.held))


def _is_periodic(effect: str) -> bool:
    return EFFECT_BY_NAME[effect].periodic


def doubt_lags(findings: Sequence[Finding]) -> tuple[Finding, ...]:
    """Doubt of findings those that make a motion late: speeds that were smoothed or late before the log do so, too."""
    return tuple(replace(one, sensor_may_lag=one.effect in LAGS) for one in findings)


def leave_out_named(hidden: Sequence[str], findings: Sequence[Finding], undetermined: Sequence[str]) -> tuple[str, ...]:
    """Leave out of the effects that could not be shown those that may be there: a rival, or one without a size."""
    named = {*undetermined, *(rival for one in findings for rival in one.ambiguous_with)}
    return tuple(effect for effect in hidden if effect not in named)


def _list_gaps(selection: Selection) -> list[float]:
    """List the gap [rad/s] after each step, once everything was fitted again."""
    after = [step.before for step in selection.steps[1:]] + [selection.model]
    return [model.held.gap for _, model in zip(selection.steps, after, strict=False)]


def _list_findings(selection: Selection, model: Fit, gaps: Sequence[float]) -> tuple[Finding, ...]:
    """List what was found in the order of the steps, then missed edges."""
    findings = [
        _make_finding(step, model, gap, _list_unseen(selection.model, step.found.effect))
        for step, gap in zip(selection.steps, gaps, strict=True)
    ]
    missed = find_missed_edges(selection.model)
    return (*findings, *([] if missed is None else [missed]))


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


def find_nearest(kept: Selection, base: float) -> Nearest | None:
    """Find the first few effects of a selection that take away most of what all of it does, if that is much.

    kept: what left the smallest gap on the way, though it explained not enough to be named. base: [rad/s] the gap
    without any of it. Of motion that the fits have seen it has to be more.
    """
    gaps = _list_gaps(kept)
    if not gaps or gaps[-1] > (thresholds.HALVED_GAP if kept.model.held.seen else thresholds.NEAREST_GAP) * base:
        return None
    enough = base**2 - thresholds.MOST_OF_NEAREST * (base**2 - gaps[-1] ** 2)
    count = next(number for number, gap in enumerate(gaps, 1) if gap**2 <= enough)
    return Nearest(tuple(step.found.effect for step in kept.steps[:count]), gaps[count - 1])


def decide(
    findings: Sequence[Finding], selection: Selection, hidden: tuple[str, ...], undetermined: tuple[str, ...] = ()
) -> tuple[Verdict, str]:
    """Decide how it ended, and the profile to record next."""
    complete, last = selection.complete, selection.model
    if undetermined and not (findings and complete):  # beside what explains everything it is only told
        return Verdict.UNDECIDED, EFFECT_BY_NAME[undetermined[0]].shown_by
    unclear = next((finding.suggested_experiment for finding in findings if finding.ambiguous_with), "")
    if not complete and last.held.confirms:
        # What leaves less than its own sensor does, as it was learned, is no motor that lacks something.
        below = selection.outside is None and last.held.gap <= thresholds.EXPLAINED_GAP * last.sensor_floor
        # Nor is what nothing predicts, though no random torque makes it: noise of a sensor does. Nor, in motion that
        # the fit has seen, a small share of it: measured, 4 % by the angle of a real robot whose rows come late.
        least = LEAST_SHARE if last.held.seen else 0.0
        open_ = below or not any(one.certain and one.share > least for one in selection.structure)
        open_ = open_ or goes_with_sweep(selection.structure, last.held)  # which all that goes with frequency does
        verdict = Verdict.UNDECIDED if open_ else Verdict.UNEXPLAINED
        return verdict, unclear or ("rich" if hidden or below else "")
    if unclear or any(finding.sensor_may_lag for finding in findings):  # of a sensor no experiment tells more
        return Verdict.UNDECIDED, unclear
    if not findings and complete and find_ignored(last.held) is not None:
        return Verdict.UNDECIDED, ""  # no experiment tells more before its columns belong together
    if complete and findings and last.above_floor and last.held.gap > thresholds.MOMENTS_GAP * last.noise_floor:
        return Verdict.UNDECIDED, ""  # few moments leave it, of which no torque tells
    if complete and (last.is_tossed or find_falling(last.held) is not None):
        return Verdict.UNDECIDED, ""
    if vague := list_vague(findings):
        return Verdict.UNDECIDED, EFFECT_BY_NAME[vague[0].effect].shown_by
    if hidden and not findings:
        return Verdict.UNDECIDED, EFFECT_BY_NAME[hidden[0]].shown_by  # the table begins with what is most common
    if not last.held.confirms and (findings or not complete):
        return Verdict.UNDECIDED, EFFECT_BY_NAME[findings[0].effect].shown_by if findings else "rich"
    return (Verdict.EXPLAINED if findings else Verdict.NOTHING_MISSING), ""
