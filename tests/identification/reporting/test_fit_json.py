"""A fit in JSON: the promised form, null where there is no number."""

import json
from dataclasses import replace
from math import nan

from motor_identification.diagnosis.result import Diagnosis
from motor_identification.reporting.fit_json import fit_to_json
from motor_identification.reporting.fit_text import summarize_fit


def test_json_is_the_promised_form(found: Diagnosis) -> None:
    fit = replace(found.model, r_squared=nan, standard_errors=found.model.standard_errors | {"ka": nan})
    content = json.loads(json.dumps(fit_to_json(fit), allow_nan=False))
    assert {"model", "residual_rms", "noise_floor", "r_squared", "not_identifiable", "duration", "evaluations"} <= set(
        content
    )
    assert content["bags"] == ["train.bag"] and content["model"]["effects"] == ["coulomb_friction"]
    ks = content["model"]["parameters"]["ks"]
    assert ks == {"value": fit.parameters.value("ks"), "standard_error": fit.standard_errors["ks"]}
    assert content["model"]["parameters"]["ka"]["standard_error"] is None and content["r_squared"] is None
    assert content["residual_rms"] == fit.residual_rms and content["noise_floor"] == fit.noise_floor
    assert content["suggested_experiment"] is None and content["on_bound"] == []
    assert content["message"] == summarize_fit(fit)
