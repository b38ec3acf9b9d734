"""Try other effects in the place of one that was found: what does better replaces it, what does as well is a rival."""

from collections.abc import Sequence
from dataclasses import replace

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_fit import refit_without
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import CandidateTest, likelihood_threshold, predicts_far_worse
from motor_identification.diagnosis.effect_test import (
    comes_back,
    count_parameters,
    is_there_from_the_start,
    list_candidates,
    sort_by_table,
    try_effects,
)
from motor_identification.diagnosis.evidence.likeness import (
    are_alike,
    both_hold,
    does_nearly_as_well,
    find_rivals,
    holds_nearly_as_well,
)
from motor_identification.diagnosis.evidence.line_evidence import drop_chance_harmonics
from motor_identification.diagnosis.evidence.replacement import choose_better, find_loss
from motor_identification.diagnosis.selection.rival_fits import (
    catch_up,
    settle,
    start_from_same_size,
    start_where_found,
)
from motor_identification.diagnosis.selection.selection import Selection, SelectionStep, begin_beside_torque
from motor_identification.diagnosis.selection.stand_ins import has_same_evidence, is_own_evidence
from motor_identification.progress import ProgressReporter
from motor_model.effects import EFFECT_BY_NAME, LAGS


def try_in_place(
    selection: Selection, step: SelectionStep, without: Model, current: Model, reporter: ProgressReporter
) -> Selection:
    """Try others in the place of a finding: what is better replaces it, and what does as well is a rival.

    What does not come back over the angle is no finding, and takes no other's place. Measured: a disc that turned by
    0.56 took that of a load, and half of a diagnosis of 106 s was spent on what goes with it.
    """
    effect = step.found.effect
    others = list_replacements(step, without.effects, current.effects)
    if not others:
        return selection.replace_step(step, replace(step, rivals=()), current)

    def heard(test: CandidateTest) -> None:
        reporter.report(f"{test.effect} in place of {effect}", 0.9, effect, current.held.gap)

    tried = try_effects(without, selection.hold_out, others, selection.workers, heard)
    tried = [test for test in drop_chance_harmonics(tried) if not is_there_from_the_start(test)]
    tried = [start_where_found(test, step, current, selection.hold_out) for test in tried]
    tried = [start_from_same_size(test, effect, current, selection.hold_out) for test in tried]
    settled = [settle(test, current, selection.hold_out) for test in tried]
    tests = sorted(settled, key=lambda test: test.evidence, reverse=True)
    current = catch_up(current, tests, selection.hold_out)
    told = [test for test in _drop_without_own_evidence(tests, effect, without, current) if comes_back(test)]
    better = choose_better(told, effect, current)
    if better is None:
        return selection.replace_step(step, replace(step, rivals=_list_rivals(tests, effect, current)), current)
    bare = refit_without(better.model, better.effect, selection.hold_out)
    if _needs_neither(better, bare):
        return selection.replace_step(step, None, bare)
    rivals = find_rivals(better, tests)
    if count_parameters(effect) <= count_parameters(better.effect) and (
        _is_contradicted(effect, better, current)
        or holds_nearly_as_well(CandidateTest(effect, better.before, current), better.effect, better.evidence)
        or _leaves_no_more_alone(step, better, current)
        or _is_as_likely_from_there(effect, better, bare, selection)
    ):
        rivals = sort_by_table({*rivals, effect})
    return selection.replace_step(step, replace(step, found=better, rivals=rivals), better.model)


def _drop_without_own_evidence(
    tests: Sequence[CandidateTest], effect: str, without: Model, current: Model
) -> list[CandidateTest]:
    """Drop from tests in the place of an effect that holds the motor, and is seen to, those that are not seen so.

    What bends the motion in few moments may well be likelier, and is found beside the friction if it is there.
    """
    if not EFFECT_BY_NAME[effect].holds or not is_own_evidence(effect, without, current):
        return list(tests)
    return [test for test in tests if has_same_evidence(test.model, without, current)]


def check_beside_torque(selection: Selection, reporter: ProgressReporter) -> Selection:
    """Drop the findings that the random torque that is left has no need of, and add to the others their rivals there.

    For what is chosen as if the rest was white: a slow torque makes the one likelier than the other by hundreds, and
    anything likelier than nothing. What leaves more than its torque does is no rival, as it is no reason to drop one.
    Measured: a drag that left 6.2 rad/s, as likely beside a torque as a real motor's breakaway, which left 2.4 rad/s.
    """
    begun, lacking = _drop_needless(selection, reporter)
    steps = []
    for step in begun.steps:
        effect, current, without = step.found.effect, begun.model, lacking[step.found.effect]
        reporter.report(f"checking {effect}", 0.9, effect, current.held.gap)
        others = list_replacements(step, without.effects, current.effects)
        tests = try_effects(without, begun.hold_out, others, begun.workers, lambda test: None)
        tests = drop_chance_harmonics(tests)
        told = [test for test in tests if test.evidence > thresholds.TIE_LIKELIHOOD]  # what does nothing is no rival
        settled = [settle(test, current, begun.hold_out) for test in told]
        leaving = [test for test in settled if _leaves_what_it_should(test.model, current)]
        rivals = _list_rivals(leaving, effect, current)
        steps.append(replace(step, rivals=sort_by_table({*step.rivals, *rivals})))
    model = selection.model
    for effect in [name for name in model.effects if name not in begun.model.effects]:
        model = refit_without(model, effect, selection.hold_out)
    return replace(selection, steps=tuple(steps), model=model)


