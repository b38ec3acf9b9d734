"""Align runs of the measured angle: what a motor turns while it swings about a standstill, no channel counts.

The angle between two counted runs is then off by some slots, and the phase of a fast ripple is lost from one to the
next. Given the ripple, each run says how far; the most likely path of slips through all runs and the ripple are found
in turns. Where speeds were logged, nothing counts from one run to the next, and each has the phase that is likeliest.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from motor_identification.noise.viterbi import fill_path
from motor_identification.recording import Floats
from motor_model.compiled import compiled

STEPS_PER_SLOT = 4  # steps to a slot
MOST_SLIP_STEPS = 12 * STEPS_PER_SLOT  # steps of slip
SLIP_STEP_PRICE = 10.0 / STEPS_PER_SLOT  # of a slip by one step, in halves of a squared standard deviation
ALIGNMENT_ROUNDS = 4


@dataclass(frozen=True)
class Aligned:
    """A ripple's complex amplitude [V], each run's slip (B,) [rad of its wave], and how much they explain."""

    weight: complex
    slips: Floats
    explained: float


def align_runs(sums: Floats, turn: float, told: bool) -> Aligned:
    """Align runs: the ripple and the slips that explain most; a slip of one slot turns its phase by `turn` [rad].

    sums: for every run ss, sc, cc, sw, cw with s and c the responses to sine and cosine, w the residual; shape (B, 5).
    told: where no slots slip (`turn` is 0), whether the angle is known from run to run.
    """
    if turn == 0.0:
        return _align_without_slips(sums) if told else _align_freely(sums)
    step = turn / STEPS_PER_SLOT
    alone = _best(sums)
    weight = alone[int(np.argmax(alone.real * sums[:, 3] + alone.imag * sums[:, 4]))]
    slips, before = np.zeros(len(sums), dtype=np.int64), np.zeros(0, dtype=np.int64)
    scores, explained = np.empty((len(sums), 2 * MOST_SLIP_STEPS + 1)), 0.0
    for _ in range(ALIGNMENT_ROUNDS):
        _fill_scores(sums, weight.real, weight.imag, step, scores)
        explained = fill_path(scores, SLIP_STEP_PRICE, slips)
        weight = _best(_turned(sums, np.asarray(slips * step)).sum(axis=0))
        if np.array_equal(slips, before):
            break
        before = slips.copy()
    return Aligned(complex(weight), np.asarray(slips * step, dtype=np.float64), explained)


def _align_without_slips(sums: Floats) -> Aligned:
    whole = sums.sum(axis=0)
    weight = complex(_best(whole))
    return Aligned(weight, np.zeros(len(sums)), weight.real * whole[3] + weight.imag * whole[4])


def _align_freely(sums: Floats) -> Aligned:
    """One amplitude, and every run's phase as it is likeliest.

    The amplitude's square is had from those of all runs, less what white noise of a variance of 1 does by chance.
    """
    along, size = sums[:, 3] + 1j * sums[:, 4], 0.5 * (sums[:, 0] + sums[:, 2])
    squares = float(np.sum(size**2))
    power = float(np.sum(np.abs(along) ** 2 - 2.0 * size)) / squares if squares > 0.0 else 0.0
    if power <= 0.0:
        return Aligned(0j, np.zeros(len(sums)), 0.0)
    weight = np.sqrt(power) * np.exp(1j * np.angle(along[int(np.argmax(np.abs(along)))]))
    explained = float(np.sum(2.0 * np.sqrt(power) * np.abs(along) - power * size))
    return Aligned(complex(weight), np.asarray(np.angle(along * np.conj(weight))), explained)


def _best(sums: Floats) -> NDArray[np.complex128]:
    """A + ib of the wave a·sin + b·cos that explains most, (…, 5) → (…); 0 where nothing tells."""
    ss, sc, cc, sw, cw = np.moveaxis(sums, -1, 0)
    determinant = ss * cc - sc * sc
    told = determinant > 1e-9 * ss * cc
    wave = (cc * sw - sc * cw) + 1j * (ss * cw - sc * sw)
    return np.asarray(np.where(told, wave / np.where(told, determinant, 1.0), 0.0))


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
def _fill_scores(sums: Floats, real: float, imag: float, step: float, scores: Floats) -> None:
    """Fill what one wave explains of every run at every slip, (B, W)."""
    for b in range(len(sums)):
        ss, sc, cc, sw, cw = sums[b]
        for k in range(scores.shape[1]):
            angle = step * (k - MOST_SLIP_STEPS)
            x = real * np.cos(angle) - imag * np.sin(angle)
            y = real * np.sin(angle) + imag * np.cos(angle)
            scores[b, k] = 2.0 * (x * sw + y * cw) - (x * x * ss + 2.0 * x * y * sc + y * y * cc)
