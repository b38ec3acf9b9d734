"""Estimate how sure a fit is: standard errors and correlations that stay right where the residuals do not."""

from dataclasses import dataclass

import numpy as np
from scipy.special import ndtri, stdtrit

from motor_identification.estimation.whitened_fit import WhitenedFit
from motor_identification.recording import Bools, Floats, Integers
from motor_identification.uncertainty.identifiability import mark_visible, measure_independence, scale_unknowns
from motor_identification.uncertainty.result import Whiteness
from motor_identification.uncertainty.whiteness import Series, analyse_whiteness

JACKKNIFE_BLOCKS = (20, 10)  # of equal time; the fewer where the more are not independent
DEPENDENT_SIGMA = 1.645  # standard deviations of the products of neighbours, from which on blocks are not independent
LEAST_BLOCK_ROWS = 8  # residuals in a block
LEAST_WHITE_P_VALUE = 0.01  # chance under which residuals do not pass for white
MOST_LEVERAGE = 0.95  # largest share of a direction that one block may be credited with
COLLINEAR_SINE = 1e-4  # sine of the angle between a column of the Jacobian and the others, below which they are one
MOST_RELATIVE_ERROR = 0.5  # standard error as a share of the value: beyond, two of them reach zero
COVERED_QUANTILE = 0.975  # quantile up to which an interval of ±1.96 standard errors shall reach


@dataclass(frozen=True)
class Uncertainty:
    """Standard errors of θ (D,) (NaN where not identifiable), and which physical parameters are not.

    `correlations` (D, D) has NaN rows and columns where the errors are NaN.
    """

    errors: Floats
    correlations: Floats
    not_identifiable: tuple[str, ...]
    whiteness: Whiteness

    def correlations_of(self, names: tuple[str, ...]) -> dict[str, dict[str, float]]:
        """The correlations of the first unknowns, which these names belong to."""
        rows = self.correlations[: len(names), : len(names)]
        return {name: dict(zip(names, map(float, row), strict=True)) for name, row in zip(names, rows, strict=True)}


def estimate_uncertainty(fit: WhitenedFit, jacobian: Floats) -> Uncertainty:
    """Estimate the standard errors of a fit from its white residuals and their Jacobian (rows, D).

    Where the residuals pass for white (portmanteau test of `whiteness.py`), the covariance is (JᵀJ)⁻¹: it needs no
    estimate. Elsewhere, and where that cannot be tested (windows that overlap), it is that of the delete-one-block
    jackknife over 20 blocks of equal time, which takes any correlation that is shorter than a block, and any change of
    the motor from block to block, as it is (Künsch, Ann. Statist. 17, 1989; to first order the sandwich of Liang &
    Zeger with each block's score divided by one minus its leverage, CV3 of MacKinnon, Nielsen & Webb, J. Appl.
    Econometrics 38, 2023). Where neighbouring blocks still pull a parameter the same way, 10 are taken (blocking of
    Flyvbjerg & Petersen, J. Chem. Phys. 91, 1989): a motor that warms up. So few blocks know the spread only roughly,
    and fewer where one of them holds most of what there is to know of a parameter: the error is widened from the normal
    to Student's distribution with the degrees of freedom of Bell & McCaffrey (Survey Methodology 28, 2002), so that
    ±1.96 standard errors cover 95 % either way.

    More and shorter blocks, and a stationary (autoregressive) model of the residuals, were tried and cover less: a
    disturbance of the motor lasts long beside the time between edges, and is not stationary in the white residuals.
    """
    scale = scale_unknowns(fit.estimate)
    scaled = jacobian * scale
    root = _root(scaled)
    white = fit.residuals.residuals(fit.theta)
    whiteness = analyse_whiteness(_series(fit, white))
    covariance = root @ root.T
    errors = np.sqrt(np.diag(covariance))
    if not whiteness.p_value >= LEAST_WHITE_P_VALUE and len(white) >= JACKKNIFE_BLOCKS[0] * LEAST_BLOCK_ROWS:
        covariance, errors = _blocked(fit, scaled, white, root)
    alone = measure_independence(scaled)
    visible = mark_visible(fit.estimate, scale) | _mark_visible_beside(fit, scaled)
    unsure = (alone < COLLINEAR_SINE) | (errors > MOST_RELATIVE_ERROR) | ~visible
    names = tuple(name for name, bad in zip(fit.problem.unknowns.names, unsure, strict=False) if bad)
    sigma = np.where(unsure, np.nan, np.sqrt(np.diag(covariance)))
    correlations = np.clip(covariance / np.outer(sigma, sigma), -1.0, 1.0)
    return Uncertainty(np.where(unsure, np.nan, errors * scale), correlations, names, whiteness)


def _mark_visible_beside(fit: WhitenedFit, columns: Floats) -> Bools:
    """Which unknowns move what was measured beside the motion by more than its noise when they change by 100 %."""
    rows = sum(len(further.time) for further in fit.residuals.beside)
    return np.asarray(np.linalg.norm(columns[len(columns) - rows :], axis=0) > 1.0)


