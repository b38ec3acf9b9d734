"""Diagnosis: find which effects are missing from a motor's model, one after the other, until nothing is missing.

Each step tries every effect of the table on top of the model, with all parameters fitted again (a wrong parameter eats
missing physics), and takes the one under which held-out motion is most likely (`evidence.py`), if it is likely enough
not to be a false alarm and explains enough of the gap. Afterwards every finding has to hold its own beside the others.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np

from motor_identification.descent import Speeds, descend
from motor_identification.detectable import undetectable
from motor_identification.diagnosis import Alternative, Diagnosis, Finding, Verdict
from motor_identification.direction import redirected
from motor_identification.discrepancy import where
from motor_identification.fit import Fit, SearchReport, judge
from motor_identification.held_out import Kept, keep_out, spared
from motor_identification.identify import Request, searched
from motor_identification.missed import find_miscounted
from motor_identification.periodic import add_periodic, without_periodic
from motor_identification.problem import Problem, make_problem
from motor_identification.recording import Floats, Recording
from motor_identification.refine import Refined, learn
from motor_identification.refusals import refuse_nonsense
from motor_identification.selection import (
    AT_FLOOR,
    MARGIN,
    STANDS_IN,
    Model,
    Trial,
    accepted,
    judged,
    lacking,
    rivals,
    threshold,
    tried,
)
from motor_identification.unknowns import carried
from motor_model.effects import EFFECT_BY_NAME, normalised
from motor_model.errors import MotorError, RecordingError

MOST = 6  # findings
RIVALS = 2  # that are tried in a finding's place
NEARLY = 0.75  # of the evidence of the first finding: another way to begin
MISSED = 5  # miscounted intervals from which on edges are missing


class Stopped(MotorError):
    """The diagnosis was told to stop."""


@dataclass(frozen=True)
class Stage:
    """How far a diagnosis is."""

    text: str
    share: float  # done, 0 to 1
    best_effect: str
    gap: float  # [rad/s] of the best model so far


@dataclass(frozen=True)
class _Step:
    """A finding in the making."""

    before: Model
    found: Trial
    trials: tuple[Trial, ...]
    lost: tuple[str, ...] = ()  # effects that were taken instead, and whose way ended further from the floor


def diagnose(
    recordings: Sequence[Recording],
    validation: Sequence[Recording] = (),
    known: tuple[str, ...] = (),
    workers: int = 1,
    progress: Callable[[Stage], None] | None = None,
    stopped: Callable[[], bool] | None = None,
) -> Diagnosis:
    """Diagnose checked recordings of one motor; without `validation` a quarter of them is kept out of every fit.

    Raises:
        ModelError: a known effect is not in the table, or no fit of these recordings can have it.
        RecordingError: a recording cannot answer.
        Stopped: `stopped` said so.
    """
    begun = perf_counter()
    if not recordings:
        raise RecordingError("there is no recording to diagnose: name at least one bag.")
    refuse_nonsense(recordings, known)
    tell = _Telling(progress or (lambda stage: None), stopped or (lambda: False))
    tell("first fit", 0.0, "", float("nan"))
    kept = keep_out(recordings, validation)
    base, kept = _first(recordings, normalised(known), kept, workers)
    steps, current, kept = _climbed(base, kept, [], workers, tell)
    steps, current, kept = _by_another_way(steps, current, kept, workers, tell)
    tell("checking", 0.9, "", current.held.gap)
    steps, current = _needed(*_without_stand_ins(steps, current), kept)
    return _told(base, steps, current, recordings, validation, perf_counter() - begun)


@dataclass
class _Telling:
    """Progress out, stop in."""

    progress: Callable[[Stage], None]
    stopped: Callable[[], bool]

    def __call__(self, text: str, share: float, best_effect: str, gap: float) -> None:
        if self.stopped():
            raise Stopped("the diagnosis was stopped.")
        self.progress(Stage(text, share, best_effect, gap))


def _first(recordings: Sequence[Recording], known: tuple[str, ...], kept: Kept, workers: int) -> tuple[Model, Kept]:
    """The model to begin with, searched globally."""
    whole = make_problem(recordings, without_periodic(known), workers)
    if kept.same:
        whole = whole.sparing(spared)
    _found, place, _evaluations = searched(whole, Request(known, workers=workers), lambda share: None)
    problem, place, _evaluations = add_periodic(replace(whole, workers=1), place, known)
    return _settled(problem, place, kept)


def _settled(problem: Problem, place: Floats, kept: Kept) -> tuple[Model, Kept]:
    """Directions judged by this model, miscounted intervals left out, and fitted again."""
    problem = redirected(problem, place)
    problem = problem.without(find_miscounted(problem, place))
    place, _evaluations = descend(problem, Speeds(problem), place)
    kept = kept.redirected(problem, place)
    return judged(kept, problem, place), kept


def _climbed(
    current: Model, kept: Kept, steps: list[_Step], workers: int, tell: _Telling
) -> tuple[list[_Step], Model, Kept]:
    """Effects added to those of earlier steps as long as one is found: all steps, the last model, its judge."""
    steps = list(steps)
    while True:
        done = 0.1 + 0.8 * (1.0 - 0.5 ** len(steps))
        left = lacking(current.effects)
        count = 0

        def heard(trial: Trial, model: Model = current, done: float = done, many: int = len(left)) -> None:
            nonlocal count
            count += 1
            share = done + 0.8 * 0.5 ** (len(steps) + 1) * count / many
            tell(
                f"step {len(steps) + 1}: {trial.effect}", share, trial.effect, min(trial.model.held.gap, model.held.gap)
            )

        cheap = [effect for effect in left if not EFFECT_BY_NAME[effect].periodic]
        trials = tried(current, kept, cheap, workers, heard)
        best = accepted(trials)
        if best is None or best.model.held.gap > AT_FLOOR * best.model.floor:
            periodic = [effect for effect in left if EFFECT_BY_NAME[effect].periodic]
            trials += tried(current, kept, periodic, workers, heard, max(trials[0].evidence, 0.0))
            trials.sort(key=lambda trial: -trial.evidence)
            best = accepted(trials)
        if best is None or len(steps) == MOST:
            return steps, current, kept
        steps.append(_Step(current, best, tuple(trials)))
        current, kept = _settled(best.model.problem, best.model.place, kept)


def _by_another_way(
    steps: list[_Step], current: Model, kept: Kept, workers: int, tell: _Telling
) -> tuple[list[_Step], Model, Kept]:
    """Where the gap stays above the floor, what was nearly taken first is taken instead, and all that follows from it.

    While others are missing too, one effect can do as well as another, and the wrong one blocks the way.
    """
    if not steps or current.held.gap <= AT_FLOOR * current.floor:
        return steps, current, kept
    first = steps[0]
    near = [
        trial for trial in first.trials if trial is not first.found and trial.evidence > NEARLY * first.found.evidence
    ]
    for trial in near[:RIVALS]:
        if trial.evidence > threshold():
            begun, judge = _settled(trial.model.problem, trial.model.place, kept)
            other = _climbed(begun, judge, [_Step(first.before, trial, first.trials)], workers, tell)
            if other[1].held.gap < current.held.gap:
                steps, current, kept = other
    return steps, current, kept


def _without_stand_ins(steps: list[_Step], current: Model) -> tuple[list[_Step], Model]:
    """Where the gap stays above the floor, nothing is named that may only stand in for what is not in the table.

    That is every finding that leaves a visible part of what it should explain, and what was found after it; a line in
    the spectrum over the angle is its own evidence.
    """
    if current.held.gap <= AT_FLOOR * current.floor:
        return steps, current
    for i, step in enumerate(steps):
        if step.found.explains < STANDS_IN and not EFFECT_BY_NAME[step.found.effect].periodic:
            return steps[:i], step.before
    return steps, current


def _needed(steps: list[_Step], current: Model, kept: Kept) -> tuple[list[_Step], Model]:
    """The steps that hold their own beside later ones, or what does better in their place; the model with them."""
    steps = list(steps)
    for step in steps[:-1]:
        effect = step.found.effect
        left = tuple(name for name in current.effects if name != effect and EFFECT_BY_NAME[name].implies != effect)
        smaller = current.problem.with_effects(left)
        start = carried(current.problem.unknowns, current.place, smaller.unknowns, {})
        place, _evaluations = descend(smaller, Speeds(smaller), start)
        without = judged(kept, smaller, place)
        others = [trial.effect for trial in step.trials if trial is not step.found and trial.evidence > threshold()]
        lacking_now = [name for name in others if name in lacking(left)][:RIVALS]
        choices: list[tuple[Trial | None, Model, float]] = [(None, without, threshold())]
        for other in tried(without, kept, lacking_now, 1, lambda trial: None):
            simpler = len(EFFECT_BY_NAME[other.effect].parameters) < len(EFFECT_BY_NAME[effect].parameters)
            choices.append((other, other.model, MARGIN if simpler else -MARGIN))
        lost = tuple(name for name in (effect, *lacking_now))
        at = next(i for i, one in enumerate(steps) if one.found.effect == effect)
        steps[at] = step = replace(steps[at], lost=(*steps[at].lost, *lost))  # unless one of them wins now
        for trial, model, grace in choices:
            if model.likelihood > current.likelihood - grace:
                steps = [one for one in steps if one.found.effect in model.effects or one is step]
                at = steps.index(step)
                steps[at : at + 1] = [] if trial is None else [replace(step, found=trial)]
                current = model
                break
    return steps, current


def _told(
    base: Model,
    steps: Sequence[_Step],
    last: Model,
    recordings: Sequence[Recording],
    validation: Sequence[Recording],
    duration: float,
) -> Diagnosis:
    """Everything as a result."""
    model, baseline = _as_fit(last), _as_fit(base)
    findings = tuple(_finding(step, model) for step in steps)
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
        trace=np.array([before.gap, *(step.found.model.held.gap for step in steps)]),
        duration=duration,
    )


def _as_fit(model: Model) -> Fit:
    """A model with standard errors and everything else that an identification says."""
    refined = Refined(model.problem, learn(model.problem, model.place))
    place, evaluations = descend(model.problem, refined, model.place)
    return judge(refined, place, SearchReport(np.array([model.held.gap]), 1, 1, 1, True), evaluations)


def _finding(step: _Step, model: Fit) -> Finding:
    effect = step.found.effect
    also = tuple(name for name in rivals(step.found, step.trials) if name not in step.lost)
    profiles = [EFFECT_BY_NAME[name].shown_by for name in (effect, *also)]
    return Finding(
        effect=effect,
        gap_before=step.before.held.gap,
        gap_after=step.found.model.held.gap,
        evidence=step.found.evidence,
        where=where(step.before.held, step.found.model.noise.share),
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
        suggested_experiment=max(set(profiles), key=profiles.count) if also else "",
    )


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
    if short < MISSED or held.miscounted < MISSED or held.gap > AT_FLOOR * model.floor:
        return None
    rate = short / (total + short)
    everything = replace(held, scored=tuple(np.ones_like(part) for part in held.scored))
    return Finding(
        effect="missed_edges",
        gap_before=everything.gap,
        gap_after=held.gap,
        evidence=short,
        where=f"in {held.miscounted} intervals, short by whole slots, whatever the motor does",
        parameters={"miss_rate": (rate, float(np.sqrt(short)) / (total + short))},
        alternatives=(),
        ambiguous_with=(),
        suggested_experiment="",
    )


def _verdict(findings: Sequence[Finding], last: Model, hidden: tuple[str, ...]) -> tuple[Verdict, str]:
    """How it ended, and the profile to record next."""
    if any(finding.ambiguous_with for finding in findings):
        return Verdict.UNDECIDED, next(finding.suggested_experiment for finding in findings if finding.ambiguous_with)
    if last.held.gap > AT_FLOOR * last.floor:
        return Verdict.UNEXPLAINED, "rich" if hidden else ""
    if hidden:
        return Verdict.UNDECIDED, EFFECT_BY_NAME[hidden[0]].shown_by  # the table begins with what is most common
    return (Verdict.EXPLAINED if findings else Verdict.NOTHING_MISSING), ""
