"""The best path of slips is the best of all paths."""

from itertools import product

import numpy as np
import pytest

from motor_identification.noise.viterbi import fill_path


def brute(scores: np.ndarray, price: float) -> tuple[float, tuple[int, ...]]:
    """The best of every path that begins in the middle."""
    runs, width = scores.shape
    best = (-np.inf, ())
    for path in product(range(-(width // 2), width // 2 + 1), repeat=runs):
        moves = np.abs(np.diff((0, *path)))
        value = sum(scores[b, slip + width // 2] for b, slip in enumerate(path)) - price * moves.sum()
        best = max(best, (float(value), path))
    return best  # type: ignore[return-value]


@pytest.mark.parametrize("price", [0.0, 0.3, 1.0, 10.0])
@pytest.mark.parametrize("seed", range(4))
def test_no_other_path_scores_more(seed: int, price: float) -> None:
    scores = np.random.default_rng(seed).normal(0.0, 1.0, (4, 5))
    slips = np.zeros(4, dtype=np.int64)
    found = fill_path(scores, price, slips)
    value, path = brute(scores, price)
    assert found == pytest.approx(value) and tuple(slips) == path


@pytest.mark.parametrize(("price", "slip"), [(0.9, 2), (1.1, 0)])
def test_a_slip_has_to_be_worth_its_steps(price: float, slip: int) -> None:
    scores = np.zeros((3, 7))
    scores[0, 3] = 0.1
    scores[1:, 3 + 2] = 1.0  # two runs gain 1 each by a slip of two steps, which costs twice the price
    slips = np.zeros(3, dtype=np.int64)
    fill_path(scores, price, slips)
    assert slips.tolist() == [0, slip, slip]
