"""Irregular slots: the table is found through reversals, and with it the motor as if the disc were perfect."""

from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from plant import profiles, record
from plant.encoder import Disc

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.problem import Problem, make_problem
from motor_identification.estimation.whitened_fit import learn_encoders
from motor_identification.identify import Request, SearchConfig, identify
from motor_identification.measurement.edit_intervals import join_intervals
from motor_identification.noise.angle_noise import AngleNoise, make_whitening, whiten
from motor_identification.noise.encoder import Encoder
from motor_identification.noise.slots.eigenmodes import STIFF
from motor_identification.noise.slots.slot_table import Projection, SlotIndex, SlotTable, estimate_slot_variance
from motor_identification.recording import check, recording_of
from motor_model.parameters import PAPER_KA, PAPER_KV, paper_motor
from motor_model.sensing.board import BoardConfig, SimulatedBoard

TRUE = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.4}
THETA = np.array([np.log(PAPER_KV), np.log(PAPER_KA), 0.4])


def problem(seed: int, irregularity: float) -> tuple[Problem, Disc]:
    recording, truth = record(TRUE, *profiles.staircase(), irregularity=irregularity, seed=seed, disc_seed=seed)
    return make_problem([check(recording)], ("coulomb_friction",)), truth.disc


def learned(task: Problem) -> tuple[Encoder, np.ndarray]:
    """The encoder as learned at the true motor, and its table [rad]."""
    (encoder,) = learn_encoders(Estimate(task, THETA))
    (data,) = task.intervals
    assert encoder.projection is not None
    return encoder, encoder.projection.best(whiten(encoder.whitening, task.residuals(THETA) * data.duration))


@pytest.mark.parametrize("seed", range(4))
def test_the_table_of_both_directions_is_recovered(seed: int) -> None:
    task, disc = problem(seed, 0.01)
    encoder, table = learned(task)
    assert 0.008 < encoder.irregularity < 0.012
    assert encoder.drift == 0.0
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
    (encoder,) = learn_encoders(Estimate(task, THETA))
    (data,) = task.intervals
    white = encoder.white(task.residuals(THETA) * data.duration)[: len(data.first)][data.slack == 0.0]
    assert 0.85 < np.sqrt(np.mean(white**2)) < 1.1
    assert abs(np.corrcoef(white[1:], white[:-1])[0, 1]) < 0.1


@pytest.mark.slow
def test_irregular_slots_cost_little_accuracy() -> None:
    """RMS errors over seeds: with 1 % irregular slots at most twice those of a perfect disc, and parts per million."""
    errors = {}
    for irregularity in (0.0, 0.01):
        rows = []
        for seed in range(8):
            recording, _ = record(TRUE, *profiles.staircase(), irregularity=irregularity, seed=seed, disc_seed=seed)
            fit = identify([check(recording)], Request(("coulomb_friction",), SearchConfig(particles=16)))
            rows.append([fit.parameters.value(name) / true - 1.0 for name, true in TRUE.items()])
        errors[irregularity] = np.sqrt(np.mean(np.square(rows), axis=0))
    assert np.all(errors[0.01] < [1e-6, 4e-6, 1e-5])
    assert np.all(errors[0.0] > 1e-9)
    assert np.all(errors[0.01] < 3.0 * errors[0.0])


def test_joined_intervals_keep_travel_time_and_edges() -> None:
    task, _ = problem(1, 0.0)
    (data,) = task.intervals
    coarse = join_intervals(data, 0.02)
    assert 3 * len(coarse.first) < len(data.first)
    assert np.sum(coarse.speed * coarse.duration) == pytest.approx(np.sum(data.speed * data.duration), rel=1e-12)
    assert coarse.duration.sum() == pytest.approx(data.duration.sum(), rel=1e-12)
    moving = coarse.slack == 0.0
    steps = (coarse.edge[:, 1] - coarse.edge[:, 0])[moving]
    assert np.allclose(np.abs(coarse.speed * coarse.duration)[moving], steps * data.slot)
    assert np.median(coarse.duration) >= 0.02


SLOTS = 7  # of the small disc below
SIGMA = 0.02  # [rad] of its flanks


def small_table(growth: float, first_harmonic: bool, renumbered: bool = False) -> tuple[SlotTable, np.ndarray]:
    """A made-up recording in several runs, one flank of either direction never seen; and A, column by column."""
    random = np.random.default_rng(3)
    count = 90
    fresh = np.isin(np.arange(count), [0, 1, 20, 47, 50, 88])
    first, last = np.empty(count, dtype=np.int64), np.empty(count, dtype=np.int64)
    for k in range(count):
        base = SLOTS if 20 <= k < 50 else 0
        begins = base + random.integers(SLOTS - 1) if fresh[k] or (renumbered and k == 30) else last[k - 1]
        first[k], last[k] = begins, base + random.integers(SLOTS - 1)
    first[1] = last[1] = -1  # a standstill between runs
    first[88], last[88] = last[88], -1
    fresh[89] = True
    noise = AngleNoise(fresh, *random.uniform(1e-3, 1e-2, (2, count)) ** 2, random.uniform(1e-3, 1e-2, count))
    table = SlotTable(make_whitening(noise, growth), SlotIndex(first, last, 2 * SLOTS), first_harmonic)
    columns = [whiten(table.whitening, table.index.increments(unit)) for unit in np.eye(2 * SLOTS)]
    return table, np.column_stack(columns)


