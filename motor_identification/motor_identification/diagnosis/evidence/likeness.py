"""Tell whether another effect explains about as much as one that was found does: then it is its rival."""

from collections.abc import Sequence

import numpy as np

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import CandidateTest, likelihood_threshold
from motor_identification.diagnosis.effect_test import EFFECT_ORDER, count_parameters, sort_by_table
from motor_identification.diagnosis.evidence.line_evidence import drop_chance_harmonics
from motor_identification.recording import Floats
from motor_model.effects import EFFECT_BY_NAME


def find_rivals(found: CandidateTest, tests: Sequence[CandidateTest]) -> tuple[str, ...]:
    """Find the effects that explain as much as a finding does, of held-out or of all data, with no more parameters."""
    others = [test for test in drop_chance_harmonics(tests) if test.effect != found.effect]
    others = [test for test in others if test.evidence > likelihood_threshold()]
    alike = [
        test.effect
        for test in others
        if is_alike(
            found.evidence - test.evidence,
            found.evidence_of_all - test.evidence_of_all,
            np.subtract(found.model.score.by_recording, test.model.score.by_recording),
        )
        or does_nearly_as_well(test, found.effect, found.model, found.evidence)
    ]
    return sort_by_table(name for name in alike if count_parameters(name) <= count_parameters(found.effect))


def holds_nearly_as_well(test: CandidateTest, effect: str, evidence: float) -> bool:
    """Decide whether a more common effect does most of what another does, where both hold the motor at rest.

    They differ while the motor slows down and turns back: what nobody named bends a motion there, too.
    effect, evidence: of the one that was found, beside the model that the test is beside.
    """
    common = EFFECT_ORDER[test.effect] < EFFECT_ORDER[effect]
    return both_hold(test.effect, effect) and common and test.evidence > (1.0 - thresholds.HOLDING_LEAD) * evidence


def both_hold(one: str, other: str) -> bool:
    """Decide whether two effects hold the motor at rest under a voltage."""
    return EFFECT_BY_NAME[one].holds and EFFECT_BY_NAME[other].holds


def is_alike(gain: float, of_all: float, by_recording: Floats) -> bool:
    """Decide whether a finding is told from another effect by little, by unseen or by all data, or by few recordings.

    Where both models are off, one part of the motion chooses between them: the held-out one, or a few of many runs.
    gain, of_all: of log likelihood, of unseen and of all data; by_recording: of those it was fitted to, shape (K,).
    """
    return min(gain, of_all) < thresholds.RIVAL_MARGIN or is_against_most(by_recording)


def are_alike(other: Model, found: Model) -> bool:
    """Decide the same of two models that were judged by the same data."""
    one, two = found.score, other.score
    gains = np.subtract(one.by_recording, two.by_recording)
    return is_alike(one.likelihood - two.likelihood, one.of_all - two.of_all, gains)


def does_nearly_as_well(test: CandidateTest, effect: str, found: Model, evidence: float) -> bool:
    """Decide whether an effect does most of what another one does, or leaves hardly more where that is not all.

    effect, evidence: of the one that was found, beside the model that the test is beside.
    """
    return holds_nearly_as_well(test, effect, evidence) or _leaves_as_little(test, effect, found, evidence)


def _leaves_as_little(test: CandidateTest, effect: str, found: Model, evidence: float) -> bool:
    """Decide whether an effect leaves hardly more than one that was found, beside what that one leaves unexplained.

    Where a model is not all that is there, a likelihood tells what bends the motion the right way, not what bends it:
    four real runs of one level each had a limit, likelier by 7 and 10 of 65 than what slips or drags. What holds the
    motor at rest has a rule of its own.
    effect, evidence: of the one that was found, beside the model that the test is beside.
    """
    if test.evidence < (1.0 - thresholds.LITTLE_OF_LEFT) * evidence or both_hold(test.effect, effect):
        return False
    if found.beside_torque or found.held.gap < thresholds.LEFT_GAP * found.unpredictable_gap:
        return False
    left = found.held.gap**2 - found.unpredictable_gap**2
    return test.model.held.gap**2 - found.held.gap**2 < thresholds.LITTLE_OF_LEFT * left


def is_against_most(gains: Floats) -> bool:
    """Decide whether most recordings (K,) lose log likelihood, together more than chance, without the few best."""
    if len(gains) < thresholds.FEWEST_RUNS:
        return False
    most = np.sort(gains)[: len(gains) - int(thresholds.FEW_RUNS * len(gains))]
    return bool(np.sum(most) < -thresholds.COMMON_LIKELIHOOD and np.count_nonzero(gains < 0.0) > 0.5 * len(gains))
