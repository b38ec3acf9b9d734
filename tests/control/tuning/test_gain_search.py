"""Gains by their consequences: the ripple and the time constant they are searched for come out."""

import pytest
from tuning_bench import BARE

from motor_control.tuning.gain_search import quiet_kp, time_constant_of, wished_gains
from motor_control.tuning.measured_speed import Measured
from motor_control.tuning.speed_feedback import Encoder, cancelling
from motor_model.errors import MotorError

SIGHT, SPEEDS = Measured(Encoder(slot_irregularity=0.02)), (10.0, 40.0, 150.0)


@pytest.mark.parametrize("most", [0.01, 0.02])
def test_the_largest_gain_that_is_quiet_enough(most: float) -> None:
    kp = quiet_kp(SIGHT, BARE, SPEEDS, most, 1.0)

    def worst(kp: float) -> float:
        return max(SIGHT.ripple(BARE, cancelling(BARE, kp), speed).speed for speed in SPEEDS)

    assert worst(kp) <= 1.005 * most < worst(1.02 * kp)


def test_the_largest_there_is_where_nothing_swings() -> None:
    assert quiet_kp(Measured(Encoder(slot_irregularity=0.0)), BARE, SPEEDS, 0.02, 0.1) == 0.1


@pytest.mark.parametrize("wanted", [0.04, 0.2])
def test_a_wished_time_constant_is_met(wanted: float) -> None:
    plant = SIGHT.plant(BARE, 10.0)
    gains = wished_gains(SIGHT, plant, wanted, SIGHT.fastest(BARE, SPEEDS))
    assert time_constant_of(SIGHT, plant, gains) == pytest.approx(wanted, rel=1e-3)
    assert gains.ki / gains.kp == pytest.approx(BARE.kv / BARE.ka)


@pytest.mark.parametrize(("wanted", "words"), [(0.002, "too short for this loop"), (1e4, "too long for this law")])
def test_wishes_that_cannot_be_met_are_refused_with_what_can(wanted: float, words: str) -> None:
    with pytest.raises(MotorError, match=words):
        wished_gains(SIGHT, SIGHT.plant(BARE, 10.0), wanted, SIGHT.fastest(BARE, SPEEDS))


def test_an_encoder_that_no_gain_suits_is_refused() -> None:
    with pytest.raises(MotorError, match="No gains keep the speed ripple below"):
        quiet_kp(Measured(Encoder(slot_irregularity=0.5)), BARE, SPEEDS, 1e-7, 1.0)
