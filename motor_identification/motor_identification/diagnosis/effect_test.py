"""Test effects: add every effect that a model lacks, and judge each on data that no fit has seen."""

from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from itertools import cycle

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_fit import refine_beside_torque, split_kv, validate_model
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import CandidateTest, likelihood_threshold
from motor_identification.diagnosis.evidence.line_evidence import (
    drop_chance_harmonics,
    drop_few_turns,
    has_waves,
    is_heavy_load,
    is_of_sensor,
)
from motor_identification.diagnosis.fits.effect_fit import fit_with_effect
from motor_identification.estimation.estimate import Estimate
from motor_identification.measurement.command_swing import has_one_size, is_sweep
from motor_identification.periodic.periodic_fit import LOAD_OVER_ANGLE, add_load_once_a_turn
from motor_identification.recording import have_steady_states
from motor_identification.validation.held_out import HeldOut
from motor_identification.validation.hold_out import HoldOut
from motor_identification.validation.instants import (
    comes_slowly,
    list_first_motions,
    list_instant_columns,
    needs_instant,
)
from motor_model.effect import Effect
from motor_model.effects import EFFECT_BY_NAME, LAGS

EFFECT_ORDER = {name: number for number, name in enumerate(EFFECT_BY_NAME)}  # the most common first
Heard = Callable[[CandidateTest], None]  # told of each test as it is done


def list_candidates(effects: Sequence[str], judged: HeldOut | None = None, beside_torque: bool = False) -> list[str]:
    """List the effects a model can be given next: what it does not have, whose own condition it has.

    judged: what it is judged by. Where the fits have seen that, nothing that comes slowly, which takes up whatever a
    model lacks, unless it has to be likelier than a slow torque of one recording (`beside_torque`), and nothing that
    happens once in each of several recordings; and in a single response nothing that happens once or repeats with the
    angle: some instants, or some line, are found in any. Where a command's frequency goes one way, nothing that comes
    slowly: whatever depends on frequency does; nor in seconds, in which nothing has come. Where values have white noise
    and nothing is counted, as a tachogenerator's, there is no disc for anything to be on; and where rows of speeds are
    uneven it does not show. What voltage a motor breaks away at is not seen under one voltage, at which it does. Steady
    states show what is of a speed and a voltage, and nothing that takes time.
    """
    return [
        effect.name
        for effect in EFFECT_BY_NAME.values()
        if effect.name not in effects
        and effect.fitted
        and (effect.implies is None or effect.implies in effects)
        and (judged is None or _can_be_judged(effect, judged, beside_torque))
    ]


def _can_be_judged(effect: Effect, judged: HeldOut, beside_torque: bool) -> bool:
    if effect.on_disc and not any(data.tells_of_disc for data in judged.intervals):
        return False
    if effect.holds and effect.implies is not None and has_one_size(judged.recordings):
        return False
    if comes_slowly(effect.name) and judged.recordings and all(map(is_sweep, judged.recordings)):
        return False
    if is_over_too_soon(effect.name, judged):
        return False
    if not is_static(effect.name) and have_steady_states(judged.recordings):
        return False
    if not judged.seen or not (effect.anywhere or effect.periodic):
        return True
    once = (needs_instant(effect.name) or beside_torque) and len(judged.recordings) == 1
    return judged.confirms and (effect.periodic or once)


def is_over_too_soon(effect: str, judged: HeldOut) -> bool:
    """Decide whether recordings are over before an effect that comes slowly, such as a warming-up, can have come."""
    if not comes_slowly(effect) or not judged.recordings:
        return False
    least = min(thresholds.SLOW_TIME, thresholds.SLOW_CONSTANTS * judged.parameters.time_constant)
    return max(recording.duration for recording in judged.recordings) < least


def try_effects(
    current: Model, hold_out: HoldOut, effects: Sequence[str], workers: int, heard: Heard, least: float = 0.0
) -> list[CandidateTest]:
    """Fit and validate a model with each of some effects more, best first.

    A periodic effect is not fitted where its spectrum promises less than `least`.
    """

    def one(effect: str) -> CandidateTest:
        test = _try_effect(current, hold_out, effect, least)
        heard(test)
        return test

    with ThreadPoolExecutor(max(workers, 1)) as pool:
        return sorted(pool.map(one, effects), key=lambda test: -test.evidence)


def _try_effect(current: Model, hold_out: HoldOut, effect: str, least: float) -> CandidateTest:
    larger = fit_with_effect(current.estimate, effect, least, current.learned)
    if larger is None:
        return CandidateTest(effect, current, current)
    if EFFECT_BY_NAME[effect].periodic:
        return _compare_periodic(current, hold_out, effect, larger)
    test = CandidateTest(effect, current, validate_model(hold_out, larger, current))
    if current.beside_torque and (test.evidence > 0.0 or test.is_held_back):
        test = replace(test, model=refine_repeatedly(test.model, hold_out))
    return replace(test, model=split_kv(test.model, hold_out)) if EFFECT_BY_NAME[effect].splits_kv else test


