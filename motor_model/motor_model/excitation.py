"""Excitation: named voltage profiles, each of which says what it makes visible. Adding one is adding a row."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from motor_model.errors import MotorError

Floats = NDArray[np.float64]
Shape = Callable[[Floats], Floats]  # time [s] since the profile's start → share of the voltage, −1 to 1


@dataclass(frozen=True, slots=True)
class Profile:
    """A voltage over time, as a share of the largest; 0 before its start and after its end."""

    name: str
    duration: float  # [s]
    shows: str
    shape: Shape

    def voltage(self, time: NDArray[np.floating[Any]], largest: float) -> Floats:
        """[V] at times [s] since the start, scaled so that a share of 1 is `largest` [V]. Shape as `time`."""
        inside = (time >= 0.0) & (time < self.duration)
        return np.asarray(np.where(inside, largest * self.shape(np.clip(time, 0.0, self.duration)), 0.0))


def _levels(levels: list[float], hold: float) -> Shape:
    values = np.array([*levels, 0.0])

    def shape(time: Floats) -> Floats:
        # A billionth of a hold is added so that a sample that falls on a switch belongs to the new level.
        return np.asarray(values[np.minimum((time / hold + 1e-9).astype(int), len(levels))])

    return shape


def _corners(times: list[float], values: list[float]) -> Shape:
    return lambda time: np.asarray(np.interp(time, times, values))


def _random_bits(bits: int, seed: int, low: float, high: float) -> list[float]:
    """Random telegraph levels: mostly between two levels of one direction, now and then the other direction."""
    random = np.random.default_rng(seed)
    signs = np.where(random.random(bits // 10 + 1) < 0.35, -1.0, 1.0).repeat(10)[:bits]
    return [float(v) for v in signs * np.where(random.random(bits) < 0.5, low, high)]


def _chirp(duration: float, first: float, last: float) -> Shape:
    """A sine whose frequency [Hz] grows exponentially, Farina's sweep."""
    rate = np.log(last / first) / duration
    return lambda time: np.asarray(np.sin(2 * np.pi * first / rate * np.expm1(rate * time)))


_UP = [i / 6 for i in range(1, 7)]
_STAIRS = [*_UP, *_UP[-2::-1], 0.0]
_REVERSALS = [a * s for a in (1.0, 0.7, 0.4) for s in (1, -1, 1, -1)]
_COAST = [1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.5, 0.0, -0.5, 0.0]

_BASIC = (
    Profile("step", 1.0, "gain and time constant at one level (the base paper's experiment)", np.ones_like),
    Profile(
        "staircase",
        5.75,
        "friction against gain (several levels both ways), asymmetry, saturation, drag",
        _levels([*_STAIRS[:-1], 0.0, *[-v for v in _STAIRS[:-1]]], 0.25),
    ),
    Profile(
        "ramps",
        6.0,
        "breakaway and Stribeck friction (slow ramps from rest and back), dead zone",
        _corners([0.0, 1.5, 3.0, 4.5, 6.0], [0.0, 0.35, 0.0, -0.35, 0.0]),
    ),
    Profile("reversals", 3.6, "backlash, delay, inductance (hard reversals at three levels)", _levels(_REVERSALS, 0.3)),
    Profile(
        "coast", 4.0, "friction against dead zone (coasting down at 0 V), the bridge's decay", _levels(_COAST, 0.4)
    ),
    Profile(
        "prbs",
        4.0,
        "delay and inductance (fast switching between levels)",
        _levels(_random_bits(100, 5, 0.3, 0.9), 0.04),
    ),
    Profile("chirp", 4.0, "the time constant over frequency", _chirp(4.0, 0.4, 12.0)),
)


def _in_turn(parts: tuple[Profile, ...]) -> Profile:
    starts = np.cumsum([0.0, *[part.duration for part in parts]])

    def shape(time: Floats) -> Floats:
        return np.asarray(
            sum(part.voltage(np.asarray(time - start), 1.0) for part, start in zip(parts, starts, strict=False))
        )

    return Profile("rich", float(starts[-1]), "every effect of the table (all profiles in turn)", shape)


PROFILES = {profile.name: profile for profile in (*_BASIC, _in_turn(_BASIC))}


def profile(name: str) -> Profile:
    """Return the profile of that name.

    Raises:
        MotorError: there is none.
    """
    if name not in PROFILES:
        raise MotorError(f"'{name}' is not a profile; the profiles are {', '.join(PROFILES)}.")
    return PROFILES[name]
