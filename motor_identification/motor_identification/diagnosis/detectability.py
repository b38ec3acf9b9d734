"""Find undetectable effects: of a size that matters, but with a trace that the model's own parameters imitate."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import exp, log1p

import numpy as np

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import likelihood_threshold
from motor_identification.diagnosis.effect_test import is_supported, list_candidates, try_effects
from motor_identification.diagnosis.evidence.line_evidence import drop_chance_harmonics
from motor_identification.diagnosis.fits.disturbed_fit import list_error_data
from motor_identification.diagnosis.fits.effect_fit import add_noticeable_effect
from motor_identification.diagnosis.result import Imitated
from motor_identification.diagnosis.selection.selection import Selection
from motor_identification.noise.error_data import make_whitening
from motor_identification.noise.likelihood import log_likelihood
from motor_identification.noise.run_gain import move_to_likeliest
from motor_identification.recording import Floats
from motor_model.effects import EFFECT_BY_NAME

ANY_GAIN = 1e3  # a prior that says nothing of a gain
LEAST_TURNS = 2.0  # of the encoder's shaft: what comes once in a turn, or more often, has not come back before


def find_undetectable(model: Model) -> tuple[str, ...]:
    """Find the effects that a model lacks and that would not have been found in its recordings, had they been there.

    Each is added at a size that matters; what of its trace the model's own parameters cannot imitate, by least squares
    on the training data, is what there would have been to find.
    """
    judged = list_candidates(model.effects, model.held, model.beside_torque)
    shown = {name for name in judged if EFFECT_BY_NAME[name].periodic and model.turns >= LEAST_TURNS}
    for trace in _trace_effects(model, judged):
        if not _expect_evidence(model, trace.left) < likelihood_threshold():
            shown.add(trace.effect)
    # What is not judged shows nothing: of one response, any line explains some.
    return tuple(effect for effect in list_candidates(model.effects) if effect not in shown)


def find_imitated(model: Model, hidden: Sequence[str]) -> Imitated | None:
    """Find the hidden effect beside which kv would be most another, of a size that matters; None if none would be far.

    A standard error is that of a motor that has only what the model has. Measured: of coast-downs a dead zone of 1.7 V
    made kv 42 % larger, by ± 2 %, and left as much with it as without it.
    """
    if "kv" in model.uncertainty.not_identifiable:
        return None
    kv, at = model.estimate.parameters.value("kv"), model.estimate.problem.unknowns.names.index("kv")
    error = float(model.uncertainty.errors[model.whitened.problem.unknowns.names.index("kv")])  # a share of it
    found, most = None, thresholds.IMITATION
    for trace in _trace_effects(model, hidden):
        beside = kv * exp(np.clip(-trace.imitation[at], -1.0, 1.0))  # what is not determined may go anywhere
        change = abs(beside / kv - 1.0)
        far = most < change < thresholds.MOST_IMITATION and abs(trace.imitation[at]) > thresholds.SURE_IMITATION * error
        if far and _expect_evidence(model, trace.left) < likelihood_threshold():
            found, most = Imitated(trace.effect, trace.size, beside), change
    return found


@dataclass(frozen=True)
class _Trace:
    """What an effect of a size that matters would leave in the training data of a model that lacks it."""

    effect: str
    size: float  # of its first parameter
    imitation: Floats  # (D,) of it, what the model's own unknowns do
    left: Floats  # [rad/s] (I,) what they cannot


def _trace_effects(model: Model, effects: Sequence[str]) -> Iterator[_Trace]:
    """Add each of the effects to a model, at a size that matters; not what has a phase, which may be any."""
    problem, theta = model.estimate.problem, model.estimate.theta
    columns, without = problem.jacobian(theta), problem.residuals(theta)
    for effect in effects:
        if EFFECT_BY_NAME[effect].periodic:
            continue
        larger = add_noticeable_effect(model.estimate, effect)
        trace = larger.problem.residuals(larger.theta) - without
        imitation = find_imitation(columns, trace, problem.weight)
        size = larger.parameters.value(EFFECT_BY_NAME[effect].parameters[0].name)
        yield _Trace(effect, size, imitation, trace - columns @ imitation)


def list_unturned_discs(selection: Selection) -> tuple[str, ...]:
    """List the effects on a disc that motion speaks for beside what was selected, though it hardly came round once.

    Of so small a part of a turn they bend the motion and scale it, which a torque and kv do, too: neither is one found,
    nor is it true that it could not show. What is at a place is one of many, as what is at an instant.
    """
    model, quiet = selection.model, selection.model.quiet
    if quiet or not model.held.counted.any() or model.turns >= LEAST_TURNS:
        return ()
    judged = list_candidates(model.effects, model.held, model.beside_torque)
    discs = [name for name in judged if EFFECT_BY_NAME[name].on_disc]
    tests = try_effects(model, selection.hold_out, discs, selection.workers, lambda test: None)
    told = [one for one in drop_chance_harmonics(tests) if one.relevant and is_supported(one)]
    return tuple(one.effect for one in told if one.is_likely(thresholds.INSTANT_LIKELIHOOD))


def find_imitation(columns: Floats, trace: Floats, weight: Floats) -> Floats:
    """Find by weighted least squares how much of each column (I, D) of a Jacobian imitates a trace (I,), shape (D,)."""
    root = np.sqrt(weight)
    return np.asarray(np.linalg.lstsq(root[:, None] * columns, root * trace, rcond=1e-9)[0])


def _expect_evidence(model: Model, left: Floats) -> float:
    """Compute the log likelihood ratio that a trace [rad/s] would bring."""
    problem = model.estimate.problem
    if model.errors.gain > 0.0:
        return _expect_evidence_beside_gains(model, problem.to_travel(left))
    rows = zip(problem.intervals, problem.to_travel(left), strict=True)
    return sum(
        log_likelihood(data, 0.0 * part, model.noise) - log_likelihood(data, part, model.noise) for data, part in rows
    )


def _expect_evidence_beside_gains(model: Model, traces: Sequence[Floats]) -> float:
    """Compute what traces of travel [rad], of each run, would bring beside gains that differ.

    What of them is like a gain only makes the runs' gains scatter more: of n gains n/2 ln(1 + mean c²/s²).
    """
    errors, lag = model.errors, model.lag
    evidence, like_gains = 0.0, []
    for row, trace in zip(model.less_gains(list_error_data(model.estimate)), traces, strict=True):
        whitening = make_whitening(row, errors.without_gain, lag)
        white, response = whitening.white(trace), whitening.white(row.travel)
        gain = move_to_likeliest(0.0, white, response, ANY_GAIN)
        evidence += 0.5 * float(np.sum((white - gain.deviation * response) ** 2))
        like_gains.append(gain.deviation)
    return evidence + 0.5 * len(like_gains) * log1p(float(np.mean(np.square(like_gains))) / errors.gain**2)
