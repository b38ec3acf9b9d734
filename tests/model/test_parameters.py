"""A motor in numbers: what is accepted, what is refused and how."""

import re
from math import inf, nan

import numpy as np
import pytest

from motor_model.effects import INDEX, SPECS, VECTOR_NAMES
from motor_model.errors import ModelError
from motor_model.parameters import Parameters, paper_motor

BASE = {"kv": 0.07, "ka": 0.005}
FRICTION = BASE | {"ks": 0.5}
STATIC = FRICTION | {"breakaway_voltage": 0.9, "stribeck_speed": 5.0}


def test_a_motor_knows_its_gain_and_time_constant() -> None:
    motor = paper_motor()
    assert motor.gain == pytest.approx(174.097 / 12.0, rel=1e-12)
    assert 0.0797 < motor.time_constant < 0.0799
    assert (motor.effects, motor.max_voltage) == ((), 12.0)


def test_an_effect_that_is_absent_is_off() -> None:
    motor = Parameters(FRICTION, ("coulomb_friction",), 24.0)
    assert (motor.value("ks"), motor.value("drag"), motor.value("reverse_gain")) == (0.5, 0.0, 1.0)
    assert motor.value("limit_voltage") == inf
    vector = motor.vector()
    assert vector.shape == (len(VECTOR_NAMES),) and vector.dtype == np.float64
    assert (vector[INDEX["kv"]], vector[INDEX["ks"]], vector[INDEX["max_voltage"]]) == (0.07, 0.5, 24.0)
    off = np.array([spec.off for spec in SPECS] + [24.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0])
    assert list(np.flatnonzero(vector != off)) == [INDEX["kv"], INDEX["ka"], INDEX["ks"]]


REFUSED = [
    (BASE, ("coulomb_friction",), 12.0, "the model lacks ks; give"),
    ({"kv": 0.07}, (), 12.0, "the model lacks ka; give"),
    (FRICTION | {"breakaway_voltage": 0.9}, ("static_friction",), 12.0, "the model lacks stribeck_speed"),
    (FRICTION, (), 12.0, "'ks' is given, but its effect is not listed"),
    (BASE | {"Ks": 1.0}, (), 12.0, "'Ks' is not a parameter of any effect; this model's are kv, ka"),
    (BASE | {"ka": -0.005}, (), 12.0, "ka = -0.005 V·s²/rad is not physical: it must be at least 0"),
    (BASE | {"ka": 0.0}, (), 12.0, "kv and ka must be positive"),
    (BASE | {"kv": 0.0}, (), 12.0, "kv and ka must be positive"),
    (BASE | {"kv": nan}, (), 12.0, "kv = nan V·s/rad must be a finite number"),
    (BASE | {"ka": inf}, (), 12.0, "ka = inf V·s²/rad must be a finite number"),
    (BASE | {"bias_voltage": nan}, ("load_bias",), 12.0, "bias_voltage = nan V must be a finite number"),
    (FRICTION | {"ks": -0.1}, ("coulomb_friction",), 12.0, "ks = -0.1 V is not physical"),
    (BASE | {"coast_share": 1.1}, ("coast_drive",), 12.0, "coast_share = 1.1 – is not physical: it must be 0 to 1"),
    (STATIC | {"stribeck_speed": 0.0}, ("static_friction",), 12.0, "stribeck_speed = 0 rad/s is not physical"),
    (BASE, (), 0.0, "max_voltage = 0 V must be positive"),
    (BASE, (), nan, "max_voltage = nan V must be positive"),
    (BASE, ("gravity",), 12.0, "'gravity' is not an effect"),
]


@pytest.mark.parametrize(("values", "effects", "most", "sentence"), REFUSED, ids=[row[3][:40] for row in REFUSED])
def test_what_is_no_motor_is_refused_in_a_sentence(
    values: dict[str, float], effects: tuple[str, ...], most: float, sentence: str
) -> None:
    with pytest.raises(ModelError, match=re.escape(sentence)) as caught:
        Parameters(values, effects, most)
    assert str(caught.value).endswith(".") and "\n" not in str(caught.value)


def test_signed_parameters_may_be_negative() -> None:
    motor = Parameters(BASE | {"bias_voltage": -0.4}, ("load_bias",))
    assert motor.values["bias_voltage"] == -0.4


def test_a_motor_does_not_hold_less_than_it_slides() -> None:
    values = {"kv": 0.07, "ka": 0.005, "ks": 0.5, "breakaway_voltage": 0.4, "stribeck_speed": 3.0}
    with pytest.raises(ModelError, match="breakaway_voltage must be at least ks"):
        Parameters(values, ("static_friction",))
    assert Parameters(values | {"breakaway_voltage": 0.5}, ("static_friction",)).value("breakaway_voltage") == 0.5
