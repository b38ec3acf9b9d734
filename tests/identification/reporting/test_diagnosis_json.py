"""A diagnosis in JSON: the promised form, and true to the numbers."""

import json
from dataclasses import replace
from math import nan

import pytest

from motor_identification.diagnosis.result import Diagnosis, Imitated, Nearest, Verdict
from motor_identification.discrepancy.structure import Structure
from motor_identification.noise.error_model import Disturbance
from motor_identification.reporting.diagnosis_json import diagnosis_to_json


def test_json_is_the_promised_form(found: Diagnosis, variants: dict[Verdict, Diagnosis]) -> None:
    nameless = replace(found, model=replace(found.model, standard_errors=found.model.standard_errors | {"ks": nan}))
    content = json.loads(json.dumps(diagnosis_to_json(nameless), allow_nan=False))
    assert list(content) == [
        "bags", "validation", "noise_floor", "sensor_floor", "disturbance", "gain_scatter", "structure",
        "gap_before", "gap_after", "held_out", "verdict", "undetectable", "not_testable", "imitated", "undetermined",
        "nearest", "suggested_experiment", "time_limit", "baseline", "findings", "model", "notes",
    ]  # fmt: skip
    assert content["bags"] == ["train.bag"] and content["validation"] == ["held_out.bag"]
    assert content["gap_before"] == found.gap_before and content["noise_floor"] == found.noise_floor
    assert content["verdict"] == "explained" and content["suggested_experiment"] is None
    assert content["baseline"]["effects"] == [] and set(content["baseline"]["parameters"]) == {"kv", "ka"}
    assert content["model"]["parameters"]["ks"] == {
        "value": found.model.parameters.values["ks"], "standard_error": None
    }  # fmt: skip
    assert content["notes"] == list(nameless.model.notes)
    (finding,) = content["findings"]
    assert list(finding) == [
        "effect", "gap_before", "gap_after", "where", "parameters", "alternatives", "ambiguous_with",
        "sensor_may_lag", "suggested_experiment",
    ]  # fmt: skip
    assert finding["parameters"]["ks"]["value"] == pytest.approx(0.4, abs=0.002)
    assert list(finding["alternatives"][0]) == ["effect", "gap_after"]
    assert diagnosis_to_json(variants[Verdict.UNDECIDED])["findings"][0]["suggested_experiment"] == "coast"
    assert finding["sensor_may_lag"] is False
    doubted = replace(found, findings=(replace(found.findings[0], sensor_may_lag=True),))
    assert diagnosis_to_json(doubted)["findings"][0]["sensor_may_lag"] is True
    assert content["imitated"] is None
    beside = diagnosis_to_json(replace(found, imitated=Imitated("dead_zone", 0.35, 0.142)))["imitated"]
    assert beside == {"effect": "dead_zone", "size": 0.35, "kv": 0.142}
    assert content["nearest"] is None
    nearest = diagnosis_to_json(replace(found, nearest=Nearest(("dead_zone", "coast_drive"), 11.25)))["nearest"]
    assert nearest == {"effects": ["dead_zone", "coast_drive"], "gap": 11.25}


def test_a_random_torque_and_what_curves_predict(found: Diagnosis) -> None:
    torque = Disturbance(0.15, 0.004, 0.05, nan)
    left = (Structure("past", 0.4, 90.0, cause="a ramp"), Structure("speed", 0.2, 12.0))
    content = diagnosis_to_json(replace(found, disturbance=torque, structure=left, sensor_floor=0.1))
    assert diagnosis_to_json(found)["disturbance"] is None and diagnosis_to_json(found)["structure"] == []
    assert content["sensor_floor"] == 0.1
    assert content["disturbance"]["rms_voltage"] == {"value": 0.15, "standard_error": 0.004}
    assert content["disturbance"]["correlation_time"] == {"value": 0.05, "standard_error": None}
    assert [one["variable"] for one in content["structure"]] == ["drive", "speed"]
    assert content["structure"][1] == {"variable": "speed", "share": 0.2, "significance": 12.0, "cause": None}
    assert content["structure"][0]["cause"] == "a ramp"
    above = replace(found, structure=(Structure("spectrum", 1.45, 189.0),))
    assert diagnosis_to_json(above)["structure"][0]["share"] == 1.0  # of all, at most
    assert content["not_testable"] == content["undetectable"]
    assert content["gain_scatter"] is None
    assert diagnosis_to_json(replace(found, gain_scatter=0.021))["gain_scatter"] == 0.021
