"""A motor is fitted to other commands, and judged, as the model beside it is."""

from dataclasses import replace
from types import SimpleNamespace
from typing import cast

import pytest
from plant import profiles, record

from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.fits.altered_commands import fit_altered, measure_share, score_alone
from motor_identification.diagnosis.fits.disturbed_fit import list_error_data
from motor_identification.diagnosis.start import begin
from motor_identification.estimation.request import Request
from motor_identification.noise.error_data import log_likelihood
from motor_identification.recording import check


@pytest.fixture(scope="module")
def model() -> Model:
    recording = check(record({"kv": 0.07, "ka": 0.0055}, *profiles.random(12.0, 6.0, 3), seed=3)[0])
    return begin([recording], (), Request(), lambda: False).selection.model


def test_a_motor_under_half_of_the_commands_has_half_of_kv(model: Model) -> None:
    recordings = [replace(one, voltage=0.5 * one.voltage) for one in model.estimate.problem.recordings]
    halved = fit_altered(model.estimate, model, recordings).parameters.values
    for name in ("kv", "ka"):
        assert halved[name] == pytest.approx(0.5 * model.estimate.parameters.value(name), rel=1e-3)
    again = fit_altered(model.estimate, model, model.estimate.problem.recordings)
    assert again.parameters.value("kv") == pytest.approx(model.estimate.parameters.value("kv"), rel=1e-4)


def test_what_is_left_is_scored_under_errors_of_its_own(model: Model) -> None:
    """Which are no worse than the model's; a motor that is 10 % off is less likely under either."""
    estimate = model.estimate
    off = estimate.on(estimate.problem)
    wrong = fit_altered(estimate, model, [replace(one, voltage=one.voltage[::-1]) for one in off.problem.recordings])
    own = log_likelihood(list_error_data(estimate), model.errors, model.lag)
    assert score_alone(estimate, model) >= own - 1e-6
    assert score_alone(wrong, model) < score_alone(estimate, model) - 100.0


@pytest.mark.parametrize(("cost", "gain", "share"), [(0.2, 0.0, 0.8), (0.9, 50.0, 0.632), (1.2, 0.0, 0.0)])
def test_a_share_is_that_of_squares_or_of_the_white_rest(model: Model, cost: float, gain: float, share: float) -> None:
    intervals = [SimpleNamespace(first=range(60)), SimpleNamespace(first=range(40))]
    altered = SimpleNamespace(cost=cost, problem=SimpleNamespace(intervals=intervals))
    without = cast(Model, SimpleNamespace(estimate=SimpleNamespace(cost=1.0)))
    assert measure_share(altered, without, gain) == pytest.approx(share, abs=1e-3)  # type: ignore[arg-type]
