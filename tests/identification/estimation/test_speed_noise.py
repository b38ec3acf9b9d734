"""White noise that was assumed of speeds is at most what a fit leaves: slow rows differ by their motion."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from fits import quick
from plant import profiles, record
from recorded import as_speed, without_count

from motor_identification.diagnose import diagnose
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.speed_noise import LEAST_SHARE, learn_noise, measure_noise
from motor_identification.identify import identify
from motor_identification.recording import Recording, check
from motor_identification.sensor.white_noise import LEAST_SAMPLES
from motor_identification.uncertainty.result import Fit

ROW, TIME_CONSTANT, SIGMA = 0.05, 0.022, 0.1
MOTOR = {"kv": 0.06, "ka": 0.06 * TIME_CONSTANT, "ks": 0.11}


@cache
def tacho(delay: float = 0.015, seconds: float = 5.0, sigma: float = SIGMA) -> Recording:
    """Speeds [rad/s] of a motor of half a row, under a voltage that swings within a few rows."""
    time = ROW * np.arange(round(seconds / ROW))
    volts = sum(np.sin(2.0 * np.pi * time / period + period) for period in (0.5, 0.7, 1.3, 2.1))
    drive = profiles.pieces(volts, ROW)
    recording, truth = record(MOTOR | {"delay": delay}, *drive, sample_rate=1.0 / ROW, single_channel=False)
    logged = check(without_count(as_speed(recording)))
    turned = np.diff(truth.angle, prepend=truth.angle[0]) / ROW
    speed = turned + sigma * np.random.default_rng(0).standard_normal(len(turned))
    return replace(logged, speed=speed, info=replace(logged.info, source="bag"))


def fitted(effects: tuple[str, ...]) -> Estimate:
    problem = make_problem([tacho()], effects)
    theta = np.concatenate([np.log([MOTOR["kv"], MOTOR["ka"]]), [0.11, 0.015][: len(effects)]])
    return fit_speeds(Estimate(problem, theta))


@cache
def identified(delay: float) -> Fit:
    return identify([tacho(delay)], quick("coulomb_friction", "transport_delay"))


def test_a_model_that_leaves_less_than_was_assumed_tells_the_noise() -> None:
    whole, bare = fitted(("coulomb_friction", "transport_delay")), fitted(())
    (data,) = whole.problem.intervals
    assert data.has_assumed_noise and data.noise / data.window * np.sqrt(2.0) > 3.0 * SIGMA
    learned = learn_noise(whole)
    (again,) = learned.problem.intervals
    assert again.sigma == pytest.approx(SIGMA, rel=0.25) and again.learned == measure_noise(whole)
    assert again.assumed_blur == pytest.approx(data.blur) and learned.theta is whole.theta
    assert learn_noise(learned) is learned
    assert measure_noise(bare) > 2.0 * measure_noise(whole) > 2.0 * LEAST_SHARE
    more = learn_noise(bare.on(replace(bare.problem, intervals=(again,)))).problem.intervals[0]
    assert np.all(more.blur > 2.0 * again.blur) and np.all(more.blur <= data.blur)


def test_neither_of_counts_nor_of_few_speeds() -> None:
    estimate = fitted(("coulomb_friction", "transport_delay"))
    (data,) = estimate.problem.intervals
    counts = replace(data, independent=False)
    assert measure_noise(estimate.on(replace(estimate.problem, intervals=(counts,)))) == 1.0
    assert counts.with_noise(0.1) is counts
    short = estimate.problem.without((np.arange(len(data.first)) >= LEAST_SAMPLES + 3,))
    assert measure_noise(estimate.on(short)) == 1.0


def test_a_delay_is_not_absent_because_neighbours_differ_by_their_motion() -> None:
    """It was said to be absent, of a gain of 35 in log likelihood, and ka was off by 15 standard errors."""
    fit = identified(0.015)
    assert any("they have no more" in note for note in fit.notes)
    assert fit.absent == () and fit.noise_floor == pytest.approx(SIGMA, rel=0.25)
    for name, value in {"ka": MOTOR["ka"], "delay": 0.015}.items():
        error = fit.standard_errors[name]
        assert abs(fit.parameters.value(name) - value) < 4.0 * error < 0.4 * value


def test_a_delay_that_is_not_there_is_absent() -> None:
    assert identified(0.0).absent == ("transport_delay",)


@pytest.mark.parametrize(("delay", "named"), [(0.0, ()), (0.015, ("transport_delay",))])
def test_no_floor_that_is_the_motion_ends_a_search(delay: float, named: tuple[str, ...]) -> None:
    """What was found to be left was a third of "the floor", with the delay still in it."""
    found = diagnose([tacho(delay)])
    assert tuple(finding.effect for finding in found.findings) == ("coulomb_friction", *named)
    assert found.noise_floor == pytest.approx(SIGMA, rel=0.25) and found.gap_after < 1.2 * found.noise_floor
