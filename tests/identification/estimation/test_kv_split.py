"""kv is split into back-EMF and viscous friction where an effect tells them apart, and only if there is any of it."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from fits import BASE, made, quick
from plant import profiles

from motor_identification.diagnose import diagnose
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.kv_split import can_split_kv, fit_split_kv, is_split_of_motor
from motor_identification.estimation.least_squares import SpeedResiduals
from motor_identification.estimation.problem import make_problem
from motor_identification.identify import identify
from motor_identification.monitoring.model_gap import Model, find_changes, measure_gap
from motor_identification.recording import Recording
from motor_identification.reporting.model_comparison import Identified
from motor_model import model_file
from motor_model.effects import VISCOUS_SHARE

SAG = {"ks": 0.3, "sag": 0.15}
WARM = {"ks": 0.3, "resistance_rise": 0.25, "warm_up_time": 8.0}
EFFECTS = ("coulomb_friction", "supply_sag")


def viscous(values: dict[str, float], share: float, seed: int = 0) -> Recording:
    """A motor of whose kv a share is viscous friction."""
    electric = {"resistance": 2.0, "torque_constant": (1.0 - share) * BASE["kv"]}
    return made({**values, **electric}, profiles.rich(12.0, seed), seed=seed, irregularity=0.003)


def test_it_is_split_once_and_only_beside_what_tells_its_parts_apart() -> None:
    recording = viscous(SAG, 0.3)
    assert not can_split_kv(make_problem([recording], ("coulomb_friction", "coast_drive")))
    problem = make_problem([recording], EFFECTS)
    assert can_split_kv(problem) and not problem.unknowns.splits_kv
    theta = 0.5 * (problem.unknowns.low + problem.unknowns.high)
    split = fit_split_kv(Estimate(problem, theta), SpeedResiduals)
    assert split.problem.unknowns.splits_kv and not can_split_kv(split.problem)
    assert split.problem.with_effects(("coulomb_friction",)).unknowns.names == ("kv", "ka", "ks")
    assert split.parameters.viscous_share == pytest.approx(split.theta[-1])
    for share, is_motor in ((0.97, True), (0.99, False)):  # of the largest
        ended = np.append(split.theta[:-1], share * VISCOUS_SHARE.high)
        assert is_split_of_motor(replace(split, theta=ended)) is is_motor


def test_an_identified_motor_tells_how_much_of_kv_is_viscous_friction_and_its_file_keeps_it(tmp_path: Path) -> None:
    fit = identify([viscous(SAG, 0.3)], quick(*EFFECTS))
    assert fit.parameters.viscous_share == pytest.approx(0.3, abs=0.02)
    assert 0.0 < fit.standard_errors["viscous_share"] < 0.01
    assert fit.parameters.values["sag"] == pytest.approx(0.15, abs=0.005)
    assert fit.residual_rms < 1.1 * fit.noise_floor
    (said,) = (note for note in fit.notes if "viscous" in note)
    share, error = (float(number) for number in said.removeprefix("Of kv, ").split(" % ")[0].split(" ± "))
    assert share == pytest.approx(100.0 * fit.parameters.viscous_share, abs=0.05)
    assert 0.0 <= error - 100.0 * fit.standard_errors["viscous_share"] < 0.1 + 1e-9
    assert said.endswith(" % is viscous friction and the rest back-EMF, which a motor with supply_sag tells apart.")
    assert "viscous_share" not in fit.on_bound
    model = Model(Identified("motor", fit.parameters, fit.standard_errors), fit.residual_rms)
    gap = measure_gap(viscous(SAG, 0.3, seed=1), model)
    assert gap.rms < 1.2 * gap.expected and not find_changes(gap, model)
    whole = replace(fit.parameters, torque_constant=0.0)
    assert measure_gap(viscous(SAG, 0.3, seed=1), Model(Identified("whole", whole, {}))).rms > 2.0 * gap.rms
    model_file.save(tmp_path / "model.yaml", fit.parameters)
    assert model_file.load(tmp_path / "model.yaml") == fit.parameters


def test_a_motor_without_viscous_friction_keeps_kv_whole() -> None:
    fit = identify([viscous(SAG, 0.0)], quick(*EFFECTS))
    assert fit.parameters.torque_constant == 0.0 and not any("viscous" in note for note in fit.notes)


@pytest.mark.slow
@pytest.mark.parametrize(("values", "effect"), [(SAG, "supply_sag"), (WARM, "warm_up")], ids=["sag", "warm"])
def test_viscous_friction_is_not_taken_for_other_effects(values: dict[str, float], effect: str) -> None:
    """With all of kv as back-EMF a sag had three false names beside it, and a warming-up had no name."""
    found = diagnose([viscous(values, 0.3, seed=2)])
    assert {one.effect for one in found.findings} == {"coulomb_friction", effect}
    assert found.verdict.value == "explained"
    assert found.model.parameters.viscous_share == pytest.approx(0.3, abs=0.02)
