"""The modes make data and prior diagonal at once, for seen entries only."""

import numpy as np
import pytest

from motor_identification.noise.slots.eigenmodes import STIFF, compute_eigenmodes

N = 6  # slots: 12 entries of the table


def gram_of(coupled: bool, seen: np.ndarray) -> np.ndarray:
    random = np.random.default_rng(3)
    a = random.standard_normal((40, 2 * N)) * seen
    if not coupled:
        a[:20, N:] = 0.0
        a[20:, :N] = 0.0
    return a.T @ a


def prior(first_harmonic: bool) -> np.ndarray:
    """Covariance over all entries, for unit variance."""
    phase = 2.0 * np.pi * np.arange(N) / N
    shapes = [np.full(N, 1.0 / np.sqrt(N))]
    if not first_harmonic:
        shapes += [np.sqrt(2.0 / N) * np.cos(phase), np.sqrt(2.0 / N) * np.sin(phase)]
    one = np.eye(N) + STIFF * sum(np.outer(shape, shape) for shape in shapes)
    return np.kron(np.eye(2), np.linalg.inv(one))


@pytest.mark.parametrize("coupled", [False, True])
@pytest.mark.parametrize("first_harmonic", [False, True])
@pytest.mark.parametrize("unseen", [(), (2,), (0, 7, 11)])
def test_they_solve_for_every_variance(unseen: tuple[int, ...], first_harmonic: bool, coupled: bool) -> None:
    seen = ~np.isin(np.arange(2 * N), unseen)
    gram = gram_of(coupled, seen)
    modes = compute_eigenmodes(gram, seen, first_harmonic)
    scores = np.random.default_rng(4).standard_normal(2 * N) * seen
    inside = np.ix_(seen, seen)
    for variance in (1e-3, 1.0, 1e3):
        found = modes.table(modes.coordinates(scores, variance))
        precision = np.linalg.inv(variance * prior(first_harmonic)[inside])
        expected = np.linalg.solve(gram[inside] + precision, scores[seen])
        assert found[seen] == pytest.approx(expected, rel=1e-5, abs=1e-8)
        assert not found[~seen].any()


def test_values_ascend_and_unseen_ones_know_nothing() -> None:
    seen = ~np.isin(np.arange(2 * N), [1, 8])
    modes = compute_eigenmodes(gram_of(False, seen), seen, True)
    assert np.all(np.diff(modes.values) >= 0.0) and np.count_nonzero(modes.values == 0.0) >= 2
    assert modes.spread.sum() == pytest.approx(np.trace(prior(True)[np.ix_(seen, seen)]), rel=1e-6)


@pytest.mark.parametrize(("first_harmonic", "allowed"), [(True, True), (False, False)])
def test_a_table_without_first_harmonic_does_not_take_it(first_harmonic: bool, allowed: bool) -> None:
    seen = np.ones(2 * N, dtype=bool)
    modes = compute_eigenmodes(np.eye(2 * N), seen, first_harmonic)
    wave = np.cos(2.0 * np.pi * np.arange(N) / N)
    pulled = modes.table(modes.coordinates(np.append(wave, np.zeros(N)), 1e3))
    assert (np.abs(pulled).max() > 0.5) == allowed
