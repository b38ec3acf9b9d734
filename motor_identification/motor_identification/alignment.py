"""Slips of the measured angle: a motor that swings about a standstill turns by an angle that no one channel tells.

The angle between two counted runs is then off by some slots, and the phase of a fast ripple is lost from one to the
next. Given the ripple, each run says how far; the most likely path of slips through all runs is found by dynamic
programming (A. Viterbi, IEEE Trans. Inf. Theory 13(2), 1967), and ripple and path in turns.
"""

from dataclasses import dataclass

import numpy as np

from motor_identification.recording import Floats, Integers
from motor_model.compiled import compiled

FINENESS = 4  # steps to a slot
MOST = 6 * FINENESS  # steps of slip from one run to the next
PRICE = 10.0 / FINENESS  # of a slip by one step, in halves of a squared standard deviation
ROUNDS = 4


@dataclass(frozen=True)
class Aligned:
    """A ripple's complex amplitude [V], each run's slip in slots (B,), and how much of the cost they explain."""

    weight: complex
    slips: Floats
    explained: float


def align(sums: Floats, turn: float) -> Aligned:
    """The ripple and the slips that explain most; `turn` [rad] is what a slip of one slot turns the ripple's phase by.

    sums: for every run ss, sc, cc, sw, cw with s and c the responses to sine and cosine, w the residual; shape (B, 5).
    """
    step = turn / FINENESS
    weight = _best(sums[[int(np.argmax([_alone(row) for row in sums]))]])
    slips = np.zeros(len(sums), dtype=np.int64)
    explained = 0.0
    for _ in range(ROUNDS):
        explained = float(_viterbi(sums, weight.real, weight.imag, step, slips))
        weight = _best(_turned(sums, np.asarray(slips * step)))
    return Aligned(weight, slips / FINENESS, explained)


def _alone(row: Floats) -> float:
    weight = _best(row[None])
    return weight.real * float(row[3]) + weight.imag * float(row[4])


def _best(sums: Floats) -> complex:
    """A + ib of the wave a·sin + b·cos that explains most of all runs together."""
    ss, sc, cc, sw, cw = sums.sum(axis=0)
    determinant = ss * cc - sc * sc
    if determinant <= 1e-9 * ss * cc:
        return 0j
    return complex((cc * sw - sc * cw) / determinant, (ss * cw - sc * sw) / determinant)


def _turned(sums: Floats, angle: Floats) -> Floats:
    """The sums with each run's phase turned back by an angle [rad], so that one wave fits all."""
    c, s = np.cos(angle), np.sin(angle)
    ss, sc, cc, sw, cw = sums.T
    return np.column_stack(
        [
            c * c * ss + 2.0 * c * s * sc + s * s * cc,
            c * s * (cc - ss) + (c * c - s * s) * sc,
            s * s * ss - 2.0 * c * s * sc + c * c * cc,
            c * sw + s * cw,
            c * cw - s * sw,
        ]
    )


@compiled
def _viterbi(sums: Floats, real: float, imag: float, step: float, slips: Integers) -> float:
    """Fill the most likely slips of all runs under one wave; returns what they explain."""
    width = 4 * MOST + 1
    score, origin = np.full((len(sums), width), -np.inf), np.zeros((len(sums), width), dtype=np.int64)
    for b in range(len(sums)):
        ss, sc, cc, sw, cw = sums[b]
        for k in range(width):
            angle = step * (k - 2 * MOST)
            x = real * np.cos(angle) - imag * np.sin(angle)
            y = real * np.sin(angle) + imag * np.cos(angle)
            gain = 2.0 * (x * sw + y * cw) - (x * x * ss + 2.0 * x * y * sc + y * y * cc)
            if b == 0:
                score[b, k] = gain - PRICE * abs(k - 2 * MOST)
                continue
            for j in range(max(k - MOST, 0), min(k + MOST + 1, width)):
                total = score[b - 1, j] - PRICE * abs(k - j) + gain
                if total > score[b, k]:
                    score[b, k], origin[b, k] = total, j
    k = int(np.argmax(score[-1]))
    best = float(score[-1, k])
    for b in range(len(sums) - 1, -1, -1):
        slips[b] = k - 2 * MOST
        k = origin[b, k]
    return best
