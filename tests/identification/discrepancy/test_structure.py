"""What a model lacks is told from what is random, and in which variable it is; ridge and lines on made-up numbers."""

from collections.abc import Sequence
from dataclasses import replace
from typing import cast

import numpy as np
import pytest
from plant import profiles, record
from tiers import mark_slow

from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.selection.selection import begin_selection
from motor_identification.discrepancy import structure
from motor_identification.discrepancy.free_curves import OF_SPEED, Reach
from motor_identification.discrepancy.motion_history import MotionHistory
from motor_identification.discrepancy.rest import Rest
from motor_identification.discrepancy.structure import (
    CERTAIN,
    LEAST_SHARE,
    Structure,
    find_structure,
    rank,
    solve_ridge,
)
from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.search.global_search import search_globally
from motor_identification.estimation.search.multistart import SearchConfig
from motor_identification.noise.error_data import ErrorData
from motor_identification.noise.error_model import ErrorModel, Lag
from motor_identification.recording import check
from motor_identification.validation.hold_out import make_hold_out


def fitted(hidden: dict[str, float], effects: tuple[str, ...] = (), torque: float = 0.1) -> Model:
    """A model with some effects, fitted to a motor with more."""
    values = {"kv": 0.07, "ka": 0.0055, "random_torque": torque, "random_torque_seed": 2.0} | hidden
    recording = check(record(values, *profiles.rich(12.0, 4), seed=4, irregularity=0.005, disc_seed=4)[0])
    hold_out = make_hold_out([recording], [])
    estimate, _search = search_globally(hold_out.restrict(make_problem([recording], effects)), SearchConfig())
    return begin_selection(estimate, hold_out, 1).model


def test_a_random_torque_is_no_structure() -> None:
    model = fitted({})
    assert model.above_floor and model.complete
    assert all(one.share < 0.05 for one in model.structure)
    assert 0.9 < model.held.gap / model.noise_floor < 1.1
    disturbance = model.estimate_disturbance()
    assert disturbance is not None and 0.08 < disturbance.rms_voltage < 0.12


@pytest.mark.parametrize(
    ("hidden", "effects", "variables"),
    [
        ({"speed_wave": 0.4, "speed_wave_scale": 12.0}, (), {"speed"}),
        mark_slow({"ks": 0.4, "angle_friction": 0.8}, ("coulomb_friction",), {"angle"}),
        mark_slow({"load_friction": 0.15}, (), {"drive", "speed_voltage", "past"}),
        mark_slow({"current_limit_voltage": 8.0}, (), {"drive", "speed_voltage"}),
    ],
    ids=["speed", "angle", "drive", "limited current"],
)
def test_what_is_missing_is_found_in_its_variable(
    hidden: dict[str, float], effects: tuple[str, ...], variables: set[str]
) -> None:
    model = fitted(hidden, effects)
    assert not model.complete
    assert model.structure[0].variable in variables
    assert model.structure[0].share > 2.0 * LEAST_SHARE
    assert model.unpredictable_gap < 0.9 * model.held.gap


@pytest.mark.parametrize(
    ("share", "significance", "certain"),
    [
        (LEAST_SHARE + 0.01, CERTAIN + 0.1, True),
        (LEAST_SHARE - 0.01, CERTAIN + 0.1, False),
        (LEAST_SHARE + 0.01, CERTAIN - 0.1, False),
    ],
)
def test_structure_is_large_and_significant(share: float, significance: float, certain: bool) -> None:
    assert Structure("speed", share, significance).certain == certain
    # What takes an effect's place is relevant, as that was, however small its share is.
    assert Structure("past", 0.1 * share, significance, relevant=True).certain == (significance > CERTAIN)