def try_load_once_a_turn(current: Model, hold_out: HoldOut) -> CandidateTest:
    """Fit and validate a model with a torque that goes round once a turn more: the other word for what a disc does."""
    return _compare_periodic(current, hold_out, LOAD_OVER_ANGLE, add_load_once_a_turn(current.estimate))


def _compare_periodic(current: Model, hold_out: HoldOut, effect: str, larger: Estimate) -> CandidateTest:
    """Compare both on held-out motion in directions of the larger one, which may turn the shaft back elsewhere.

    Nothing is found where a sensor that errs with the angle makes the line.
    """
    own = hold_out.correct_directions(larger)
    test = CandidateTest(effect, validate_model(own, current.estimate, current), validate_model(own, larger, current))
    is_likely = test.evidence > thresholds.RIVAL_MARGIN
    return CandidateTest(effect, current, current) if is_likely and is_of_sensor(test) else test


def refine_repeatedly(model: Model, hold_out: HoldOut, rounds: int = thresholds.REFINEMENTS) -> Model:
    """Refine a model beside the torque that it leaves, and as long as it leaves less of one and is likelier for it."""
    for _ in range(rounds):
        refined = refine_beside_torque(model, hold_out)
        gained, model = refined.likelihood - model.likelihood, refined
        if gained < thresholds.TIE_LIKELIHOOD:
            break
    return model


def choose_finding(tests: Sequence[CandidateTest]) -> CandidateTest | None:
    """Choose the finding among tests, best first, if there is one: likely, and relevant; of equals the most common.

    Of what held-out data hardly tell apart, all data choose: there are several times as many. What needs an instant, or
    one for every recording, has to be more likely than what needs none.
    """
    tests = drop_few_turns(drop_chance_harmonics(tests))
    findings = _drop_what_predicts_worse([test for test in tests if _is_finding(test)])
    if not findings:
        return None
    best = _choose_first(findings)
    alike = [
        test
        for test in findings
        if test.evidence > best.evidence - thresholds.RIVAL_MARGIN
        and count_parameters(test.effect) <= count_parameters(best.effect)
    ]
    alike = [test for test in alike if not needs_instant(test.effect)] or alike
    most = max(test.evidence_of_all for test in alike)
    equals = [test for test in alike if test.evidence_of_all >= most - thresholds.COMMON_LIKELIHOOD]
    return min(equals, key=lambda test: EFFECT_ORDER[test.effect])


def _drop_what_predicts_worse(findings: Sequence[CandidateTest]) -> list[CandidateTest]:
    """Drop findings that predict unseen motion worse than nothing, where another takes away most of what is left.

    Beside a random torque a ripple follows that through a motion, likelier by hundreds than the friction that is there.
    """
    most = any(test.explains > thresholds.MOST_OF_GAP for test in findings)
    return [test for test in findings if not most or test.explains >= 0.0]


def _choose_first(findings: Sequence[CandidateTest]) -> CandidateTest:
    """Choose the most likely of findings, best first; what needs an instant only where nothing else does about as well.

    For it is fitted to any slow torque, too, and is still found beside what comes first, where it is there.
    """
    best = findings[0]
    if not needs_instant(best.effect):
        return best
    least = thresholds.COMES_FIRST * best.evidence
    return next((one for one in findings if one.evidence > least and not needs_instant(one.effect)), best)


def _is_finding(test: CandidateTest) -> bool:
    return is_supported(test) and test.relevant and comes_back(test) and not is_there_from_the_start(test)


def comes_back(test: CandidateTest) -> bool:
    """Whether a test's effect comes back over the angle as often as it must, if it repeats, or is a load that need not.

    What does not is no finding, however likely: neither by itself, nor in the place of one.
    """
    return has_waves(test) or is_heavy_load(test.model, test.effect)


def is_there_from_the_start(test: CandidateTest) -> bool:
    """Whether what begins at an instant does so with the motion: then it is constant, or a wrong initial state."""
    if not needs_instant(test.effect) or test.effect not in test.model.effects:
        return False
    estimate = test.model.estimate
    columns, begins = list_instant_columns(estimate.problem, [test.effect]), list_first_motions(estimate.problem)
    lag = thresholds.ON_ITS_WAY * estimate.parameters.time_constant
    return all(
        float(estimate.theta[column]) < begin + max(thresholds.FROM_THE_START * duration, lag)
        for (column, duration), begin in zip(columns, cycle(begins), strict=False)
    )


def is_supported(test: CandidateTest) -> bool:
    """Decide whether unseen data speak for an effect, and those that it was fitted to do not speak against it."""
    return test.is_likely(likelihood_threshold()) and test.fits_training


def is_static(effect: str) -> bool:
    """Decide whether speed and voltage of a moment say all that an effect does then, as gains of runs at levels do."""
    row = EFFECT_BY_NAME[effect]
    return not (row.periodic or row.anywhere or row.after_reversals or effect in LAGS)


def count_parameters(effect: str) -> int:
    """Count the parameters of an effect."""
    return len(EFFECT_BY_NAME[effect].parameters)


def sort_by_table(names: Iterable[str]) -> tuple[str, ...]:
    """Sort effects in the table's order: it does not depend on the last digit of a likelihood."""
    given = set(names)
    return tuple(name for name in EFFECT_BY_NAME if name in given)
