"""What a fit says besides its numbers: what the recording leaves open, what ended on a bound, notes and names."""

import json
import re
from dataclasses import replace
from math import isnan
from pathlib import Path

import numpy as np
import pytest
from fits import made, off, quick
from plant import profiles
from recorded import as_speed

from motor_identification.identify import identify
from motor_identification.recording import check
from motor_identification.reporting.fit_json import fit_to_json
from motor_identification.reporting.fit_model_file import save_model
from motor_identification.reporting.fit_text import TOO_LARGE, format_fit, list_cautions, summarize_fit
from motor_model.model_file import load


def test_one_level_does_not_tell_friction_from_gain_and_says_so() -> None:
    fit = identify([made({"ks": 0.5}, profiles.step(10.0, 1.0), seed=1)], quick("coulomb_friction"))
    assert set(fit.not_identifiable) >= {"kv", "ks"}
    assert isnan(fit.standard_errors["kv"]) and isnan(fit.standard_errors["ks"])
    assert fit.suggested_experiment == "ramps"
    text = summarize_fit(fit)
    assert "(not identifiable)" in text and re.search(r"This recording does not determine kv.* separately\.", text)
    assert "Record the profile 'ramps' and fit both recordings together." in text
    assert "not identifiable" in format_fit(fit)
    content = fit_to_json(fit)
    assert content["model"]["parameters"]["ks"]["standard_error"] is None
    assert "NaN" not in json.dumps(content, allow_nan=False)


def test_one_way_does_not_tell_friction_from_a_load_and_says_so() -> None:
    random = np.random.default_rng(1)
    drive = profiles.pieces(np.where(random.random(60) < 0.5, 4.0, 9.0), 0.05)
    fit = identify([made({"ks": 0.5, "delay": 0.005}, drive, seed=1)], quick("coulomb_friction", "transport_delay"))
    assert set(fit.not_told_apart["coulomb_friction"]) >= {"load_bias", "dead_zone"}
    assert "transport_delay" not in fit.not_told_apart
    assert max(map(abs, off(fit, {"ks": 0.5, "delay": 0.005}).values())) < 1e-3
    (said, *_) = list_cautions(fit)
    assert said.startswith("This recording cannot distinguish the friction level (ks) from a constant load (load_bias)")
    assert fit_to_json(fit)["not_told_apart"]["coulomb_friction"][:2] == ["load_bias", "dead_zone"]
    both_ways = identify([made({"ks": 0.5}, profiles.staircase(12.0, 4, 0.25), seed=1)], quick("coulomb_friction"))
    assert both_ways.not_told_apart == {} and list_cautions(both_ways) == ()


def test_a_parameter_on_the_edge_of_its_box_is_said() -> None:
    """A motor whose friction takes more than the box has."""
    fit = identify([made({"delay": 0.13}, profiles.step(10.0, 1.0), seed=0)], quick("transport_delay"))
    assert fit.on_bound["delay"] and fit.parameters.values["delay"] == pytest.approx(0.1, rel=1e-3)
    assert any(
        said == "delay = 0.1 s is the limit of its search range: do not trust the value; fit without transport_delay."
        for said in list_cautions(fit)
    )
    assert "at the limit of its range" in format_fit(fit) and "delay" in fit_to_json(fit)["on_bound"]
    absent = identify([made({}, profiles.staircase(12.0, 2, 0.2), seed=0)], quick("coulomb_friction"))
    assert not absent.on_bound["ks"] and absent.parameters.values["ks"] < 1e-3  # no friction is an answer


def test_constant_speed_says_nothing_of_inertia_and_has_no_r_squared() -> None:
    steady = made({}, profiles.step(10.0, 3.0), seed=0).between(2.0, 3.0)
    fit = identify([check(steady)], quick())
    assert off(fit, {})["kv"] == pytest.approx(0.0, abs=1e-4)
    assert "ka" in fit.not_identifiable or fit.on_bound["ka"]
    level = as_speed(steady)
    flat = identify([check(replace(level, speed=np.full(len(level), 5.0)))], quick())
    assert isnan(flat.r_squared) and fit_to_json(flat)["r_squared"] is None
    assert "ka" in flat.not_identifiable and "kv" not in flat.not_identifiable
    json.dumps(fit_to_json(flat), allow_nan=False)


def test_a_residual_well_above_the_noise_is_said() -> None:
    """From twice the noise floor on; where the floor is not known, nobody can tell."""
    fit = identify([made({}, profiles.staircase(12.0, 2, 0.2), seed=0)], quick())
    assert list_cautions(fit) == ()
    assert list_cautions(replace(fit, residual_rms=1.99 * fit.noise_floor)) == ()
    assert list_cautions(replace(fit, residual_rms=2.04 * fit.noise_floor)) == (TOO_LARGE.format("2"),)
    assert list_cautions(replace(fit, noise_floor=0.0)) == ()
    assert "(noise level unknown)" in summarize_fit(replace(fit, noise_floor=0.0))


def test_notes_and_names_come_through(tmp_path: Path) -> None:
    recording = replace(made({}, profiles.step(10.0, 0.5), seed=0, name="bag"), notes=("bag was cut off.",))
    stages: list[tuple[str, float]] = []
    fit = identify([recording], quick(), lambda stage, share: stages.append((stage, share)))
    assert fit.notes == ("bag was cut off.",) and summarize_fit(fit).endswith(" bag was cut off.")
    shares = [share for _, share in stages]
    assert shares == sorted(shares) and 0.0 < shares[0] < 0.1 and stages[-1] == ("done", 1.0)
    save_model(tmp_path / "model.yaml", fit, "2026-01-01T00:00:00+00:00")
    assert load(tmp_path / "model.yaml") == fit.parameters


@pytest.mark.parametrize(("times", "said"), [(0.9, False), (1.25, False), (1.4, True)])
def test_a_residual_that_the_encoder_explains_lacks_nothing(times: float, said: bool) -> None:
    """However it repeats itself: in a closed loop the encoder's own pattern comes back through the controller."""
    fit = identify([made({}, profiles.staircase(12.0, 2, 0.2), seed=0)], quick())
    left = replace(fit.whiteness, p_value=1e-9, autocorrelation=0.8)
    fit = replace(fit, whiteness=left, residual_rms=times * fit.noise_floor)
    assert any("an effect is missing" in caution for caution in list_cautions(fit)) is said
