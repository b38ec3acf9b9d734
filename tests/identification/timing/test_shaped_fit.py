"""A fit beside what shapes most motions asks for a dead time, whatever else is in the motor."""

from dataclasses import replace

import numpy as np
import pytest
from swinging import noisy

from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.request import SearchConfig
from motor_identification.estimation.search.global_search import search_globally
from motor_identification.recording import Recording, check
from motor_identification.timing.shaped_fit import Shaper
from motor_identification.timing.timing import ASSUMED
from motor_model.effects import LAGGING, SHAPING, SHAPING_BOTH_WAYS


def shaper_of(recording: Recording) -> Shaper:
    estimate, _ = search_globally(make_problem([recording], ()), SearchConfig())
    return Shaper([recording], estimate, None)


def test_a_dead_time_is_asked_for_and_little_is_left() -> None:
    fitted = shaper_of(check(noisy(0.05, delay=0.013))).fit(ASSUMED)
    assert fitted.delay == pytest.approx(0.013, rel=0.01)
    assert fitted.estimate.parameters.value("ks") == pytest.approx(0.5, rel=0.02)
    noise = np.sqrt(np.mean(fitted.residuals**2) * len(fitted.residuals))
    assert 0.045 < noise < 0.055  # [rad/s] weighted by shares of the time
    assert shaper_of(check(noisy(0.05))).fit(ASSUMED).delay == pytest.approx(0.0, abs=1e-4)


def test_a_motor_that_is_driven_one_way_has_no_two() -> None:
    both = check(noisy(0.05))
    assert shaper_of(both).fit(ASSUMED).estimate.problem.unknowns.effects == SHAPING_BOTH_WAYS
    one_way = check(replace(both, voltage=np.abs(both.voltage), speed=np.abs(both.speed)))
    assert shaper_of(one_way).fit(ASSUMED).estimate.problem.unknowns.effects == SHAPING


def test_what_lags_is_fitted_beside_it_where_asked() -> None:
    shaper = shaper_of(check(noisy(0.05, electrical_time_constant=0.02)))
    plain, lagging = shaper.fit(ASSUMED), shaper.fit(ASSUMED, LAGGING)
    assert lagging.estimate.parameters.value("electrical_time_constant") == pytest.approx(0.02, rel=0.05)
    assert np.sum(lagging.residuals**2) < 0.5 * np.sum(plain.residuals**2)
