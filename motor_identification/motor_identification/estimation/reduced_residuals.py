"""Reduce the residuals of least squares to one more than there are unknowns: a solver does the same with them.

With [f J] = QR, f and J may be replaced by the columns of R: the sum of squares, its gradient and JᵀJ stay (G. H.
Golub, Numer. Math. 7, 1965), and of f all but its length is 0, which is known before J is. On thousands of rows a
solver spends as long as a simulation does.
"""

from collections.abc import Callable

import numpy as np

from motor_identification.recording import Floats

GOOD_STEP = 0.25  # of the reduction that was predicted: with less of it SciPy's solver goes on, however small it is


class ReducedResiduals:
    """The residuals of one descent by SciPy's trust region solver; shapes (D + 1,) and (D + 1, D).

    The solver asks for derivatives where it ends, too. There they are 0 instead: it does nothing with them.
    """

    def __init__(
        self,
        residuals: Callable[[Floats], Floats],
        jacobian: Callable[[Floats], Floats],
        cost_tolerance: float,
        unknowns_tolerance: float,
        most_calls: int,
    ) -> None:
        self._residuals, self._jacobian = residuals, jacobian
        self._tolerances, self._most_calls = (cost_tolerance, unknowns_tolerance), most_calls
        self._calls = 0
        self._latest: tuple[Floats, Floats] = (np.empty(0), np.empty(0))  # θ and its residuals
        self._model: tuple[Floats, float, Floats, Floats] | None = None  # θ, sum of squares, half its gradient, R

    def residuals(self, theta: Floats) -> Floats:
        """At θ (D,), shape (D + 1,): their length, and 0."""
        self._calls += 1
        self._latest = (theta.copy(), self._residuals(theta))
        reduced: Floats = np.zeros(len(theta) + 1)
        reduced[0] = np.linalg.norm(self._latest[1])
        return reduced

    def jacobian(self, theta: Floats) -> Floats:
        """Their derivative, shape (D + 1, D)."""
        at, residuals = self._latest
        if not np.array_equal(at, theta):
            residuals = self._residuals(theta)
        squares = float(residuals @ residuals)
        if self._calls >= self._most_calls or self._ends(theta, squares):
            return np.zeros((len(theta) + 1, len(theta)))
        triangle = np.asarray(np.linalg.qr(np.column_stack([residuals, self._jacobian(theta)]), mode="r"))
        reduced: Floats = np.zeros((len(theta) + 1, len(theta)))  # of few residuals there are fewer rows
        reduced[: len(triangle)] = triangle[:, 1:]
        reduced[0] *= np.copysign(1.0, triangle[0, 0])  # of the length of all residuals, which is positive
        self._model = (theta.copy(), squares, abs(triangle[0, 0]) * reduced[0], reduced)
        return reduced

    def _ends(self, theta: Floats, squares: float) -> bool:
        """Whether the step to θ is the last: so short, or so little better though about as much as was predicted."""
        if self._model is None:
            return False
        before, most, gradient, reduced = self._model
        step = theta - before
        cost, unknowns = self._tolerances
        if np.linalg.norm(step) < unknowns * (unknowns + np.linalg.norm(before)):
            return True
        predicted = -2.0 * float(gradient @ step) - float(np.sum((reduced @ step) ** 2))
        return most - squares < cost * most and most - squares > GOOD_STEP * predicted
