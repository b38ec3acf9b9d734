"""Analyse residuals: do they repeat themselves, do they follow the voltage? Then something is missing.

A right model leaves white residuals that no past voltage predicts (Ljung, System Identification, 2nd ed., ch. 16.6).
The first is a portmanteau test, Ljung & Box (Biometrika 65, 1978), with pairs counted within runs only, so that gaps in
a recording count for nothing. The second correlates the residuals with the voltage some time before them; beside the
voltage itself with its size and its sign, because what a linear motor has adjusted to leaves no trace in the first.
"""

from dataclasses import dataclass
from math import nan

import numpy as np
from scipy.linalg import solve_banded
from scipy.special import chdtrc, ndtr

from motor_identification.recording import Bools, Floats
from motor_identification.uncertainty.result import Whiteness

CORRELATION_LAGS = 20  # intervals over which residuals may repeat themselves
VOLTAGE_DELAYS = (0.0, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0)  # sample periods before a residual
LEAST_PAIRS = 10  # pairs that make a correlation
VOLTAGE_FACES = (np.array, np.abs, np.sign)  # of a voltage: itself, its size, its direction


@dataclass(frozen=True)
class Series:
    """White residuals of one recording, shape (I,), and the command, shape (M,), that they may depend on."""

    white: Floats
    time: Floats  # [s] middle of every interval
    fresh: Bools  # which intervals do not begin where the one before ended
    command_time: Floats  # [s] ascending; the command holds from each of them on
    command: Floats  # [V]
    sample_period: float  # [s]


def analyse_whiteness(series: tuple[Series, ...]) -> Whiteness:
    """Analyse the whiteness of residuals by both tests, over all recordings together."""
    rho, pairs = autocorrelation(series, CORRELATION_LAGS)
    known = pairs >= LEAST_PAIRS
    if not known.any():
        return Whiteness(nan, nan, 0, nan, nan, nan)
    chance = float(chdtrc(known.sum(), np.sum((pairs * rho**2)[known])))
    largest = int(np.argmax(np.where(known, np.abs(rho), -1.0)))
    follows = _follows(series, np.where(known, rho, 0.0))
    return Whiteness(chance, float(rho[largest]), largest + 1, *follows)


def autocorrelation(series: tuple[Series, ...], lags: int) -> tuple[Floats, Floats]:
    """Correlations of residuals 1 to `lags` intervals apart in one run, and the pairs behind each; shapes (lags,)."""
    products, earlier, later, pairs = np.zeros((4, lags))
    for one in series:
        run = np.cumsum(one.fresh)
        for lag in range(1, min(lags, len(run) - 1) + 1):
            same = run[lag:] == run[:-lag]
            before, after = one.white[:-lag][same], one.white[lag:][same]
            products[lag - 1] += before @ after
            earlier[lag - 1] += before @ before
            later[lag - 1] += after @ after
            pairs[lag - 1] += len(before)
    return products / np.maximum(np.sqrt(earlier * later), 1e-300), pairs  # of the very pairs: 1 at most


def _follows(series: tuple[Series, ...], rho: Floats) -> tuple[float, float, float]:
    """p-value, largest correlation and its lag [s] between residuals and past voltages.

    A correlation r of n residuals has the variance Σ ρ_z(k) ρ_u(k)/n (Ljung, eq. 16.66); ρ_z is taken as geometric from
    its first lag on, or a slow drift of a few swings would pass for a relation. Bonferroni's rule for the largest.
    """
    white = np.concatenate([one.white for one in series])
    best, at, chance = 0.0, 0.0, nan
    tests = len(VOLTAGE_FACES) * len(VOLTAGE_DELAYS)
    for past in [samples * min(one.sample_period for one in series) for samples in VOLTAGE_DELAYS]:
        held = np.concatenate([_held(one, past) for one in series])
        for face in VOLTAGE_FACES:
            voltage = face(held)
            voltage = voltage - voltage.mean()
            norms = float(np.linalg.norm(voltage) * np.linalg.norm(white))
            if norms <= 1e-9 * len(white):
                continue
            correlation = float(white @ voltage) / norms
            if abs(correlation) >= abs(best):
                spread = np.sqrt(_inflation(rho, voltage) / len(white))
                best, at = correlation, past
                chance = min(1.0, tests * 2.0 * float(ndtr(-abs(correlation) / spread)))
    return (chance, best, at) if chance == chance else (nan, nan, nan)


def _held(one: Series, past: float) -> Floats:
    """[V] the command that held some time [s] before each residual; 0 before the first."""
    index = np.searchsorted(one.command_time, one.time - past, side="right") - 1
    return np.where(index >= 0, one.command[np.maximum(index, 0)], 0.0)


def _inflation(rho: Floats, voltage: Floats) -> float:
    """Σ ρ_z(k) ρ_u(k) over all lags, at least 1: how much less a correlated residual says than a white one."""
    first = min(max(float(rho[0]), 0.0), 0.999)
    shifted = np.concatenate(([0.0], voltage[:-1]))  # s(n) - ρ s(n-1) = ρ u(n-1), as a band of ones and -ρ
    smooth = solve_banded((1, 0), (np.ones(len(voltage)), np.full(len(voltage), -first)), first * shifted)
    return max(1.0, 1.0 + 2.0 * float(voltage @ smooth) / float(voltage @ voltage))
