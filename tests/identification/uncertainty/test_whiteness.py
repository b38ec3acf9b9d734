"""Residual analysis: noise passes, repetition and a trace of the voltage do not, and gaps are no matter."""

from dataclasses import replace
from math import isnan

import numpy as np
import pytest
from plant import profiles, record
from scipy.signal import lfilter
from scipy.stats import kstest
from tiers import keep_fast

from motor_identification.identify import Request, SearchConfig, identify
from motor_identification.recording import check
from motor_identification.reporting.fit_json import fit_to_json
from motor_identification.reporting.fit_text import (
    FOLLOWS,
    NOT_WHITE,
    list_cautions,
    residual_follows_voltage,
)
from motor_identification.uncertainty.result import Fit
from motor_identification.uncertainty.whiteness import Series, analyse_whiteness, autocorrelation
from motor_model.parameters import PAPER_KA, PAPER_KV

COUNT, PERIOD = 2000, 0.005


def series(white: np.ndarray, seed: int = 0, runs: int = 1) -> Series:
    """Residuals beside a random telegraph voltage, in so many runs."""
    random = np.random.default_rng([seed, 1])
    fresh = np.zeros(len(white), dtype=bool)
    fresh[np.linspace(0, len(white), runs, endpoint=False).astype(int)] = True
    command_time = np.arange(0.0, len(white) * PERIOD, 0.1)
    command = np.where(random.random(len(command_time)) < 0.5, -4.0, 9.0)
    return Series(white, (np.arange(len(white)) + 0.5) * PERIOD, fresh, command_time, command, PERIOD)


def noise(seed: int, repeats: float = 0.0) -> np.ndarray:
    """Gaussian noise whose neighbours correlate by `repeats`."""
    fresh = np.random.default_rng(seed).standard_normal(COUNT)
    return np.asarray(lfilter([np.sqrt(1.0 - repeats**2)], [1.0, -repeats], fresh))


def test_chances_are_true_for_white_noise() -> None:
    """The portmanteau's p-values are uniform; Bonferroni's are rare, at most as rare as they say."""
    found = [analyse_whiteness((series(noise(seed), seed),)) for seed in range(200)]
    assert kstest([one.p_value for one in found], "uniform").pvalue > 0.01
    assert sum(one.input_p_value < 0.1 for one in found) < 30
    assert 0.02 < np.median([abs(one.autocorrelation) for one in found]) < 0.08


@pytest.mark.parametrize("repeats", [-0.6, 0.3, 0.9])
def test_repetition_is_seen_and_measured(repeats: float) -> None:
    found = analyse_whiteness((series(noise(1, repeats)),))
    assert found.p_value < 1e-6 and found.lag == 1
    assert found.autocorrelation == pytest.approx(repeats, abs=0.05)


def test_slow_noise_is_not_taken_for_a_trace_of_the_voltage() -> None:
    """Both are slow, so that they correlate by chance: much more than white noise would."""
    found = [analyse_whiteness((series(noise(seed, 0.97), seed),)) for seed in range(100)]
    assert max(abs(one.input_correlation) for one in found) > 0.2
    assert sum(one.input_p_value < 0.01 for one in found) <= 3


@pytest.mark.parametrize("face", [lambda u: u, np.abs, np.sign])
def test_a_trace_of_the_voltage_is_seen_with_its_lag(face: object) -> None:
    base = series(noise(2))
    index = np.searchsorted(base.command_time, base.time - 0.04, side="right") - 1
    trace = face(np.where(index >= 0, base.command[np.maximum(index, 0)], 0.0))  # type: ignore[operator]
    found = analyse_whiteness((replace(base, white=base.white + 0.3 * (trace - trace.mean()) / trace.std()),))
    assert found.input_p_value < 1e-6 and found.input_lag == 0.04
    assert 0.2 < abs(found.input_correlation) < 0.4


