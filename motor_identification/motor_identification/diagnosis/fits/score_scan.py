"""Scan a fitted model for what one or two effects more would gain, to first order and without a fit.

Where two effects hide each other, as friction and drag do (a gain and an offset take up either), neither gains anything
alone, and no search that adds one at a time finds them. Rao's score test (C. R. Rao, "Large sample tests of statistical
hypotheses concerning several parameters", Proc. Camb. Phil. Soc. 44, 1948) of all pairs costs one simulation for each
start of an effect: what it changes of the white residuals, less what the fitted parameters take up, is a column, and
the gain of columns is that of least squares.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from math import isfinite

import numpy as np

from motor_identification.diagnosis.fits.disturbed_fit import make_disturbed_residuals
from motor_identification.diagnosis.fits.starts import list_starts
from motor_identification.estimation.estimate import Estimate
from motor_identification.noise.error_model import ErrorModel
from motor_identification.recording import Floats
from motor_model.effects import EFFECT_BY_NAME

LEAST_SHARE = 1e-6  # of a column's power, that the fitted parameters leave: the rest is rounding
SINGULAR = 1e-4  # of the larger of two columns, which the other leaves: they are one column


@dataclass(frozen=True)
class Promise:
    """What one or two effects gain of log likelihood to first order, and how large they are then."""

    effects: tuple[str, ...]
    gain: float
    sizes: tuple[dict[str, float], ...]  # a value for every parameter of each effect


@dataclass(frozen=True)
class _Column:
    """What an effect of a start's size changes of white residuals, beside the fitted parameters."""

    effect: str
    start: dict[str, float]
    none: float  # its first parameter, where there is none of it
    change: Floats  # (I,)

    def can_be(self, times: float) -> bool:
        """Whether the effect can be so many times its start: of some only one sign is physical."""
        size = EFFECT_BY_NAME[self.effect].parameters[0]
        return times > 0.0 or size.low < size.off

    def size(self, times: float) -> dict[str, float]:
        """The parameters of so many times the effect."""
        spec = EFFECT_BY_NAME[self.effect].parameters[0]
        return self.start | {spec.name: self.none + times * (self.start[spec.name] - self.none)}


def scan_scores(
    estimate: Estimate, errors: ErrorModel, effects: Iterable[str]
) -> tuple[tuple[Promise, ...], tuple[Promise, ...]]:
    """Scan what each of some effects, and each two of them, would gain beside the errors of a model; best first."""
    target = make_disturbed_residuals(estimate, errors)
    white = target.residuals(estimate.theta)
    taken, _ = np.linalg.qr(target.jacobian(estimate.theta))
    columns = []
    for effect in effects:
        if not can_be_scanned(effect):
            continue
        none = _find_none(effect, estimate)
        larger = estimate.problem.adding(effect)
        for sizes, theta in list_starts(estimate, larger):
            change = replace(target, problem=larger).residuals(theta) - white
            left = change - taken @ (taken.T @ change)
            if left @ left > LEAST_SHARE * (change @ change):
                columns.append(_Column(effect, sizes, none, left))
    rest = white - taken @ (taken.T @ white)
    return _list_singles(columns, rest), _list_pairs(columns, rest)


def can_be_scanned(effect: str) -> bool:
    """Decide whether an effect begins at a finite size, so that a little of it tells what more would gain.

    A limit does not: what it does begins where it comes below the command.
    """
    spec = EFFECT_BY_NAME[effect].parameters[0]
    return spec.at_least is not None or isfinite(spec.off)


def _find_none(effect: str, estimate: Estimate) -> float:
    """Find the first parameter of an effect where a motor has none of it; a limit that is none is infinite."""
    spec = EFFECT_BY_NAME[effect].parameters[0]
    return spec.off if spec.at_least is None else float(estimate.parameters.values[spec.at_least])


def _list_singles(columns: Sequence[_Column], rest: Floats) -> tuple[Promise, ...]:
    promises = []
    for one in columns:
        power, along = float(one.change @ one.change), -float(one.change @ rest)
        if one.can_be(along):
            promises.append(Promise((one.effect,), 0.5 * along**2 / power, (one.size(along / power),)))
    return _keep_best(promises)


def _list_pairs(columns: Sequence[_Column], rest: Floats) -> tuple[Promise, ...]:
    """List two effects each, of which both have to be of a size that they can be."""
    powers = np.array([[one.change @ other.change for other in columns] for one in columns])  # an hour has no room
    along = np.array([-(one.change @ rest) for one in columns])  # for all columns in one more array
    promises = []
    for i, j in combinations(range(len(columns)), 2):
        one, other = columns[i], columns[j]
        left = powers[i, i] * powers[j, j] - powers[i, j] ** 2
        if one.effect == other.effect or left < SINGULAR * powers[i, i] * powers[j, j]:
            continue
        times = (powers[j, j] * along[i] - powers[i, j] * along[j]) / left
        others = (powers[i, i] * along[j] - powers[i, j] * along[i]) / left
        if one.can_be(times) and other.can_be(others):
            gain = 0.5 * float(times * along[i] + others * along[j])
            promises.append(Promise((one.effect, other.effect), gain, (one.size(times), other.size(others))))
    return _keep_best(promises)


def _keep_best(promises: Iterable[Promise]) -> tuple[Promise, ...]:
    """Keep the best of each combination of effects, best first."""
    best: dict[tuple[str, ...], Promise] = {}
    for one in sorted(promises, key=lambda promise: -promise.gain):
        best.setdefault(one.effects, one)
    return tuple(best.values())