def _drop_needless(selection: Selection, reporter: ProgressReporter) -> tuple[Selection, dict[str, Model]]:
    """Drop findings, the least likely first, until each is likelier than nothing beside the random torque that is left.

    With the model that is left beside that torque, and those that lack one finding of it each. A torque that does not
    leave what it should in place of a finding is no reason to drop it. Measured: a breakaway of a real gearmotor that a
    slow torque was likelier than by 14, and the gap rose from 0.76 to 1.3 rad/s, of which that torque leaves 0.71.
    """
    begun = begin_beside_torque(selection.model, selection.hold_out, selection.workers, selection.steps)
    while True:
        model, lacking = begun.model, dict[str, Model]()
        for step in begun.steps:
            reporter.report(f"checking {step.found.effect}", 0.9, step.found.effect, model.held.gap)
            lacking[step.found.effect] = refit_without(model, step.found.effect, begun.hold_out)
        most = model.likelihood - thresholds.TIE_LIKELIHOOD
        needless = {
            step.found.effect: step
            for step in begun.steps
            if (one := lacking[step.found.effect]).likelihood >= most and _leaves_what_it_should(one, model)
        }
        if not needless:
            return begun, lacking
        effect = max(needless, key=lambda name: lacking[name].likelihood)
        begun = begun.replace_step(needless[effect], None, lacking[effect])


def _leaves_what_it_should(without: Model, model: Model) -> bool:
    """Decide whether a model without a finding, or with a rival, leaves what its torque does, or hardly more."""
    if without.held.gap > thresholds.TORQUE_AS_MOTOR_GAP * model.held.gap:
        return False
    worse = predicts_far_worse(without.held.gap, model.held.gap)
    return without.complete or not (model.complete or worse)


def _list_rivals(tests: Sequence[CandidateTest], effect: str, current: Model) -> tuple[str, ...]:
    """List what does as well as an effect of the current model, with no more parameters."""
    alike = [
        test.effect
        for test in tests
        if find_loss(test, current, effect) < thresholds.RIVAL_MARGIN
        or are_alike(test.model, current)
        or does_nearly_as_well(test, effect, current, current.likelihood - test.before.likelihood)
    ]
    return sort_by_table(name for name in alike if count_parameters(name) <= count_parameters(effect))


def _is_contradicted(effect: str, better: CandidateTest, current: Model) -> bool:
    """Decide whether a lag in the place of another one is likelier, but not by far, and leaves more of unseen motion.

    Only what is said of the noise speaks for it then.
    """
    gain, lags = better.model.likelihood - current.likelihood, {effect, better.effect} <= set(LAGS)
    leaves_more = better.model.held.gap > thresholds.SAME_GAP * current.held.gap
    return lags and leaves_more and gain < thresholds.CONTRADICTED


def _leaves_no_more_alone(step: SelectionStep, better: CandidateTest, current: Model) -> bool:
    """Decide whether a finding, likelier than what is better where no torque was known of, leaves no more beside one.

    Only what is said of the torque speaks against it then, and little of that. Measured: a coasting bridge of a real
    motor that runs one way, likelier than a drag by 20 alone, which was likelier by 20 of 252 beside a torque of less
    than a row: it left 0.0471 rad/s, and the drag 0.0475. What holds the motor at rest has a rule of its own.
    """
    effect, alone = step.found.effect, not step.found.model.beside_torque
    there = next((test for test in step.tests if test.effect == better.effect), None)
    if not (alone and better.model.beside_torque) or there is None or both_hold(effect, better.effect):
        return False
    likelier = step.found.evidence > there.evidence and current.held.gap <= better.model.held.gap
    least = (1.0 - thresholds.LITTLE_OF_LEFT) * better.evidence
    return likelier and current.likelihood - better.before.likelihood > least


def _needs_neither(better: CandidateTest, bare: Model) -> bool:
    """Decide whether nothing is needed in the place of a finding: what is better is not, fitted from where that leads.

    The model without the finding may have ended in a local minimum, out of which the other one's start led. Measured:
    of a motor's static curve, 1.02 rad/s without a friction, 0.296 with a limit beyond all that was applied in its
    place, and 0.299 without either.
    """
    escaped = bare.likelihood - better.before.likelihood > likelihood_threshold()
    return escaped and not replace(better, before=bare).is_likely(likelihood_threshold())


def _is_as_likely_from_there(effect: str, better: CandidateTest, bare: Model, selection: Selection) -> bool:
    """Decide whether an effect is a rival of what is better, fitted from where that leads: as good a chance.

    bare: what is better, fitted again without that.
    """
    (test,) = try_effects(bare, selection.hold_out, [effect], selection.workers, lambda test: None)
    return are_alike(test.model, better.model)


def list_replacements(step: SelectionStep, without: Sequence[str], current: Sequence[str]) -> list[str]:
    """List the effects to try instead of a step's: likely where it was found, and not in the current model already.

    First those that did as well there, then what was beside it and is not any more, then what explained more of what
    was found since. without: effects of the model that lacks the step's own.
    """
    likely = [test.effect for test in step.tests if test is not step.found and test.evidence > likelihood_threshold()]
    free = {name for name in list_candidates(without) if name not in current}
    lost = list_lost(step, current)
    names = [name for name in dict.fromkeys((*step.rivals, *lost, *likely)) if name in free]
    return names[: max(thresholds.ELIMINATION_RIVALS, len(free.intersection((*step.rivals, *lost))))]


def list_lost(step: SelectionStep, current: Sequence[str]) -> list[str]:
    """List the effects that a step was found beside and that are not among the current model's any more."""
    return [name for name in step.before.effects if name not in current]