@pytest.mark.parametrize(("motion", "first"), [(0.83, "past"), (0.52, "past"), (0.48, "time"), (0.08, "time")])
def test_time_comes_first_only_where_no_motion_tells_half_as_much(motion: float, first: str) -> None:
    """Of a bridge that slews, curves over time predicted 1.04 of what was left, over the motion before 0.83."""
    found = [Structure("time", 1.0, 1100.0), Structure("past", motion, 880.0), Structure("angle", 0.02, 2000.0)]
    ranked = rank(found)
    assert ranked[0].variable == first
    assert [one.variable for one in rank(found[::-1])] == [one.variable for one in ranked]
    assert ranked[-1].variable == ("past" if motion < LEAST_SHARE else "angle")
    above = replace(found[0], variable="spectrum", share=1.45)  # as the white residual tells it, which is no share
    assert rank([above, *found[1:]])[0].variable == ("past" if first == "past" else "spectrum")
    assert above.most == 1.0 and found[1].most == motion


@pytest.mark.slow
@pytest.mark.parametrize(("angle_friction", "certain"), [(0.6, True), (0.0, False)])
def test_a_friction_over_the_angle_is_told_from_a_disc_beside_a_strong_torque(
    angle_friction: float, certain: bool
) -> None:
    """Beside a torque of 2.5 % of the supply it is a few per cent of what is left, and a tenth of what is white."""
    model = fitted({"ks": 0.45, "angle_friction": angle_friction}, ("coulomb_friction",), torque=0.3)
    assert [one.variable for one in model.structure if one.certain] == (["angle"] if certain else [])
    (told,) = (one.significance for one in model.structure if one.variable == "angle")
    assert (told > 10.0 * CERTAIN) is certain and told < 60.0 * CERTAIN


@pytest.mark.parametrize("scale", [0.0, 0.3])
def test_ridge_finds_what_is_there_and_nothing_else(scale: float) -> None:
    random = np.random.default_rng(7)
    x = random.normal(size=(2000, 20))
    true = scale * random.normal(size=20)
    z = x @ true + random.normal(size=2000)
    knots = solve_ridge(x.T @ x, x.T @ z)
    assert np.sqrt(np.mean((knots - true) ** 2)) < (0.03 if scale else 0.008)


@pytest.mark.slow
@pytest.mark.parametrize(("slew", "random"), [(0.0, True), (150.0, False)])
def test_what_a_stand_in_leaves_is_no_random_torque(slew: float, random: bool) -> None:
    """A bridge that slews, which an inductance stands in for, leaves rare large errors and nothing between them."""
    model = fitted({"slew_rate": slew} if slew else {}, ("armature_inductance",), torque=0.0 if slew else 0.1)
    assert model.complete is random
    assert any(one.certain for one in model.structure) is not random


@pytest.mark.parametrize(("simulated", "certain"), [(0.0, False), (200.0, True)])
def test_what_only_the_measured_speed_predicts_is_its_own_disturbance(
    monkeypatch: pytest.MonkeyPatch, simulated: float, certain: bool
) -> None:
    """A slow torque is in the measured speed, and therefore predicted by it; the model's speeds have none."""
    nothing = np.zeros(0, dtype=bool)
    measured, model = cast(MotionHistory, "measured"), cast(MotionHistory, "model's")
    rest = Rest(cast(ErrorData, None), measured, lambda: model, nothing, nothing)
    gains = {"measured": 100.0, "model's": simulated}

    def judged(name: str, rests: Sequence[Rest], *_: object) -> Structure:
        return Structure(name, 0.5, gains[str(rests[0].history)] if name in OF_SPEED else 0.0)

    monkeypatch.setattr(structure, "_judge_family", judged)
    monkeypatch.setattr(structure, "measure_reach", lambda histories, time: Reach(1.0, 1.0, 1.0, 1.0, time))
    monkeypatch.setattr(structure, "find_lines", lambda *_: ())
    found = find_structure([rest], [], ErrorModel(0.0, 0.0, 0.0, 1.0), Lag(1.0, 1.0))
    assert [one.certain for one in found if one.variable in OF_SPEED] == [certain] * len(OF_SPEED)
