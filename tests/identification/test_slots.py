"""Irregular slots: the table is found through reversals, and with it the motor as if the disc were perfect."""

import numpy as np
import pytest
from plant import profiles, record
from plant.encoder import Disc

from motor_identification.identify import Request, identify
from motor_identification.intervals import joined
from motor_identification.noise import whiten
from motor_identification.problem import Problem, make_problem
from motor_identification.recording import check
from motor_identification.refine import Encoder, learn
from motor_model.parameters import PAPER_KA, PAPER_KV

TRUE = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.4}
PLACE = np.array([np.log(PAPER_KV), np.log(PAPER_KA), 0.4])


def problem(seed: int, irregularity: float) -> tuple[Problem, Disc]:
    recording, truth = record(TRUE, *profiles.staircase(), irregularity=irregularity, seed=seed, disc_seed=seed)
    return make_problem([check(recording)], ("coulomb_friction",)), truth.disc


def learned(task: Problem) -> tuple[Encoder, np.ndarray]:
    """The encoder as learned at the true motor, and its table [rad]."""
    (encoder,) = learn(task, PLACE)
    (data,) = task.intervals
    assert encoder.projection is not None
    return encoder, encoder.projection.best(whiten(encoder.whitening, task.residuals(PLACE) * data.duration))


@pytest.mark.parametrize("seed", range(4))
def test_the_table_of_both_directions_is_recovered(seed: int) -> None:
    task, disc = problem(seed, 0.01)
    encoder, table = learned(task)
    assert 0.008 < encoder.irregularity < 0.012
    assert encoder.growth == 0.0
    n = len(table) // 2
    slot = 2.0 * np.pi / n
    for half, flanks in ((table[:n], disc.begin), (table[n:], disc.end - 0.5)):
        offsets = slot * flanks
        error = min(np.std(np.roll(half, k) - offsets) for k in range(n))  # the table starts anywhere on the disc
        assert error < 0.05 * np.std(offsets)


def test_a_perfect_disc_has_no_table() -> None:
    encoder, table = learned(problem(0, 0.0)[0])
    assert encoder.irregularity < 5e-4
    assert np.abs(table).max() < 2e-3 * encoder.slot


@pytest.mark.parametrize("irregularity", [0.0, 0.01])
def test_residuals_of_the_truth_are_white(irregularity: float) -> None:
    task, _ = problem(5, irregularity)
    (encoder,) = learn(task, PLACE)
    (data,) = task.intervals
    white = encoder.white(task.residuals(PLACE) * data.duration)[: len(data.first)][data.slack == 0.0]
    assert 0.85 < np.sqrt(np.mean(white**2)) < 1.1
    assert abs(np.corrcoef(white[1:], white[:-1])[0, 1]) < 0.1


def test_irregular_slots_cost_little_accuracy() -> None:
    """RMS errors over seeds: with 1 % irregular slots at most twice those of a perfect disc, and parts per million."""
    errors = {}
    for irregularity in (0.0, 0.01):
        rows = []
        for seed in range(8):
            recording, _ = record(TRUE, *profiles.staircase(), irregularity=irregularity, seed=seed, disc_seed=seed)
            fit = identify([check(recording)], Request(("coulomb_friction",), particles=16))
            rows.append([fit.parameters.value(name) / true - 1.0 for name, true in TRUE.items()])
        errors[irregularity] = np.sqrt(np.mean(np.square(rows), axis=0))
    assert np.all(errors[0.01] < [1e-6, 4e-6, 1e-5])
    assert np.all(errors[0.0] > 1e-9)
    assert np.all(errors[0.01] < 3.0 * errors[0.0])


def test_joined_intervals_keep_travel_time_and_edges() -> None:
    task, _ = problem(1, 0.0)
    (data,) = task.intervals
    coarse = joined(data, 0.02)
    assert 3 * len(coarse.first) < len(data.first)
    assert np.sum(coarse.speed * coarse.duration) == pytest.approx(np.sum(data.speed * data.duration), rel=1e-12)
    assert coarse.duration.sum() == pytest.approx(data.duration.sum(), rel=1e-12)
    moving = coarse.slack == 0.0
    steps = (coarse.edge[:, 1] - coarse.edge[:, 0])[moving]
    assert np.allclose(np.abs(coarse.speed * coarse.duration)[moving], steps * data.slot)
    assert np.median(coarse.duration) >= 0.02
