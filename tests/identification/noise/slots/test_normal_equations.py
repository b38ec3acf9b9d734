"""Sums over intervals are the products of the whitened table's columns, written out."""

import numpy as np
import pytest

from motor_identification.noise.angle_noise import AngleNoise, make_whitening, whiten
from motor_identification.noise.slots.normal_equations import fill_explained, fill_foresight, fill_gram, fill_scores

COUNT, SIZE = 12, 5
FRESH = np.isin(np.arange(COUNT), [0, 5, 9])
FIRST = np.array([0, 1, 2, 3, 4, 2, 3, 4, 0, -1, 1, 2])
LAST = np.array([1, 2, 3, 4, 0, 3, 4, 0, 1, 1, 2, -1])


@pytest.fixture(params=[0.0, 0.01, 1e4])
def whitening(request: pytest.FixtureRequest):  # type: ignore[no-untyped-def]
    random = np.random.default_rng(1)
    noise = AngleNoise(FRESH, *random.uniform(0.5, 2.0, (2, COUNT)), random.uniform(0.1, 1.0, COUNT))
    return make_whitening(noise, request.param)


def columns(whitening) -> np.ndarray:  # type: ignore[no-untyped-def]
    """A: what each entry of the table makes of the white residuals, ends that are no edge in the last column."""
    made = []
    for entry in range(SIZE + 1):
        unit = np.zeros(SIZE + 1)
        unit[entry] = 1.0
        made.append(whiten(whitening, unit[LAST] - unit[FIRST]))
    return np.column_stack(made)


def test_the_gram_matrix(whitening) -> None:  # type: ignore[no-untyped-def]
    half = np.zeros((SIZE + 1, SIZE + 1))
    fill_gram(whitening.fresh, whitening.gain, whitening.scale, FIRST, LAST, half)
    a = columns(whitening)
    assert (half + half.T)[:SIZE, :SIZE] == pytest.approx((a.T @ a)[:SIZE, :SIZE], rel=1e-9, abs=1e-9)


def test_the_scores_and_what_a_table_explains(whitening) -> None:  # type: ignore[no-untyped-def]
    a, white = columns(whitening), np.random.default_rng(2).normal(size=COUNT)
    sums = np.zeros(SIZE + 1)
    fill_scores(whitening.fresh, whitening.gain, whitening.scale, FIRST, LAST, white, sums)
    assert sums[:SIZE] == pytest.approx((a.T @ white)[:SIZE], rel=1e-9)
    table = np.append(np.arange(1.0, SIZE + 1), 0.0)
    left = white.copy()
    fill_explained(whitening.fresh, whitening.gain, whitening.scale, FIRST, LAST, table, left)
    assert left == pytest.approx(white - a @ table, rel=1e-9, abs=1e-9)


def test_foresight_ends_with_a_run(whitening) -> None:  # type: ignore[no-untyped-def]
    foresight = np.empty(COUNT)
    fill_foresight(whitening.fresh, whitening.gain, whitening.scale, foresight)
    ends = [4, 8, COUNT - 1]
    assert np.all(foresight[ends] == 0.0) and np.all(np.delete(foresight, ends) > 0.0)
    assert foresight[3] == pytest.approx(whitening.scale[4] ** 2)
