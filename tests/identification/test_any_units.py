"""Metamorphic: the same physics in other volts, seconds and radians has the same names and the same parameters.

From 1.2 to 48 V, time constants from 5 ms to 2 s, 5 to 5,571 rad/s. The recording is the same, number by number; only
its units differ, and how many slots a turn has, so that the disc has to be a perfect one.
"""

from functools import cache

import pytest
from plant import profiles, record
from scaled import Units
from tiers import keep_fast

from motor_identification.diagnose import diagnose
from motor_identification.identify import Request, SearchConfig, identify
from motor_identification.recording import Recording, check
from motor_identification.uncertainty.result import Fit
from motor_model.parameters import PAPER_KA, PAPER_KV

HIDDEN: dict[str, dict[str, float]] = {
    "": {},
    "coulomb_friction,transport_delay": {"ks": 0.4, "delay": 0.006},
    "static_friction": {"ks": 0.4, "breakaway_voltage": 0.9, "stribeck_speed": 4.0},
    "dead_zone,armature_inductance": {"dead_zone_voltage": 0.4, "electrical_time_constant": 0.004},
    "quadratic_drag,load_bias": {"drag": 5e-5, "bias_voltage": 0.3},
    "voltage_limit,supply_sag": {"limit_voltage": 10.0, "sag": 0.1},
    "backlash": {"backlash_angle": 0.2, "load_fraction": 0.5},
    "warm_up": {"resistance_rise": 0.2, "warm_up_time": 10.0},
}
UNITS = {
    "1.2 V": Units(voltage=0.1),
    "5,571 rad/s, 5 ms": Units(speed=32.0, time=1.0 / 16.0),
    "2 s, 48 V, 3.5 rad/s": Units(voltage=4.0, time=25.0, speed=1.0 / 50.0),
}
NEAR = 2.5  # standard errors: the numbers' rounding, and slots that a perfect disc's fit guesses, are all that differs


def short(volts: float, seed: int) -> profiles.Profile:
    """Both ways, fast and slow, and let go, in 9 s."""
    parts = [profiles.staircase(volts, 3, 0.25), profiles.reversals(volts, 4, 0.3), profiles.coast(volts, 2, 0.3)]
    return profiles.joined(*parts, profiles.random(volts, 3.0, seed))


@cache
def recorded(effects: str) -> Recording:
    values = {"kv": PAPER_KV, "ka": PAPER_KA, **HIDDEN[effects]}
    drive = profiles.compact if effects == "warm_up" else short  # which takes its time
    return check(record(values, *drive(12.0, 3), seed=3)[0])


@cache
def fitted(effects: str) -> Fit:
    return fit_again(recorded(effects), effects)


def fit_again(recording: Recording, effects: str) -> Fit:
    return identify([recording], Request(tuple(filter(None, effects.split(","))), SearchConfig(20, 40)))


@pytest.mark.parametrize("units", UNITS)
@pytest.mark.parametrize("effects", keep_fast(HIDDEN, "coulomb_friction,transport_delay"))
def test_identified_parameters_are_the_same_in_other_units(effects: str, units: str) -> None:
    new, old = UNITS[units], fitted(effects)
    fit = fit_again(new.scale(recorded(effects)), effects)
    assert fit.parameters.effects == old.parameters.effects
    for name, value in old.parameters.values.items():
        error = new.value(name, old.standard_errors[name])
        assert abs(fit.parameters.values[name] - new.value(name, value)) < NEAR * error, name
        assert 0.6 * error < fit.standard_errors[name] < 1.5 * error, name
        assert abs(value / (HIDDEN[effects] | {"kv": PAPER_KV, "ka": PAPER_KA})[name] - 1.0) < 1e-3


@pytest.mark.slow
@pytest.mark.parametrize("units", ["1.2 V", "2 s, 48 V, 3.5 rad/s"])
def test_diagnosed_names_are_the_same_in_other_units(units: str) -> None:
    effects, new = "coulomb_friction,transport_delay", UNITS[units]
    found = diagnose([new.scale(recorded(effects))])
    assert {finding.effect for finding in found.findings} == set(effects.split(","))
    for finding in found.findings:
        for name, (value, sigma) in finding.parameters.items():
            assert abs(value - new.value(name, HIDDEN[effects][name])) < 4.0 * sigma
    assert found.verdict.value == "explained"
