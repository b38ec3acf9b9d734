"""Effects that a fit was asked for and that are not there are said to be absent, not measured."""

from functools import cache

import numpy as np
import pytest
from plant import profiles, record
from tiers import keep_fast

from motor_identification.identify import Request, identify
from motor_identification.recording import check
from motor_identification.reporting.fit_text import describe_parameter, list_cautions, summarize_fit
from motor_identification.uncertainty.result import Fit
from motor_model.effects import EFFECT_BY_NAME
from motor_model.parameters import PAPER_KA, PAPER_KV

THERE = {
    "backlash": {"backlash_angle": 0.05, "load_fraction": 0.3},
    "transport_delay": {"delay": 0.001},
    "static_friction": {"breakaway_voltage": 0.6, "stribeck_speed": 4.0},
    "load_bias": {"bias_voltage": 0.001},
    "warm_up": {"resistance_rise": 0.01, "warm_up_time": 10.0},
}


@cache
def fitted(effect: str, seed: int, there: bool) -> Fit:
    values = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.4, **(THERE[effect] if there else {})}
    recording, _ = record(values, *profiles.compact(12.0, seed), irregularity=0.005, disc_seed=seed, seed=seed)
    return identify([check(recording)], Request(("coulomb_friction", effect)))


@pytest.mark.parametrize(
    ("effect", "seed"), keep_fast(zip(THERE, (1, 2, 1, 2, 1), strict=True), (next(iter(THERE)), 1))
)
def test_what_is_not_there_is_absent(effect: str, seed: int) -> None:
    fit = fitted(effect, seed, there=False)
    assert fit.absent == (effect,)
    assert fit.not_identifiable == () and fit.suggested_experiment == "" and effect not in fit.not_told_apart
    for spec in EFFECT_BY_NAME[effect].parameters:
        error = fit.standard_errors[spec.name]
        assert np.isnan(error) or abs(fit.parameters.values[spec.name]) < 4.0 * error
        assert describe_parameter(fit, spec.name) == "absent (consistent with zero)"
        assert f"{spec.name} =" not in summarize_fit(fit)
    (caution,) = [one for one in list_cautions(fit) if "absent" in one]
    named = effect.replace("_", " ").capitalize()
    assert caution == f"{named} is absent (consistent with zero): the fit is as good without it."


@pytest.mark.parametrize("effect", keep_fast(THERE, next(iter(THERE))))
def test_what_is_there_is_not_absent_however_small(effect: str) -> None:
    fit = fitted(effect, 1, there=True)
    assert fit.absent == ()
    for name, value in THERE[effect].items():
        assert fit.parameters.values[name] == pytest.approx(value, rel=0.05)
        assert describe_parameter(fit, name) == ""


def test_of_two_that_do_for_each_other_neither_is_absent() -> None:
    """A step upwards alone: a dead zone, friction and a constant load are one and the same; something is there."""
    values = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.4}
    time, volts = [0.0, 0.1, 1.0, 2.0, 3.0], [0.0, 6.0, 9.0, 12.0, 12.0]
    recording, _ = record(values, time, volts, seed=1)
    fit = identify([check(recording)], Request(("coulomb_friction", "dead_zone")))
    assert fit.absent == ()
