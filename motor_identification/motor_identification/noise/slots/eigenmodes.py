"""Compute the eigenmodes of a slot table: what a recording says of it and its prior, both diagonal at once.

With AᵀA from the recording and the prior's precision P/σ² the most likely table is (AᵀA + P/σ²)⁻¹Aᵀz. In coordinates
with VᵀPV = 1 and VᵀAᵀAV diagonal that is one division each, for every σ².

Only entries that were seen are kept: the prior of those alone has the covariance that they have among all. And the two
directions share neither intervals nor prior, so that each has modes of its own.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.linalg import eigh

from motor_identification.recording import Bools, Floats, Integers

STIFF = 1e6  # prior variances that mean and first harmonic are kept below


@dataclass(frozen=True)
class Block:
    """Modes of some entries of the table: B numbers of entries, where the modes stand among all, and V (B, B)."""

    entries: Integers
    places: Integers
    vectors: Floats


@dataclass(frozen=True)
class Modes:
    """All modes of a table with 2N entries, ascending; arrays of shape (2N,), 0 for those of entries never seen."""

    values: Floats  # [1/rad²] what the recording knows of each
    blocks: tuple[Block, ...]

    def within(self, tolerance: float) -> "Modes":  # noqa: ARG002
        """Solve up to a tolerance: eigenmodes are exact, whatever it is."""
        return self

    def coordinates(self, scores: Floats, variance: float, guess: Floats | None = None) -> Floats:  # noqa: ARG002
        """Compute the table's coordinates (2N,) from Aᵀz (2N,) over entries, under a prior's variance [rad²].

        They are in units of the prior: their squares over the variance are its share of the cost.
        """
        out = np.zeros(len(self.values))
        for block in self.blocks:
            out[block.places] = scores[block.entries] @ block.vectors
        return out / (self.values + 1.0 / variance)

    def table(self, coordinates: Floats) -> Floats:
        """Compute Vx: (2N,) over modes → (2N,) over entries, 0 where never seen."""
        out = np.zeros(len(self.values))
        for block in self.blocks:
            out[block.entries] = block.vectors @ coordinates[block.places]
        return out

    def posterior(self, variance: float) -> float:
        """Sum the posterior variances [rad²] of all seen entries."""
        return float(np.sum(self.spread / (self.values + 1.0 / variance)))

    @cached_property
    def spread(self) -> Floats:
        """VᵀV's diagonal: how much variance a unit of each mode's gives to all entries together, shape (2N,)."""
        out = np.zeros(len(self.values))
        for block in self.blocks:
            out[block.places] = np.sum(block.vectors**2, axis=0)
        return out


def compute_eigenmodes(gram: Floats, seen: Bools, first_harmonic: bool) -> Modes:
    """Compute the modes of AᵀA (2N, 2N), by which entries were seen, and whether a first harmonic is allowed."""
    forbidden = forbidden_shapes(len(gram) // 2, first_harmonic)
    groups = _groups(gram, seen)
    values, vectors = np.zeros(len(gram)), []
    filled = np.count_nonzero(~seen)  # the first ones are 0: nothing is known of what was not seen
    for entries in groups:
        root = prior_root(forbidden, entries)
        known, basis = eigh(_on_both_sides(root, gram[np.ix_(entries, entries)]), overwrite_a=True, driver="evd")
        values[filled : filled + len(entries)] = np.maximum(known, 0.0)
        vectors.append(_reduced(root, basis))
        filled += len(entries)
    order = np.argsort(values, kind="stable")
    place = np.argsort(order, kind="stable")[len(values) - sum(map(len, groups)) :]
    blocks = []
    for entries, basis in zip(groups, vectors, strict=True):
        blocks.append(Block(entries, place[: len(entries)], basis))
        place = place[len(entries) :]
    return Modes(values[order], tuple(blocks))


def _groups(gram: Floats, seen: Bools) -> list[Integers]:
    """List the numbers of the seen entries, apart where nothing couples them: each direction has its own intervals."""
    n, entries = len(gram) // 2, np.flatnonzero(seen)
    parts = [entries] if np.any(gram[:n, n:]) else [entries[entries < n], entries[entries >= n]]
    return [part for part in parts if len(part)]


def forbidden_shapes(n: int, first_harmonic: bool) -> Floats:
    """What either direction's table may not have, unit shapes as columns (2N, 2 or 6)."""
    phase = 2.0 * np.pi * np.arange(n) / n
    shapes = [np.full(n, 1.0 / np.sqrt(n))]
    if not first_harmonic:
        shapes += [np.sqrt(2.0 / n) * np.cos(phase), np.sqrt(2.0 / n) * np.sin(phase)]
    return np.kron(np.eye(2), np.column_stack(shapes))


def prior_root(forbidden: Floats, entries: Integers) -> Floats:
    """U (B, C) such that (I − UUᵀ)² is the prior's covariance, for unit variance, of some entries.

    Of all entries it is (I + STIFF·FFᵀ)⁻¹ = I − F(I/STIFF + FᵀF)⁻¹Fᵀ, F the forbidden shapes; of some, their rows.
    """
    inner = np.linalg.inv(np.eye(forbidden.shape[1]) / STIFF + forbidden.T @ forbidden)
    basis, corner = np.linalg.qr(forbidden[entries])
    removed, turn = np.linalg.eigh(corner @ inner @ corner.T)
    share = 1.0 - np.sqrt(1.0 - np.clip(removed, 0.0, 1.0))
    return np.asarray(basis @ turn * np.sqrt(share))


def _reduced(root: Floats, columns: Floats) -> Floats:
    """(I − UUᵀ)·columns."""
    return np.asarray(columns - root @ (root.T @ columns))


def _on_both_sides(root: Floats, matrix: Floats) -> Floats:
    """(I − UUᵀ)·matrix·(I − UUᵀ)."""
    return _reduced(root, _reduced(root, matrix).T)
