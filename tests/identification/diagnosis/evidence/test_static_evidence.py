"""No more static effects are named than a recording has places of voltage and speed to tell them apart."""

from functools import cache
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from plant import profiles, record
from recorded import as_speed, without_count
from tiers import mark_slow

from motor_identification.diagnose import diagnose
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.evidence.static_evidence import count_places, count_static, find_untold
from motor_identification.identify import Request
from motor_identification.recording import Recording
from motor_identification.validation.held_out import HeldOut
from motor_identification.validation.hold_out import make_hold_out
from motor_model.effects import LAGS
from motor_model.parameters import PAPER_KA, PAPER_KV

HIDDEN = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.8, "coast_share": 0.9, "dead_zone_voltage": 0.9}
LEVELS = (3.8, 0.0, 12.0, 0.0, -12.0, 0.0)


@cache
def staying(levels: tuple[float, ...] = LEVELS, each: float = 4.0, torque: float = 0.0) -> Recording:
    """Speeds, ten a second, of a motor that stays at each of some levels, beside a random torque [V]."""
    profile = profiles.pieces(levels, each)
    random = {"random_torque": torque, "random_torque_time": 0.5, "random_torque_seed": 6.0} if torque else {}
    recording, _ = record(HIDDEN | random, *profile, sample_rate=10.0, edges=1264, single_channel=False)
    return without_count(as_speed(recording))


def judged(recording: Recording, seen: bool = True, confirms: bool = True) -> HeldOut:
    hold_out = make_hold_out([recording], [])
    (data,) = hold_out.problem.intervals
    none = np.zeros(len(data.time))
    everything = (np.ones(len(data.first), np.bool_),)
    return HeldOut((recording,), (data,), (none,), None, everything, 0, (), seen, confirms)  # type: ignore[arg-type]


@pytest.mark.parametrize(("levels", "places"), [(LEVELS, 3), ((12.0,), 1), mark_slow(tuple(np.arange(1.0, 13.0)), 8)])
def test_places_are_where_a_motor_stays(levels: tuple[float, ...], places: int) -> None:
    """Rest at 0 V is none; of twelve levels some are within a fifth of the largest of each other."""
    assert count_places(judged(staying(levels))) == places


@pytest.mark.slow
def test_a_motor_that_hardly_stays_passes_many_places() -> None:
    swinging = staying(tuple(9.0 * np.sin(0.5 * np.arange(100.0))), 0.3)
    assert 8 < count_places(judged(swinging)) < 40


def stub(effects: tuple[str, ...], rms_voltage: float = 0.1, seen: bool = True, confirms: bool = True) -> Model:
    held = judged(staying(), seen, confirms)
    return cast(Model, SimpleNamespace(effects=effects, held=held, errors=SimpleNamespace(rms_voltage=rms_voltage)))


@pytest.mark.parametrize(
    ("effects", "untold"),
    [
        (("coulomb_friction", "coast_drive"), False),
        (("coulomb_friction", "coast_drive", "dead_zone"), True),  # kv is the fourth of three places
        (("coulomb_friction", "static_friction"), True),  # which has two
        (("coast_drive", "dead_zone", "load_step"), True),  # a load from an instant on
        (("coast_drive", "dead_zone", *LAGS, "torque_ripple", "backlash", "warm_up"), False),
    ],
)
def test_static_parameters_are_fewer_than_places(effects: tuple[str, ...], untold: bool) -> None:
    static = {"coulomb_friction", "static_friction", "coast_drive", "dead_zone", "load_step"}
    assert set(find_untold(stub(effects))) == (set(effects) & static if untold else set())


@pytest.mark.parametrize("other", [{"rms_voltage": 0.0}, {"seen": False}, {"confirms": False}])
def test_motion_without_a_torque_tells_and_what_is_held_out_and_one_steps_shape(other: dict[str, Any]) -> None:
    assert find_untold(stub(("coulomb_friction", "coast_drive", "dead_zone"), **other)) == ()


@pytest.mark.slow
@pytest.mark.parametrize("torque", [0.0, 0.2])
def test_three_levels_beside_a_torque_do_not_tell_three_static_effects(torque: float) -> None:
    """Exact motion between the levels does."""
    found = diagnose([staying(torque=torque)], [], Request(()))
    named = count_static(one.effect for one in found.findings)
    assert named < 3 if torque else named == 3
    assert (found.disturbance is not None) == (torque > 0.0)
