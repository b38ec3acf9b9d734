"""Voltages to drive the plant with: each profile is (time [s], voltage [V]), two arrays at 200 Hz that end at 0 V."""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Profile = tuple[Floats, Floats]
RATE = 200.0  # [Hz]


def pieces(levels: ArrayLike, seconds: ArrayLike) -> Profile:
    """Constant levels [V], each held for its number of seconds (or all for the same)."""
    volts = np.asarray(levels, dtype=np.float64)
    lengths = np.round(np.broadcast_to(np.asarray(seconds, dtype=np.float64), volts.shape) * RATE).astype(np.int64)
    return _timed(np.repeat(volts, lengths))


def through(levels: ArrayLike, seconds: float) -> Profile:
    """Straight ramps from 0 V through the levels [V] and back to 0 V, each taking so many seconds."""
    corners = np.concatenate([[0.0], np.asarray(levels, dtype=np.float64), [0.0]])
    per_ramp = round(seconds * RATE)
    at = np.arange((len(corners) - 1) * per_ramp) / per_ramp
    return _timed(np.interp(at, np.arange(len(corners)), corners))


def joined(*profiles: Profile) -> Profile:
    """One after the other."""
    return _timed(np.concatenate([volts[:-1] for _, volts in profiles]))


def step(volts: float = 10.0, seconds: float = 1.0) -> Profile:
    """The paper's experiment."""
    return pieces([volts], [seconds])


def staircase(volts: float = 12.0, levels: int = 6, seconds: float = 0.5) -> Profile:
    """Up and down in equal steps, forward and then backward."""
    up = np.linspace(volts / levels, volts, levels)
    return pieces(np.concatenate([up, up[-2::-1], -up, -up[-2::-1]]), seconds)


def ramps(volts: float = 12.0, seconds: float = 2.0) -> Profile:
    """Slowly to full voltage and back, both ways: breakaway and sliding friction."""
    return through([volts, 0.0, -volts], seconds)


def reversals(volts: float = 8.0, times: int = 8, seconds: float = 0.4) -> Profile:
    """Full forward, full backward, and again; every other pair at half the voltage."""
    sizes = np.where(np.arange(times) // 2 % 2, 0.5 * volts, volts)
    return pieces(sizes * np.where(np.arange(times) % 2, -1.0, 1.0), seconds)


def coast(volts: float = 12.0, times: int = 3, seconds: float = 0.8) -> Profile:
    """Spin up and let go, from lower and lower speeds, both ways."""
    sizes = volts * np.linspace(1.0, 1.0 / times, times)
    return pieces(np.column_stack([sizes, 0.0 * sizes, -sizes, 0.0 * sizes]).ravel(), seconds)


def random(
    volts: float = 12.0, seconds: float = 5.0, seed: int = 0, hold: tuple[float, float] = (0.05, 0.6)
) -> Profile:
    """Uniform levels both ways, each held for a random time [s]."""
    generator = np.random.default_rng(seed)
    count = int(np.ceil(seconds / hold[0])) + 1
    _, values = pieces(generator.uniform(-volts, volts, count), generator.uniform(*hold, count))
    return _timed(values[: round(seconds * RATE)])


def rich(volts: float = 12.0, seed: int = 0) -> Profile:
    """All of them in turn, about half a minute."""
    parts: list[Callable[[float], Profile]] = [step, staircase, ramps, reversals, coast]
    return joined(*(part(volts) for part in parts), random(volts, seed=seed))


def compact(volts: float = 12.0, seed: int = 0) -> Profile:
    """All of them in turn, in 15 s: for diagnoses whose time is that of their recording."""
    parts = [staircase(volts, 4, 0.25), ramps(volts, 0.8), reversals(volts, 6, 0.3), coast(volts, 2, 0.4)]
    return joined(*parts, random(volts, 3.5, seed))


def _timed(volts: Floats) -> Profile:
    values = np.append(volts, 0.0)
    return np.arange(len(values)) / RATE, values