def small_prior(first_harmonic: bool) -> np.ndarray:
    """The table's covariance for unit variance, over all flanks, seen or not."""
    phase = 2.0 * np.pi * np.arange(SLOTS) / SLOTS
    waves = [np.ones(SLOTS) / np.sqrt(SLOTS)]
    if not first_harmonic:
        waves += [np.sqrt(2.0 / SLOTS) * wave(phase) for wave in (np.cos, np.sin)]
    one = np.eye(SLOTS) + STIFF * sum(np.outer(wave, wave) for wave in waves)
    return np.linalg.inv(np.kron(np.eye(2), one))


@pytest.mark.parametrize("renumbered", [False, True])
@pytest.mark.parametrize("growth", [0.0, 1e-4, 1e-2, 1e6])
def test_one_pass_gives_the_product_of_all_columns(growth: float, renumbered: bool) -> None:
    table, columns = small_table(growth, True, renumbered)
    product = columns.T @ columns
    assert np.abs(table.gram - product).max() < 1e-12 * np.abs(product).max()
    assert np.count_nonzero(product) > SLOTS**2  # many a pair of flanks shares a run
    white = np.random.default_rng(4).normal(size=len(columns))
    assert table.scores(white) == pytest.approx(columns.T @ white, rel=1e-12)
    guess = np.arange(2.0 * SLOTS)
    assert table.left(white, guess) == pytest.approx(white - columns @ guess, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("first_harmonic", [False, True])
@pytest.mark.parametrize("growth", [0.0, 1e-2])
def test_the_projection_leaves_what_a_table_of_that_prior_makes_improbable(growth: float, first_harmonic: bool) -> None:
    """The sum of squares left is zᵀ(I + σ²·A·C·Aᵀ)⁻¹z, the table's marginal likelihood, C the prior of all flanks."""
    table, columns = small_table(growth, first_harmonic)
    covariance = SIGMA**2 * small_prior(first_harmonic)
    random = np.random.default_rng(5)
    white = random.normal(size=len(columns)) + columns @ random.normal(size=2 * SLOTS) * SIGMA
    projection = Projection(table, SIGMA**2)
    inverse = np.linalg.inv(np.eye(len(columns)) + columns @ covariance @ columns.T)
    assert np.sum(projection(white) ** 2) == pytest.approx(white @ inverse @ white, rel=1e-9)
    assert 0.005 * (white @ white) < white @ inverse @ white < 0.95 * (white @ white)
    expected = covariance @ columns.T @ inverse @ white
    seen = table.seen > 0
    assert list(np.flatnonzero(~seen)) == [SLOTS - 1, 2 * SLOTS - 1]
    assert projection.best(white)[seen] == pytest.approx(expected[seen], rel=1e-7, abs=1e-9 * SIGMA)
    assert not projection.best(white)[~seen].any()


def test_the_flanks_variance_is_that_of_expectation_maximisation() -> None:
    table, columns = small_table(1e-2, False)
    white = columns @ np.random.default_rng(6).normal(size=2 * SLOTS) * SIGMA
    seen = table.seen > 0
    variance = 0.1 * SIGMA**2
    for _ in range(6):
        covariance = np.linalg.inv(columns.T @ columns + np.linalg.inv(small_prior(False)) / variance)
        mean = covariance @ columns.T @ white
        variance = float(np.mean((mean**2 + np.diag(covariance))[seen]))
    assert estimate_slot_variance(table, white, 0.1 * SIGMA**2, 1.0, 6) == pytest.approx(variance, rel=1e-9)
    assert 0.1 * SIGMA**2 < variance < 4.0 * SIGMA**2
    assert estimate_slot_variance(table, white, 0.1 * SIGMA**2, 0.5 * variance, 6) == 0.5 * variance


def test_where_no_flank_is_seen_the_guess_is_all_there_is() -> None:
    """As in a phase that is tried on a few edges of which none follow each other."""
    table = cast(SlotTable, SimpleNamespace(seen=np.zeros(2 * SLOTS)))
    assert estimate_slot_variance(table, np.zeros(5), 3e-6, 1.0, 40) == 3e-6


def test_a_disc_of_a_thousand_slots_in_a_second_that_shows_a_third_of_them() -> None:
    config = BoardConfig(edges_per_revolution=1000, slot_irregularity=0.01, seed=2)
    board = SimulatedBoard(paper_motor(), config)
    samples = [board.sample(0.0 if k < 20 else 2.0) for k in range(220)]
    fit = identify(
        [check(recording_of(samples, config.info(paper_motor()), "step"))], Request(search=SearchConfig(particles=16))
    )
    assert 0.008 < fit.slot_irregularity[0] < 0.012
    for name, true, least, most in (("kv", PAPER_KV, 3e-7, 1e-6), ("ka", PAPER_KA, 3e-6, 1e-5)):
        relative = fit.standard_errors[name] / true
        assert least < relative < most
        assert abs(fit.parameters.value(name) / true - 1.0) < 4.0 * relative


@pytest.mark.parametrize(("slots", "first_harmonic"), [(1, True), (1, False), (2, False), (3, False)])
def test_a_disc_of_so_few_slots_that_none_may_be_off_leaves_the_guess(slots: int, first_harmonic: bool) -> None:
    """Its mean is the starting angle, its first harmonic an eccentricity: a variance of 0 would be divided by."""
    count = 40
    at = np.arange(count + 1) % slots
    noise = AngleNoise(np.arange(count) == 0, *np.full((2, count), 1e-4), np.full(count, 1e-2))
    table = SlotTable(make_whitening(noise, 0.0), SlotIndex(at[:-1], at[1:], 2 * slots), first_harmonic)
    white = np.random.default_rng(slots).normal(size=count)
    assert estimate_slot_variance(table, white, 1e-4, 1e-2, 40) == 1e-4
    assert np.abs(Projection(table, 1e-4).best(white)).max() < 1e-6
