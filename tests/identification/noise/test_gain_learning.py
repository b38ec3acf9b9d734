"""The scatter of the runs' gains is learned beside sensor and torque, and is none where runs agree."""

from dataclasses import replace

import numpy as np
import pytest

from motor_identification.measurement.intervals import index_intervals
from motor_identification.noise import gain_learning
from motor_identification.noise.error_data import ErrorData, log_likelihood, make_error_data, make_whitening
from motor_identification.noise.error_learning import PRICE, learn_error_model
from motor_identification.noise.error_model import ErrorModel, Lag
from motor_identification.noise.gain_learning import learn_errors_of_runs, learn_own_gains
from motor_identification.noise.run_gain import FEWEST_RUNS, MOST_SCATTER

LAG = Lag(12.0, 0.0055)
SLOT, SHARE = 0.06, 0.02  # [rad], of it
GAINS = 1.0 + 0.03 * np.array([1.0, -1.2, 0.4, 0.9, -0.6, -1.0, 1.3, 0.2])


def leave(gains: np.ndarray, levels: np.ndarray | None = None) -> list[ErrorData]:
    """What a true motor leaves of runs of 2 s in which it gets faster, with gains of their own, each up to a level."""
    random, start = np.random.default_rng(1), 0.01 * np.arange(200)
    rows = []
    for gain, level in zip(gains, np.ones(len(gains)) if levels is None else levels, strict=True):
        simulated = 20.0 * level * (1.0 - np.exp(-LAG.rate * start))
        error = np.diff(SHARE * SLOT * random.normal(size=201)) / 0.01
        data = index_intervals(start, start + 0.01, gain * simulated + error, np.full(200, 1e-6))
        angle = np.interp(data.time, np.append(start, 2.0), np.append(0.0, np.cumsum(0.01 * simulated)))
        rows.append(make_error_data(replace(data, slot=SLOT), 0.01 * (simulated - data.speed), None, angle))
    return rows


def test_gains_are_learned_with_their_scatter() -> None:
    rows = leave(GAINS)
    model = learn_errors_of_runs(rows, LAG)
    assert model.gain == pytest.approx(np.std(GAINS - 1.0), rel=0.1) and model.share == pytest.approx(SHARE, rel=0.1)
    assert model.rms_voltage == 0.0 < learn_error_model(rows, LAG).rms_voltage  # which a slow torque stood in for
    found = [row.find_gain(model, LAG).deviation for row in rows]
    assert found == pytest.approx(1.0 - GAINS, abs=2e-3)
    assert make_whitening(rows[0], model, LAG).white(rows[0].increments).std() == pytest.approx(1.0, abs=0.15)


@pytest.mark.parametrize("gains", [np.ones(8), GAINS[: FEWEST_RUNS - 1]], ids=["agree", "few"])
def test_runs_that_agree_and_few_runs_are_as_without_gains(gains: np.ndarray) -> None:
    rows = leave(gains)
    assert learn_errors_of_runs(rows, LAG) == learn_error_model(rows, LAG)


@pytest.mark.parametrize(("size", "supply"), [(0.13, True), (0.2, False)])
def test_what_scatters_more_than_any_supply_is_none_of_it(size: float, supply: bool) -> None:
    """But of what a model lacks, such as a dead zone that holds a motor in some of its runs."""
    gains = 1.0 + size * (GAINS - 1.0) / 0.03
    assert (np.std(gains) < MOST_SCATTER) == supply
    assert (learn_errors_of_runs(leave(gains), LAG).gain > 0.0) == supply


def test_gains_agree_where_those_of_a_similar_model_do() -> None:
    rows, guess = leave(GAINS), ErrorModel(SHARE, 0.0, 0.05, 0.1)
    assert learn_errors_of_runs(rows, LAG, guess) == learn_error_model(rows, LAG, guess)
    assert learn_errors_of_runs(rows, LAG, replace(guess, gain=0.01)).gain > 0.02


def test_likelihood_white_residuals_and_densities_say_the_same() -> None:
    row, model = leave(GAINS)[1], ErrorModel(SHARE, 0.0, 0.05, 0.1, 0.03)
    value, white = row.whiten(model, LAG, row.travel[None])
    assert log_likelihood([row], model, LAG) == pytest.approx(value) == pytest.approx(row.densities(model, LAG).sum())
    assert value > row.score(model.without_gain, LAG)
    assert make_whitening(row, model, LAG).white(row.increments) == pytest.approx(
        white[0], abs=0.05
    )  # outliers weigh less
    half = replace(row, counted=np.arange(200) < 100)
    assert half.score(model, LAG) == pytest.approx(half.densities(model, LAG).sum())


def test_gains_that_go_with_the_level_of_each_run_are_a_curve_and_no_supply() -> None:
    """Unless all are at one level: then their order may be that of a battery's charge."""
    gains, levels = 1.0 + 0.03 * np.linspace(-1.3, 1.3, 8), np.linspace(0.3, 1.0, 8)
    assert learn_errors_of_runs(leave(gains, levels), LAG).gain == 0.0
    assert learn_errors_of_runs(leave(gains, levels * np.array([1.0, -1.0] * 4)), LAG).gain == 0.0  # alike either way
    assert learn_errors_of_runs(leave(gains), LAG).gain == pytest.approx(np.std(gains), rel=0.1)
    mixed = np.array([3, 0, 6, 2, 7, 1, 5, 4])
    assert learn_errors_of_runs(leave(gains[mixed], levels), LAG).gain == pytest.approx(np.std(gains), rel=0.1)


def test_runs_have_gains_of_their_own_however_likely_a_slow_torque_is() -> None:
    """Of runs at one level each both are words for the same; not where gains follow the levels, or are no supply's."""
    torque = ErrorModel(SHARE, 0.0, 0.1, 0.5)
    own = learn_own_gains(leave(GAINS), LAG, torque)
    assert own is not None and own.gain == pytest.approx(np.std(GAINS - 1.0), rel=0.15)
    assert learn_own_gains(leave(GAINS[: FEWEST_RUNS - 1]), LAG, torque) is None
    rising, levels = 1.0 + 0.03 * np.linspace(-1.3, 1.3, 8), np.linspace(0.3, 1.0, 8)
    assert learn_own_gains(leave(rising, levels), LAG, torque) is None
    for size, supply in ((0.13, True), (0.2, False)):
        assert (learn_own_gains(leave(1.0 + size * (GAINS - 1.0) / 0.03), LAG, torque) is not None) is supply


def test_gains_differ_where_that_is_worth_their_scatter(monkeypatch: pytest.MonkeyPatch) -> None:
    rows = leave(1.0 + 0.5 * (GAINS - 1.0))
    learned = learn_errors_of_runs(rows, LAG)
    gained = log_likelihood(rows, learned, LAG) - log_likelihood(rows, learn_error_model(rows, LAG), LAG)
    for price, differ in ((gained - PRICE - 0.1, True), (gained - PRICE + 0.1, False)):
        monkeypatch.setattr(gain_learning, "price_scatter", lambda scatter, price=price: price)
        assert (learn_errors_of_runs(rows, LAG).gain > 0.0) is differ
