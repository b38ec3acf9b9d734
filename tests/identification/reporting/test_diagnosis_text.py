"""A diagnosis in words and JSON: complete, and true to the numbers."""

import json
import re
from dataclasses import replace
from math import nan

import pytest

from motor_identification.diagnosis.result import Diagnosis, Verdict
from motor_identification.reporting.diagnosis_json import as_json
from motor_identification.reporting.diagnosis_text import as_table, digits, named, quantity, summary, unseen
from motor_model.effects import EFFECTS


def test_summaries(variants: dict[Verdict, Diagnosis]) -> None:
    said = {verdict: summary(one) for verdict, one in variants.items()}
    one = variants[Verdict.EXPLAINED]
    ratio = f"{one.gap_after / one.noise_floor:.2g} × the noise floor of {one.noise_floor:.3g}"
    fell = f"gap on held-out motion falls from {one.gap_before:.3g} to {one.gap_after:.3g} rad/s ({ratio})"
    assert re.match(r"Coulomb friction \(ks = 0\.4\d* ± [\d.e-]+ V\) was missing\.", said[Verdict.EXPLAINED])
    assert said[Verdict.EXPLAINED].endswith(f"With it, the {fell}.")
    assert said[Verdict.NOTHING_MISSING] == (
        f"Nothing is missing: the gap on held-out motion is {one.gap_after:.3g} rad/s, {ratio}."
    )
    assert said[Verdict.UNDECIDED] == (
        "Coulomb friction, dead zone or load bias is missing, and this recording cannot tell which. "
        f"The {fell}. Record the profile 'coast' and diagnose both recordings together."
    )
    assert said[Verdict.UNEXPLAINED].startswith("Something is missing that no effect of the table explains: the gap")
    assert f"It is worst {one.findings[0].where}. As a load over the speed it is -0.3" in said[Verdict.UNEXPLAINED]


def test_an_undecided_recording_without_findings_says_what_it_hides(variants: dict[Verdict, Diagnosis]) -> None:
    one = replace(variants[Verdict.NOTHING_MISSING], verdict=Verdict.UNDECIDED, undetectable=("dead_zone", "backlash"))
    assert "Nothing is missing that this recording could show" in summary(one)
    assert summary(one).endswith("It could not have shown dead zone or backlash.")
    assert unseen(tuple(effect.name for effect in EFFECTS)).endswith(f" and {len(EFFECTS) - 6} others")


def test_numbers_have_the_digits_they_deserve() -> None:
    assert [digits(1.0, 0.1), digits(1.0, 1e-4), digits(1.0, 1e-12), digits(0.0, 1.0), digits(1.0, nan)] == [
        3,
        6,
        8,
        4,
        4,
    ]
    assert quantity("ks", 0.40001, 0.002) == "ks = 0.4 ± 0.002 V"
    assert quantity("delay", 0.1, nan) == "delay = 0.1 s (not identifiable)"
    assert named("coulomb_friction") == "Coulomb friction"


def test_the_table_has_the_numbers(found: Diagnosis) -> None:
    lines = as_table(found).splitlines()
    assert re.split(r"\s{2,}", lines[0]) == ["effect", "gap [rad/s]", "× floor", "parameters"]
    assert re.split(r"\s{2,}", lines[1])[1] == f"{found.gap_before:.4g}"
    assert lines[2].startswith("+ coulomb_friction") and f"{found.gap_after:.4g}" in lines[2] and "ks = 0.4" in lines[2]
    assert lines[3].startswith("noise floor") and lines[4] == f"coulomb_friction was seen {found.findings[0].where}"


def test_json_is_the_promised_form(found: Diagnosis, variants: dict[Verdict, Diagnosis]) -> None:
    nameless = replace(found, model=replace(found.model, standard_errors=found.model.standard_errors | {"ks": nan}))
    content = json.loads(json.dumps(as_json(nameless), allow_nan=False))
    assert list(content) == [
        "bags", "validation", "noise_floor", "gap_before", "gap_after", "verdict", "undetectable",
        "suggested_experiment", "baseline", "findings", "model",
    ]  # fmt: skip
    assert content["bags"] == ["train.bag"] and content["validation"] == ["held_out.bag"]
    assert content["gap_before"] == found.gap_before and content["noise_floor"] == found.noise_floor
    assert content["verdict"] == "explained" and content["suggested_experiment"] is None
    assert content["baseline"]["effects"] == [] and set(content["baseline"]["parameters"]) == {"kv", "ka"}
    assert content["model"]["parameters"]["ks"] == {
        "value": found.model.parameters.values["ks"], "standard_error": None
    }  # fmt: skip
    (finding,) = content["findings"]
    assert list(finding) == [
        "effect", "gap_before", "gap_after", "where", "parameters", "alternatives", "ambiguous_with",
        "suggested_experiment",
    ]  # fmt: skip
    assert finding["parameters"]["ks"]["value"] == pytest.approx(0.4, abs=0.002)
    assert list(finding["alternatives"][0]) == ["effect", "gap_after"]
    assert as_json(variants[Verdict.UNDECIDED])["findings"][0]["suggested_experiment"] == "coast"
