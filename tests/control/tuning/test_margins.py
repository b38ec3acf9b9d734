"""Margins of loops whose margins are known."""

from math import inf, pi

import numpy as np
import pytest

from motor_control.tuning.linear_loop import Complexes
from motor_control.tuning.margins import Margins, least, margins_of

PERIOD, TAU, LATE = 1e-3, 0.05, 0.02


def integrator(z: Complexes) -> Complexes:
    """e^(−Ds)/(τ s)."""
    s = np.log(z) / PERIOD
    return np.asarray(np.exp(-LATE * s) / (TAU * s))


def test_a_late_integrator() -> None:
    """Crosses 1 at 1/τ, −180° where D w = 90°."""
    margins = margins_of(integrator, PERIOD, LATE)
    assert margins.gain == pytest.approx(pi * TAU / (2.0 * LATE), rel=0.01)
    assert margins.phase == pytest.approx(90.0 - np.degrees(LATE / TAU), abs=0.3)
    assert margins.delay == pytest.approx(np.radians(margins.phase) * TAU, rel=0.01)
    assert margins.gain_db == pytest.approx(20.0 * np.log10(margins.gain))


def test_a_loop_that_never_crosses_has_no_bounds() -> None:
    margins = margins_of(lambda z: np.full(len(z), 0.1 + 0.0j), PERIOD, LATE)
    assert margins.gain_db == inf and margins.delay == inf


def test_the_least_of_each() -> None:
    assert least([Margins(2.0, 60.0, 0.1), Margins(3.0, 50.0, 0.2)]) == Margins(2.0, 50.0, 0.1)