def test_pairs_do_not_reach_over_gaps() -> None:
    """Blocks that each repeat one value, with a gap after every second: within a run all alike, across none."""
    white = np.repeat(np.random.default_rng(3).standard_normal(COUNT // 2), 2)
    rho, pairs = autocorrelation((series(white, runs=COUNT // 2),), 3)
    assert rho[0] == pytest.approx(1.0, abs=1e-9) and list(pairs) == [COUNT // 2, 0, 0]
    joined, all_pairs = autocorrelation((series(white),), 3)
    assert 0.4 < joined[0] < 0.6 and list(all_pairs) == [COUNT - 1, COUNT - 2, COUNT - 3]
    halves = (series(white[: COUNT // 2]), series(white[COUNT // 2 :]))
    assert autocorrelation(halves, 3)[1][0] == COUNT - 2


def test_a_correlation_is_one_at_most() -> None:
    """Single residuals between gaps are small, and the pairs large: it is the pairs' own size that counts."""
    alone, alike = np.full(100, 0.1), np.full(100, 3.0)
    one = series(np.concatenate([alone, alike]))
    one.fresh[:101] = True  # the first hundred have no neighbour
    assert autocorrelation((one,), 2)[0] == pytest.approx([1.0, 1.0], abs=1e-12)
    assert autocorrelation((replace(one, white=one.white * np.tile([1.0, -1.0], 100)),), 2)[0][0] == pytest.approx(-1.0)


def test_too_little_says_nothing() -> None:
    nothing = analyse_whiteness((series(noise(4), runs=COUNT),))
    assert isnan(nothing.p_value) and isnan(nothing.input_correlation)
    dead = series(noise(4))
    found = analyse_whiteness((replace(dead, command=0.0 * dead.command),))
    assert isnan(found.input_p_value) and isnan(found.input_lag) and 0.0 < found.p_value < 1.0


def fitted(effects: tuple[str, ...], hidden: dict[str, float]) -> Fit:
    """A fit to a motor with friction and something more, on a staircase."""
    truth = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.4} | hidden
    recording = check(record(truth, *profiles.staircase(12.0, 4, 0.25), seed=1)[0])
    return identify([recording], Request(effects, SearchConfig(particles=30, epochs=60)))


MISSING = {
    "supply_sag": {"sag": 0.1},
    "quadratic_drag": {"drag": 1e-4},
    "direction_asymmetry": {"reverse_gain": 0.93},
    "load_bias": {"bias_voltage": 0.3},
}


@pytest.mark.parametrize("effect", keep_fast(MISSING, "quadratic_drag"))
def test_a_missing_effect_is_said_and_one_that_is_fitted_is_not(effect: str) -> None:
    wrong = fitted(("coulomb_friction",), MISSING[effect])
    assert wrong.whiteness.p_value < 1e-6 and wrong.whiteness.autocorrelation > 0.5
    left = wrong.whiteness
    said = {FOLLOWS.format(left.input_correlation), NOT_WHITE.format(left.autocorrelation)}
    assert said & set(list_cautions(wrong))
    right = fitted(("coulomb_friction", effect), MISSING[effect])
    assert right.whiteness.p_value > 1e-4 and abs(right.whiteness.autocorrelation) < 0.15
    assert not residual_follows_voltage(right) and list_cautions(right) == ()
    assert fit_to_json(right)["whiteness"]["p_value"] == right.whiteness.p_value


def test_what_follows_the_voltage_is_said_so() -> None:
    fit = fitted(("coulomb_friction",), MISSING["direction_asymmetry"])
    said = list_cautions(fit)
    assert residual_follows_voltage(fit) and FOLLOWS.format(fit.whiteness.input_correlation) in said
    assert NOT_WHITE.format(fit.whiteness.autocorrelation) not in said
    content = fit_to_json(fit)["input_correlation"]
    assert content["p_value"] < 1e-3 and 0.15 < abs(content["correlation"]) < 1.0
    assert not residual_follows_voltage(replace(fit, noise_floor=fit.residual_rms))
