"""White residuals of a recording over measured angles, from which initial speeds are projected out."""

from functools import cache
from math import tau

import numpy as np
import pytest
from plant import profiles, record
from small import TRUE

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.parameter_space import SLOW_SPEED
from motor_identification.estimation.problem import make_problem
from motor_identification.periodic.periodic_fit import measure_angles
from motor_identification.periodic.whitened_run import BLOCK_TURNS, WhitenedRun, whiten_runs
from motor_identification.recording import check


@cache
def whitened() -> tuple[WhitenedRun, Estimate]:
    """Of a motor without a ripple, over 35 turns each way."""
    drive = profiles.pieces([10.0, 0.0, -10.0, 0.0], 1.5)
    recording = check(record(TRUE, *drive, seed=1, irregularity=0.003, disc_seed=1)[0])
    problem = make_problem([recording], ("coulomb_friction",))
    estimate = fit_speeds(Estimate(problem, np.array([np.log(TRUE["kv"]), np.log(TRUE["ka"]), TRUE["ks"]])))
    (run,) = whiten_runs(estimate, measure_angles(estimate, problem.unknowns.effects))
    return run, estimate


def test_what_is_left_is_white() -> None:
    run, _ = whitened()
    order = run.course.order
    white = run.white[order][run.course.moving[order]]
    assert np.std(white) == pytest.approx(1.0, abs=0.1)
    assert abs(np.mean(white[1:] * white[:-1])) < 0.1


def test_initial_speeds_of_counted_runs_are_projected_out() -> None:
    run, _ = whitened()
    assert len(np.unique(run.course.run)) > 1
    for number in np.unique(run.course.run):
        here = run.course.run == number
        length = np.linalg.norm(run.transient[here])
        assert length == pytest.approx(1.0) or length == 0.0
        assert abs(run.transient[here] @ run.white[here]) < 1e-9 * np.linalg.norm(run.white)
    assert np.abs(run.project_out_transient(run.transient)).max() < 1e-9


def test_nothing_is_taken_near_a_standstill() -> None:
    run, estimate = whitened()
    (data,) = estimate.problem.intervals
    slow = np.abs(data.speed) < SLOW_SPEED * np.abs(data.speed).max()
    assert np.count_nonzero(slow) > 0 and len(run.white) == np.count_nonzero(~slow)


def test_products_are_those_of_whitened_responses() -> None:
    """Of two blocks, and as pulled back, which is how a spectrum has them."""
    run, _ = whitened()
    block = (np.arange(len(run.white)) % 2).astype(np.int64)
    parts = [run.project_out_transient(run.whiten(part)) for part in run.course.response(5.3)]
    sums = run.sum_products(5.3, block)
    for number in range(2):
        sine, cosine = (part[block == number] for part in parts)
        white = run.white[block == number]
        expected = [sine @ sine, sine @ cosine, cosine @ cosine, sine @ white, cosine @ white]
        assert sums[number] == pytest.approx(expected, rel=1e-9)
    pulled = run.pull_back()
    for part, column in zip(run.course.response(5.3), (3, 4), strict=True):
        assert pulled @ part == pytest.approx(sums[:, column].sum(), rel=1e-6)


def test_blocks_are_a_few_turns_of_one_counted_run() -> None:
    run, _ = whitened()
    blocks = run.number_blocks()
    longest = []
    for number in range(int(blocks.max()) + 1):
        here = blocks == number
        assert len(np.unique(run.course.run[here])) == 1
        assert np.ptp(run.course.start[here]) <= BLOCK_TURNS * tau
    for number in np.unique(run.course.run):
        ends = np.concatenate([run.course.start[run.course.run == number], run.course.end[run.course.run == number]])
        longest.append(np.ptp(ends) / tau)
    assert run.longest_turns() == pytest.approx(max(longest)) and run.longest_turns() > 2.0 * BLOCK_TURNS
