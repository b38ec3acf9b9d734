"""Compare models that have something in the place of an effect with the model that has the effect."""

from collections.abc import Sequence

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import CandidateTest, find_speaking, is_same_motion
from motor_identification.diagnosis.effect_test import EFFECT_ORDER, count_parameters
from motor_identification.diagnosis.evidence.torque_evidence import measure_steadiness


def choose_better(tests: Sequence[CandidateTest], effect: str, current: Model) -> CandidateTest | None:
    """Choose among tests, best first, what does better than an effect of the current model; of equals the most common.

    None if nothing does.
    """
    best = next((test for test in tests if is_better(test, effect, current)), None)
    if best is None:
        return None
    least, most = best.evidence - thresholds.TIE_LIKELIHOOD, count_parameters(best.effect)
    equals = [test for test in tests if test.evidence > least and count_parameters(test.effect) <= most]
    return min(equals, key=lambda test: EFFECT_ORDER[test.effect])


def is_better(test: CandidateTest, effect: str, current: Model) -> bool:
    """Decide whether a test's model is better: more likely by the margin, or nearly as likely with fewer parameters.

    Beside a random torque the simpler one may be less likely in a few moments.
    """
    if count_parameters(test.effect) >= count_parameters(effect):
        return current.likelihood - test.model.likelihood < -thresholds.RIVAL_MARGIN
    return find_loss(test, current, effect) < thresholds.RIVAL_MARGIN or is_same_motion(test.model, current)


def find_loss(test: CandidateTest, current: Model, effect: str) -> float:
    """Find what a test's model loses of log likelihood beside the current one, which has an effect instead.

    Beside a random torque not counting the few moments that speak most against it, of those in which the effect can,
    unless it predicts far worse: a slow torque does in one moment what a load step does. Measured: for a breakaway of
    0.95 ± 0.05 V, likelier by 82, a load of 3 mV was put.
    """
    loss = current.likelihood - test.model.likelihood
    if not current.beside_torque or test.model.held.gap > thresholds.WORSE_GAP * current.held.gap:
        return loss
    speaking = find_speaking(effect, current, test.model)
    return min(loss, measure_steadiness(test.model.score.moments, current.score.moments, speaking))
