"""Steps of the load beside a random torque: found where they are, as likely as the simulated motion says."""

from functools import cache

import numpy as np
import pytest
from plant import profiles, record

from motor_identification.diagnosis.candidate_model import learn_errors
from motor_identification.diagnosis.fits.disturbed_fit import fit_beside_torque, make_disturbed_residuals
from motor_identification.diagnosis.fits.effect_fit import drop_effect, fit_with_effect, place_instants
from motor_identification.diagnosis.fits.torque_jumps import Jumps, list_likely_jumps, scan_jumps
from motor_identification.estimation.direction_correction import correct_directions
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.parameter_space import map_theta
from motor_identification.estimation.problem import make_problem
from motor_identification.recording import check
from motor_model.parameters import PAPER_KA, PAPER_KV

LAG = PAPER_KA / PAPER_KV
STEP, INSTANT = 0.3, 7.316  # [V], [s]


@cache
def fitted(step: float) -> Estimate:
    """A motor that lacks a load step, beside a torque that is slower than the motor."""
    torque = {"random_torque": 0.1, "random_torque_time": 1.0, "random_torque_seed": 3}
    values = {"kv": PAPER_KV, "ka": PAPER_KA, "step_voltage": step, "step_time": INSTANT}
    recording = check(record(values | torque, *profiles.compact(12.0, 5), seed=5)[0])
    start = Estimate(make_problem([recording], ()), np.log([PAPER_KV, PAPER_KA]))
    plain = fit_speeds(correct_directions(fit_speeds(start)))
    return fit_beside_torque(plain, learn_errors(plain))


def with_step(estimate: Estimate, volts: float, time: float) -> Estimate:
    """The same motor with a load step."""
    larger = estimate.problem.with_effects(("load_step",))
    values = {"step_voltage": np.array(volts), "step_time": np.array(time)}
    return Estimate(larger, map_theta(estimate.problem.unknowns, estimate.theta, larger.unknowns, values))


def scan(estimate: Estimate) -> Jumps:
    """Scan its one recording."""
    (whitening,) = make_disturbed_residuals(estimate, learn_errors(estimate)).filters
    (data,) = estimate.problem.intervals
    white = whitening.white(estimate.increments[0])
    kv = float(estimate.parameters.values["kv"])
    return scan_jumps(whitening, white, data.time[data.first], data.time[data.last], estimate.lag.rate, kv)


def test_a_step_is_found_where_it_is_and_of_its_size() -> None:
    jumps, errors = scan(fitted(STEP)), learn_errors(fitted(STEP))
    (best, second) = jumps.list_best(2, LAG)
    assert abs(jumps.time[best] - INSTANT) < 0.2 * LAG
    assert jumps.size[best] == pytest.approx(STEP, rel=0.4)
    assert jumps.gain[best] > 25.0 > 2.0 * jumps.gain[second]
    ((volts, times),) = list_likely_jumps(fitted(STEP), errors, 1)
    assert (volts, times) == (jumps.size[best], [jumps.time[best]])


def test_no_step_is_likely_where_there_is_none() -> None:
    assert 0.0 < scan(fitted(0.0)).gain.max() < 10.0


@pytest.mark.parametrize("lags", [0.0, 0.3, -40.0])
def test_the_gain_is_that_of_the_simulated_motion(lags: float) -> None:
    """To first order: half of what the sum of squares falls by, when a small step of the likeliest size comes in."""
    estimate = fitted(STEP)
    jumps = scan(estimate)
    number = int(np.argmin(np.abs(jumps.time - INSTANT - lags * LAG)))
    target = make_disturbed_residuals(estimate, learn_errors(estimate))
    before, small = target.residuals(estimate.theta), 0.01
    stepped = with_step(estimate, small, float(jumps.time[number]))
    answer = type(target)(stepped.problem, target.filters).residuals(stepped.theta) - before
    along, power = -float(before @ answer) / small, float(answer @ answer) / small**2
    assert jumps.size[number] == pytest.approx(along / power, rel=0.05, abs=0.002)
    assert jumps.gain[number] == pytest.approx(0.5 * along**2 / power, rel=0.1, abs=0.1)


def test_a_fit_beside_a_torque_finds_the_instant_that_no_grid_does() -> None:
    estimate, errors = fitted(STEP), learn_errors(fitted(STEP))
    found = fit_with_effect(estimate, "load_step", errors=errors)
    assert found is not None and abs(found.parameters.value("step_time") - INSTANT) < 0.05 * LAG
    assert found.parameters.value("step_voltage") == pytest.approx(STEP, rel=0.3)


def test_an_instant_that_is_elsewhere_is_placed_again_and_a_good_one_stays() -> None:
    estimate, errors = fitted(STEP), learn_errors(fitted(STEP))
    astray = fit_beside_torque(with_step(estimate, STEP, INSTANT + 10.0 * LAG), errors)
    assert abs(astray.parameters.value("step_time") - INSTANT) > LAG  # no descent leads there
    placed = place_instants(astray, errors)
    assert abs(placed.parameters.value("step_time") - INSTANT) < 0.05 * LAG
    assert place_instants(estimate, errors) is estimate  # nothing that begins
    assert drop_effect(placed, "load_step").problem.unknowns.names == estimate.problem.unknowns.names


def test_the_best_are_apart_and_like_ones_have_the_same_sign() -> None:
    jumps = Jumps(np.arange(5.0), np.array([1.0, 5.0, 9.0, 8.0, 7.0]), np.array([1.0, -1.0, 2.0, 2.0, -2.0]))
    assert jumps.list_best(9, 1.5) == [2, 4, 0] and jumps.list_best(2, 0.5) == [2, 3]
    assert (jumps.find_like(0.1), jumps.find_like(-3.0)) == (2.0, 4.0)
    nothing = Jumps(*np.zeros((3, 0)))
    assert nothing.list_best(3, 1.0) == [] and nothing.find_like(1.0) == 0.0
