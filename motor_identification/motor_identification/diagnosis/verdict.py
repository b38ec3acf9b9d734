"""Conclude a verdict from a stepwise selection: findings, what is left, the experiment that would tell more."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.detectability import find_imitated, find_undetectable, list_unturned_discs
from motor_identification.diagnosis.effect_test import is_over_too_soon, list_candidates, sort_by_table
from motor_identification.diagnosis.evidence.command_evidence import find_falling, find_ignored, goes_with_sweep
from motor_identification.diagnosis.findings import doubt_lags, leave_out_named, list_findings, list_gaps
from motor_identification.diagnosis.result import Diagnosis, Finding, Verdict, list_vague
from motor_identification.diagnosis.selection.selection import Selection
from motor_identification.discrepancy.free_curves import BY_SPEED, BY_TIME
from motor_identification.discrepancy.structure import LEAST_SHARE, OVER_THE_DISC
from motor_identification.estimation.request import SearchReport
from motor_identification.recording import Recording
from motor_identification.uncertainty.summary import summarise_fit
from motor_identification.validation.instants import comes_slowly
from motor_model.effects import EFFECT_BY_NAME


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
    gaps = list_gaps(selection)
    findings, hidden = list_findings(selection, model, gaps), find_undetectable(last)
    findings = doubt_lags(findings) if sensor_may_lag else findings
    possible = tuple(
        name for name in hidden if not is_over_too_soon(name, last.held)
    )  # what cannot have come yet is none
    undetectable = leave_out_named(hidden, findings, undetermined)
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
        undetectable=undetectable,
        imitated=find_imitated(last, undetectable),
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
