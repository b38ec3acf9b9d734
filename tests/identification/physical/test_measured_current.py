"""`identify --physical`: R, L, torque constant, inertia and friction, in every form they go out in."""

from dataclasses import replace
from math import isnan
from pathlib import Path

import numpy as np
import pytest
from electrical import FRICTION, PHYSICAL, known, measured

from motor_identification.estimation.request import PhysicalRequest, Request, SearchConfig
from motor_identification.identify import identify
from motor_identification.reporting.fit_json import fit_to_json
from motor_identification.reporting.fit_model_file import save_model
from motor_identification.reporting.fit_text import list_cautions
from motor_identification.uncertainty.result import Fit
from motor_model.errors import RecordingError
from motor_model.model_file import load

INDUCTANCE = 1.2e-3  # [H]
REQUEST = Request(FRICTION, SearchConfig(16, 30), physical=PhysicalRequest())


@pytest.fixture(scope="module")
def inductive() -> Fit:
    lag = INDUCTANCE / PHYSICAL["resistance"]
    return identify([measured({"electrical_time_constant": lag})], REQUEST)


def test_the_inductance_is_found_unasked(inductive: Fit) -> None:
    physical = inductive.physical
    assert physical is not None and physical.source == "current" and physical.not_identifiable == ()
    for name, true in {**PHYSICAL, "inductance": INDUCTANCE}.items():
        error = physical.standard_errors[name]
        assert abs(physical.values[name] - true) < 3.5 * error and error < 0.02 * true, name
    assert physical.notes == () and 0.0145 < physical.current_noise[0] < 0.0165  # [A] 15 mA, and steps of 12
    assert 0.8 < inductive.residual_rms / inductive.noise_floor < 1.2  # said of the motor with its inductance


def test_json_and_model_file_have_it(inductive: Fit, tmp_path: Path) -> None:
    section = fit_to_json(inductive)["physical"]
    row = section["parameters"]["inertia"]
    assert row["value"] == pytest.approx(1.4e-4, rel=0.01) and 0.0 < row["standard_error"] < 2e-6
    assert row["unit"] == "kg·m²" and section["source"] == "current"
    save_model(tmp_path / "m.yaml", inductive, "now")
    assert load(tmp_path / "m.yaml") == inductive.parameters
    assert "friction_torque:" in (tmp_path / "m.yaml").read_text(encoding="utf-8")


def test_an_inductance_that_does_not_show_is_not_identifiable() -> None:
    physical = identify([known()[0]], REQUEST).physical
    assert physical is not None and physical.not_identifiable == ("inductance",)
    assert isnan(physical.values["inductance"]) and any(
        "inductance is not identifiable" in one for one in physical.notes
    )
    for name, true in PHYSICAL.items():
        assert abs(physical.values[name] - true) < 3.5 * physical.standard_errors[name], name


def test_without_a_current_it_says_what_to_do() -> None:
    recording = replace(known()[0], current=np.full(len(known()[0]), np.nan))
    with pytest.raises(RecordingError, match="or give the armature's resistance with --resistance"):
        identify([recording], REQUEST)


def test_a_current_of_another_quantity_is_told_by_the_limit_of_the_range() -> None:
    """A current that grows with the speed, as no motor's does at a given voltage."""
    recording = known()[0]
    wrong = replace(recording, current=0.1 * recording.voltage + 0.01 * recording.speed)
    fit = identify([wrong], REQUEST)
    assert fit.physical is not None
    assert any("torque constant is at the limit of its search range" in one for one in fit.physical.notes)
    assert set(fit.on_bound) <= set(fit.parameters.values) and list_cautions(fit) is not None
