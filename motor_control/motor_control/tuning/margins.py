"""How far a loop is from oscillating: gain, phase and delay margin, by python-control."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf, isfinite, log10, radians

import numpy as np

from motor_control.tuning.linear_loop import Complexes

Loop = Callable[[Complexes], Complexes]  # L at points z of shape (F,)
FREQUENCIES = 250
LOWEST = 1e-4  # [rad] of phase that the lateness costs there: far below any crossover


@dataclass(frozen=True, slots=True)
class Margins:
    """What may still change before the loop oscillates; infinite where nothing ever makes it."""

    gain: float  # factor on both gains, or on 1/ka
    phase: float  # [deg]
    delay: float  # [s] more dead time

    @property
    def gain_db(self) -> float:
        """The gain margin in decibels."""
        return 20.0 * log10(self.gain) if isfinite(self.gain) else inf


def margins_of(loop: Loop, period: float, late: float) -> Margins:
    """Return the margins of L(z), sampled every `period` [s]; delay margin = phase margin / crossover frequency.

    late: what makes the loop late [s]; the search for crossovers begins far below its inverse.
    """
    import control

    grid = np.geomspace(LOWEST / late, np.pi / period, FREQUENCIES)
    response = control.frd(loop(np.exp(1j * grid * period)), grid, smooth=True)
    gain, phase, _, _, crossover, _ = control.stability_margins(response)
    delay = radians(float(phase)) / float(crossover) if isfinite(float(phase)) else inf
    return Margins(float(gain), float(phase), delay)


def least(margins: Sequence[Margins]) -> Margins:
    """Return the smallest of each."""
    return Margins(min(m.gain for m in margins), min(m.phase for m in margins), min(m.delay for m in margins))
