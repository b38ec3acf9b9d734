"""Learn what a model leaves of several runs: sensor, random torque, and by how much the runs' gains differ.

In turns: the gains, each with the prior of all, and what else is left without what they add. A supply that differs from
run to run is no slow torque: it is as large a share of every voltage, and effects that go with the voltage have to be
told from it.
"""

from collections.abc import Sequence
from dataclasses import replace
from math import sqrt

import numpy as np

from motor_identification.noise.error_data import ErrorData, log_likelihood
from motor_identification.noise.error_learning import PRICE, learn_error_model
from motor_identification.noise.error_model import ErrorModel, Lag
from motor_identification.noise.run_gain import (
    FEWEST_RUNS,
    MOST_SCATTER,
    RunGain,
    estimate_scatter,
    goes_smoothly,
    guess_deviation,
    price_scatter,
)

LEAST_SCATTER = 1e-6  # of the gains to begin with
ALIKE = 0.03  # of the largest level: runs at one
EVALUATIONS = 60  # from errors that are known
ROUNDS, SCATTER_STEPS = 2, 3  # of gains and what else is left in turns; and of the gains' scatter in each


def learn_errors_of_runs(
    rows: Sequence[ErrorData], lag: Lag, guess: ErrorModel | None = None, evaluations: int = 120
) -> ErrorModel:
    """Find the error model under which the increments of runs are most likely; their gains differ if that is likelier.

    lag: the motor. guess: where to begin, of a similar model; else a grid tells. Gains that agree there, do; what
    scatters by more than any supply is none of it.
    """
    agreeing = learn_error_model(rows, lag, guess, evaluations)
    if len(rows) < FEWEST_RUNS or (guess is not None and guess.gain == 0.0):
        return agreeing
    differing = _learn_with_gains(rows, lag, guess, evaluations)
    if differing.gain > MOST_SCATTER or _follow_levels(rows, differing, lag):
        return agreeing
    gained = log_likelihood(rows, differing, lag) - log_likelihood(rows, agreeing, lag)
    return differing if gained > PRICE + price_scatter(differing.gain) else agreeing


def learn_own_gains(rows: Sequence[ErrorData], lag: Lag, guess: ErrorModel) -> ErrorModel | None:
    """Find the error model of runs each of which has a gain of its own, as likely or not as that they agree.

    lag: the motor. guess: errors of runs that agree. None where runs are few, scatter by more than any supply, or
    follow their levels. A slow torque and a gain of each run are two words for the same where runs have one level each.
    """
    if len(rows) < FEWEST_RUNS:
        return None
    differing = _learn_with_gains(rows, lag, guess, EVALUATIONS)
    return None if differing.gain > MOST_SCATTER or _follow_levels(rows, differing, lag) else differing


def _follow_levels(rows: Sequence[ErrorData], model: ErrorModel, lag: Lag) -> bool:
    """Decide whether the gains of runs go with how fast each ran: then they are a curve that a motor has."""
    levels = np.array([float(np.sum(row.travel) / np.sum(row.duration)) for row in rows])
    gains = np.array([row.find_gain(model, lag).deviation for row in rows])
    mixed = np.random.default_rng(0).permutation(len(rows))  # runs alike may be in the order of a battery's charge
    places = np.rint(levels[mixed] / (ALIKE * np.max(np.abs(levels))))
    orders = (np.argsort(some, kind="stable") for some in (places, np.abs(places)))
    return any(goes_smoothly(gains[mixed][order]) for order in orders)


def score_under_own_errors(rows: Sequence[ErrorData], lag: Lag, guess: ErrorModel, evaluations: int) -> float:
    """Compute the log likelihood of the increments of runs under the errors that are learned of them."""
    errors = learn_errors_of_runs(rows, lag, guess, evaluations)
    return log_likelihood(rows, errors, lag) - price_scatter(errors.gain)


def _learn_with_gains(rows: Sequence[ErrorData], lag: Lag, guess: ErrorModel | None, evaluations: int) -> ErrorModel:
    """Find the likeliest error model of runs whose gains differ."""
    gains = [RunGain(guess_deviation(row.increments, row.travel), 0.0) for row in rows]
    scatter = sqrt(float(np.mean([gain.deviation**2 for gain in gains]))) + LEAST_SCATTER
    model = guess
    for _ in range(ROUNDS):
        rest = [row.less(gain) for row, gain in zip(rows, gains, strict=True)]
        model = learn_error_model(rest, lag, model, evaluations)
        for _ in range(SCATTER_STEPS):
            gains = [row.find_gain(replace(model, gain=scatter), lag) for row in rows]
            scatter = estimate_scatter(gains, scatter)
    assert model is not None
    return replace(model, gain=scatter)
