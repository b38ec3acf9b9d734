"""Judge a model beside a random torque: how likely is all motion under what model, torque and sensor leave?

Training motion counts with its maximum, less half the logarithm of its intervals for every unknown (G. Schwarz, Ann.
Stat. 6, 1978), held-out motion as it comes: together that is the logarithm of a Bayes factor, in which a small effect
has all recordings speak for it. A random torque drowns in a few held-out seconds what half a minute shows.

Every model is scored on one common set of intervals, whole blocks of held-out motion: a density with wide tails takes
what an uncounted edge does, so that nothing has to be left out, and no model chooses what it is judged by.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import ceil, log

import numpy as np

from motor_identification.estimation.estimate import Estimate
from motor_identification.measurement.intervals import Intervals
from motor_identification.noise.error_data import ErrorData, log_likelihood, measure_travel
from motor_identification.noise.error_model import ErrorModel, Lag
from motor_identification.noise.run_gain import FEWEST_RUNS
from motor_identification.recording import Bools, Floats, Integers
from motor_identification.validation.held_out import UNFORESEEN_DRIFTS, HeldOut, list_held_errors, mix_likelihoods
from motor_identification.validation.hold_out import HoldOut

UNFORESEEN_TORQUES = (1.5, 3.0)  # times the training data's: held-out motion may be rougher
MOMENTS = 60  # of a recording: one is about as long as what a restart, met or missed, leaves behind
FEW = 0.05  # of the moments, which no evidence may rest on alone
FEW_RUNS = 0.2  # of the runs, the same


@dataclass(frozen=True)
class Evidence:
    """How likely some motion is, and what each of its moments adds to that."""

    likelihood: float  # logarithm
    moments: Floats


def score_training(estimate: Estimate, rows: Sequence[ErrorData], errors: ErrorModel) -> Evidence:
    """Compute the log likelihood of training motion under an estimate and the errors that it leaves, less its price.

    rows: of every training recording, what the estimate leaves.
    """
    moments = _add_moments(estimate.problem.intervals, rows, errors, estimate.lag)
    return Evidence(float(moments.sum()) - compute_price(estimate), moments)


def compute_price(estimate: Estimate) -> float:
    """Compute what the unknowns of an estimate cost it in log likelihood of the motion that it was fitted to."""
    count = sum(len(data.first) for data in estimate.problem.intervals)
    return 0.5 * log(count) * len(estimate.theta)


def score_held_out(hold_out: HoldOut, held: HeldOut, errors: ErrorModel, lag: Lag) -> Evidence:
    """Compute the log likelihood of held-out motion under the errors that a model leaves.

    Under the training data's torque, or one of a few larger ones, or an angle that drifts: one restart that nobody
    could predict must not refute a model.
    """
    rows = list_held_errors(held, mark_common_set(hold_out))
    unit = max(max(data.slot or measure_travel(data), row.unit) for data, row in zip(held.intervals, rows, strict=True))
    others = [replace(errors, white=share * unit**2) for share in UNFORESEEN_DRIFTS]
    if errors.rms_voltage > 0.0:
        others += [replace(errors, rms_voltage=factor * errors.rms_voltage) for factor in UNFORESEEN_TORQUES]
    moments = _add_moments(held.intervals, rows, errors, lag)
    others_too = [log_likelihood(rows, model, lag) for model in others]
    return Evidence(mix_likelihoods(float(moments.sum()), others_too), moments)


def mark_common_set(hold_out: HoldOut) -> tuple[Bools, ...]:
    """Mark the held-out intervals that every model is scored on: whole blocks, whatever a model says of them."""
    problem = hold_out.problem
    return hold_out.scored_blocks.mark_each(problem.intervals, problem.sample_period)


def _add_moments(intervals: Sequence[Intervals], rows: Sequence[ErrorData], errors: ErrorModel, lag: Lag) -> Floats:
    """Add up what the intervals of each moment of every recording say, all recordings one after the other."""
    pairs = zip(intervals, rows, strict=True)
    return np.concatenate([np.bincount(_moment_of(data), row.densities(errors, lag), MOMENTS) for data, row in pairs])


def _moment_of(data: Intervals) -> Integers:
    share = data.time[data.first] / data.time[-1]
    return np.asarray(np.clip((share * MOMENTS).astype(np.int64), 0, MOMENTS - 1))


def measure_steadiness(before: Floats, after: Floats, speaking: float = 1.0, runs: int = 1) -> float:
    """Measure by how much the log likelihood rises without the few moments (M,) that speak most for the rise.

    A restart that is met by luck is worth tens of nats, and there are few of them; what is there speaks all the time.
    Or in most of many runs, in each of which it may show at the beginning alone. speaking: the share of the moments in
    which it can. runs: recordings, whose moments follow each other, of held-out and of training motion.
    """
    gains = after - before
    steady = _add_all_but_best(gains, FEW * speaking)
    if runs < FEWEST_RUNS:
        return steady
    parts = gains.reshape(-1, MOMENTS).sum(axis=1)
    of_runs = parts.reshape(-1, runs).sum(axis=0) if len(parts) % runs == 0 else parts
    return max(steady, _add_all_but_best(of_runs, FEW_RUNS))


def _add_all_but_best(gains: Floats, share: float) -> float:
    """Add up gains (M,) without the best, a share of them."""
    return float(np.sort(gains)[: len(gains) - ceil(share * len(gains))].sum())


def measure_speaking(before: Floats, after: Floats) -> float:
    """Measure the share of moments (M,) in which two models differ, by their effective number (Σ|g|)²/Σg²."""
    gains = np.abs(after - before)
    power = float(np.sum(gains**2)) * len(gains)
    return float(np.sum(gains)) ** 2 / power if power > 0.0 else 1.0
