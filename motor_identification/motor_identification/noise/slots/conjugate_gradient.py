"""Solve for a slot table by conjugate gradients: many slots cost what their visits cost, not their number cubed.

The most likely table is R·y with (R·AᵀA·R + 1/σ²)·y = R·Aᵀz, where R² is the prior's covariance for unit variance
(`eigenmodes.py`), so that all entries of y are alike. AᵀA is never written down: its product with a table is two
passes over the intervals (`normal_equations.py`). It is diagonal but for what runs of intervals share, and where
entries are many each has little part in that: preconditioned by its diagonal (M. Hestenes, E. Stiefel, J. Res. Nat.
Bur. Standards 49, 1952), some ten products give all digits that a fit uses.
"""

from dataclasses import dataclass, replace

import numpy as np

from motor_identification.noise.slots.normal_equations import fill_explained, fill_scores
from motor_identification.recording import Bools, Floats, Integers
from motor_model.compiled import compiled

TOLERANCE = 1e-6  # of the right-hand side, as the preconditioner weighs it: the cost is off by about its square
MOST_PRODUCTS = 400  # with AᵀA

Filter = tuple[Bools, Floats, Floats, Integers, Integers]


@compiled
def reduce_by(root: Floats, column: Floats) -> None:
    """Multiply a column (2N,) by R = I − UᵀU in place; U (C, 2N) is `root`."""
    for c in range(len(root)):
        part = np.dot(root[c], column)
        for i in range(len(column)):
            column[i] -= root[c, i] * part


@compiled
def multiply(
    fresh: Bools, gain: Floats, scale: Floats, first: Integers, last: Integers,
    root: Floats, precision: float, direction: Floats, table: Floats, white: Floats, product: Floats,
) -> None:  # fmt: skip
    """Fill (R·AᵀA·R + precision)·direction into `product`; the others, (2N + 1,) and (I,), are room to work in.

    The last entry of `table` and `product` belongs to ends that are no edge.
    """
    n = len(direction)
    table[:n] = direction
    reduce_by(root, table[:n])
    white[:] = 0.0
    fill_explained(fresh, gain, scale, first, last, table, white)  # −A·table
    product[:] = 0.0
    fill_scores(fresh, gain, scale, first, last, white, product)
    reduce_by(root, product[:n])
    for i in range(n):
        product[i] = precision * direction[i] - product[i]


@compiled
def fill_solution(
    fresh: Bools, gain: Floats, scale: Floats, first: Integers, last: Integers,
    root: Floats, diagonal: Floats, precision: float, right: Floats, tolerance: float, most: int, solution: Floats,
) -> int:  # fmt: skip
    """Improve a solution (2N,) of (R·AᵀA·R + precision)·y = right until what is left of `right` is small beside it.

    diagonal: about that of AᵀA, for the preconditioner. Returns the number of products that it took.
    """
    n = len(right)
    table, product, white = np.zeros(n + 1), np.zeros(n + 1), np.zeros(len(fresh))
    multiply(fresh, gain, scale, first, last, root, precision, solution, table, white, product)
    left = right - product[:n]
    direction, eased, before = np.zeros(n), np.zeros(n), np.inf
    enough = 0.0
    for i in range(n):
        enough += tolerance**2 * right[i] ** 2 / (diagonal[i] + precision)
    for count in range(1, most):
        for i in range(n):
            eased[i] = left[i] / (diagonal[i] + precision)
        size = np.dot(left, eased)
        if size <= enough:
            return count
        for i in range(n):
            direction[i] = eased[i] + size / before * direction[i]
        before = size
        multiply(fresh, gain, scale, first, last, root, precision, direction, table, white, product)
        step = size / np.dot(direction, product[:n])
        for i in range(n):
            solution[i] += step * direction[i]
            left[i] -= step * product[i]
    return most


@dataclass(frozen=True)
class IterativeSolver:
    """Solves for the coordinates y of a table with 2N entries, whatever the prior's variance."""

    filter: Filter
    root: Floats  # U (C, 2N), see `eigenmodes.py`
    diagonal: Floats  # (2N,) [1/rad²] about what the recording knows of each entry
    seen: Bools  # (2N,)
    tolerance: float = TOLERANCE

    def within(self, tolerance: float) -> "IterativeSolver":
        """Solve up to a tolerance, a share of the right-hand side."""
        return replace(self, tolerance=tolerance)

    def coordinates(self, scores: Floats, variance: float, guess: Floats | None = None) -> Floats:
        """Compute y (2N,) from Aᵀz (2N,), from a guess on, such as the solution for another variance [rad²]."""
        solution = np.zeros(len(scores)) if guess is None else guess.copy()
        right = np.array(scores)
        reduce_by(self.root, right)
        precision, how = 1.0 / variance, (self.tolerance, MOST_PRODUCTS)
        fill_solution(*self.filter, self.root, self.diagonal, precision, right, *how, solution)
        return solution

    def table(self, coordinates: Floats) -> Floats:
        """Compute the table R·y [rad] (2N,), 0 where never seen."""
        table = np.array(coordinates)
        reduce_by(self.root, table)
        return np.where(self.seen, table, 0.0)

    def posterior(self, variance: float) -> float:
        """Sum the posterior variances [rad²] of all seen entries; of so many each is as good as on its own."""
        return float(np.sum(1.0 / (self.diagonal[self.seen] + 1.0 / variance)))
