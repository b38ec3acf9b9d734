"""Conjugate gradients give the table that eigenmodes give, and as many products as it takes, not more."""

from dataclasses import replace

import numpy as np
import pytest
from plant import profiles, record

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.whitened_fit import learn_encoders
from motor_identification.identify import Request, identify
from motor_identification.noise.angle_noise import whiten
from motor_identification.noise.slots import slot_table
from motor_identification.noise.slots.conjugate_gradient import MOST_PRODUCTS, TOLERANCE, IterativeSolver, fill_solution
from motor_identification.noise.slots.eigenmodes import Modes
from motor_identification.noise.slots.slot_table import Projection, SlotTable, estimate_slot_variance
from motor_identification.recording import Floats, check
from motor_model.parameters import PAPER_KA, PAPER_KV

TRUE = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.4}
THETA = np.array([np.log(PAPER_KV), np.log(PAPER_KA), 0.4])
EDGES = 150  # a table of 300 entries, which eigenmodes still solve


@pytest.fixture(scope="module")
def learned() -> tuple[SlotTable, Floats, float]:
    """The table of a disc with many slots at the true motor, its white residuals, and the variance [rad²]."""
    recording, _ = record(TRUE, *profiles.staircase(), irregularity=0.01, edges=EDGES, disc_seed=4)
    problem = make_problem([check(recording)], ("coulomb_friction",))
    estimate = Estimate(problem, THETA)
    (encoder,) = learn_encoders(estimate)
    assert encoder.projection is not None
    (increments,) = estimate.increments
    return encoder.projection.table, whiten(encoder.whitening, increments), encoder.projection.variance


def iterative(table: SlotTable, monkeypatch: pytest.MonkeyPatch) -> SlotTable:
    """The same table, solved by conjugate gradients."""
    monkeypatch.setattr(slot_table, "MOST_MODES", 2 * EDGES - 1)
    same = replace(table)
    assert isinstance(same.solver, IterativeSolver)
    return same


@pytest.mark.parametrize("first_harmonic", [False, True])
@pytest.mark.parametrize("share", [0.01, 1.0, 100.0])
def test_the_table_is_that_of_eigenmodes(
    learned: tuple[SlotTable, Floats, float], first_harmonic: bool, share: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    table, white, variance = learned
    exact = replace(table, first_harmonic=first_harmonic)
    assert exact.index.size == 2 * EDGES and isinstance(exact.solver, Modes)
    expected = Projection(exact, share * variance)
    found = Projection(iterative(exact, monkeypatch), share * variance)
    best = expected.best(white)
    assert np.std(found.best(white) - best) < 3e-3 * np.std(best)
    cost = np.sum(expected(white) ** 2)
    assert np.sum(found(white) ** 2) == pytest.approx(cost, rel=1e-5 if share > 1.0 else 1e-7)
    assert cost < 0.9 * np.sum(white**2)


def test_the_variance_is_that_of_eigenmodes(
    learned: tuple[SlotTable, Floats, float], monkeypatch: pytest.MonkeyPatch
) -> None:
    table, white, variance = learned
    exact, found = (
        estimate_slot_variance(one, white, 0.1 * variance, 1.0, 100) for one in (table, iterative(table, monkeypatch))
    )
    assert found == pytest.approx(exact, rel=0.01)
    assert exact == pytest.approx(variance, rel=0.01)


def test_a_solution_is_as_near_as_was_asked_for_and_a_good_guess_takes_no_product_more(
    learned: tuple[SlotTable, Floats, float], monkeypatch: pytest.MonkeyPatch
) -> None:
    table, white, variance = learned
    solver = iterative(table, monkeypatch).solver
    assert isinstance(solver, IterativeSolver)
    right = table.scores(white)

    def solve(solution: Floats, tolerance: float) -> int:
        return fill_solution(
            *solver.filter, solver.root, solver.diagonal, 1.0 / variance, right, tolerance, MOST_PRODUCTS, solution
        )

    coarse, fine = np.zeros(len(right)), np.zeros(len(right))
    assert 1 < solve(coarse, 1e-2) < solve(fine, 1e-12) < MOST_PRODUCTS
    off = np.linalg.norm(coarse - fine) / np.linalg.norm(fine)
    assert 1e-6 < off < 0.3
    assert solve(fine, TOLERANCE) == 1


def test_a_fine_encoder_tells_no_less_than_a_coarse_one() -> None:
    """2,880 edges: standard errors within those of 96, and the truth within four of them."""
    errors = {}
    for edges in (96, 2880):
        recording, _ = record(TRUE, *profiles.staircase(), irregularity=0.005, edges=edges, disc_seed=4)
        fit = identify([check(recording)], Request(("coulomb_friction",)))
        errors[edges] = fit.standard_errors
        for name, true in TRUE.items():
            assert abs(fit.parameters.value(name) - true) < 4.0 * fit.standard_errors[name]
    for name in TRUE:
        assert 0.1 * errors[96][name] < errors[2880][name] < 2.0 * errors[96][name]