def _root(columns: Floats) -> Floats:
    """R (D, D) with R Rᵀ = (JᵀJ)⁻¹, by eigenvalues; directions that do not show at all are left out."""
    values, vectors = np.linalg.eigh(columns.T @ columns)
    kept = values > 1e-14 * values[-1]
    return np.asarray(vectors * np.where(kept, 1.0 / np.sqrt(np.where(kept, values, 1.0)), 0.0))


def _blocked(fit: WhitenedFit, columns: Floats, white: Floats, root: Floats) -> tuple[Floats, Floats]:
    """Covariance (D, D) by the more blocks; errors (D,), by the fewer where the more depend on each other."""
    (covariance, errors, dependent), fewer = (
        _jackknife(columns, white, root, _block_of(fit, blocks)) for blocks in JACKKNIFE_BLOCKS
    )
    return covariance, np.where(dependent, np.maximum(errors, fewer[1]), errors)


def _jackknife(columns: Floats, white: Floats, root: Floats, block_of: Integers) -> tuple[Floats, Floats, Bools]:
    """Covariance (D, D), errors (D,) widened for the blocks being few, and where neighbouring blocks are dependent.

    In the coordinates A = J R, AᵀA is the identity and G_b = A_bᵀA_b is what block b knows of each direction. Leaving
    block b out moves θ by R m_b, m_b = (I − G_b)⁻¹ A_bᵀ r_b. Rows of block −1, the slot table's prior, are
    independent of each other.
    """
    unit = columns @ root
    known, weights, moves = [], [], []
    for block in range(block_of.max() + 1):
        rows = block_of == block
        values, vectors = np.linalg.eigh(unit[rows].T @ unit[rows])
        values = np.clip(values, 0.0, MOST_LEVERAGE)
        known.append((vectors * values) @ vectors.T)
        weights.append((vectors / (1.0 - values)) @ vectors.T)
        moves.append(root @ weights[-1] @ (unit[rows].T @ white[rows]))
    prior = block_of < 0
    table = (unit[prior] * white[prior, None]) @ root.T
    moved = np.array(moves)
    covariance = moved.T @ moved + table.T @ table
    freedom = np.array([_freedom(direction, np.array(known), np.array(weights)) for direction in root])
    widening = stdtrit(np.maximum(freedom, 1.0), COVERED_QUANTILE) / ndtri(COVERED_QUANTILE)
    products = moved[1:] * moved[:-1]
    dependent = products.sum(axis=0) > DEPENDENT_SIGMA * np.sqrt(np.sum(products**2, axis=0))
    return covariance, np.sqrt(np.diag(covariance)) * widening, dependent


def _freedom(direction: Floats, known: Floats, weight: Floats) -> float:
    """Degrees of freedom of the variance of one parameter for white residuals: (tr Γ)²/tr Γ² (Satterthwaite).

    Γ_bc = dᵀW_b (δ_bc G_b − G_b G_c) W_c d is the covariance of the blocks' moves along the parameter's direction d.
    """
    weighted = weight @ direction
    parts = np.einsum("bij,bj->bi", known, weighted)
    spread = np.diag(np.einsum("bi,bi->b", weighted, parts)) - parts @ parts.T
    square = float(np.sum(spread**2))
    return float(np.trace(spread)) ** 2 / square if square > 0.0 else 1.0


def _lengths(fit: WhitenedFit) -> list[tuple[int, int]]:
    """Of every recording: how many white residuals are of intervals, and how many of the slot table's prior."""
    return [
        (len(data.first), encoder.projection.table.index.size if encoder.projection is not None else 0)
        for data, encoder in zip(fit.problem.intervals, fit.residuals.encoders, strict=True)
    ]


def _series(fit: WhitenedFit, white: Floats) -> tuple[Series, ...]:
    """The white residuals recording by recording."""
    series, row = [], 0
    for r, (data, (intervals, table)) in enumerate(zip(fit.problem.intervals, _lengths(fit), strict=True)):
        middle = 0.5 * (data.time[data.first] + data.time[data.last])
        series.append(
            Series(
                white[row : row + intervals], middle, data.fresh, *fit.problem.commands[r], fit.problem.sample_period
            )
        )
        row += intervals + table
    for r, further in enumerate(fit.residuals.beside):
        rows, first = white[row : row + len(further.time)], np.arange(len(further.time)) == 0
        series.append(Series(rows, further.time, first, *fit.problem.commands[r], fit.problem.sample_period))
        row += len(further.time)
    return tuple(series)


def _block_of(fit: WhitenedFit, blocks: int) -> Integers:
    """Number of the block of equal time that each residual belongs to; −1 for those of the slot table."""
    parts, further, begun = [], [], 0.0
    beside = fit.residuals.beside or (None,) * len(fit.problem.intervals)
    for data, (_, table), more in zip(fit.problem.intervals, _lengths(fit), beside, strict=True):
        parts += [begun + 0.5 * (data.time[data.first] + data.time[data.last]), np.full(table, -1.0)]
        further += [begun + np.minimum(more.time, data.time[-1])] if more is not None else []
        begun += float(data.time[-1])
    middle = np.concatenate(parts + further)
    return np.where(middle < 0.0, -1, np.minimum(middle / begun * blocks, blocks - 1)).astype(np.int64)
