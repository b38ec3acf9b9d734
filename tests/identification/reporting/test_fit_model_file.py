"""A fit as a model file: the parameters to the last bit, their errors, and where they came from."""

from dataclasses import replace
from math import nan
from pathlib import Path

import pytest
import yaml

from motor_identification.diagnosis.result import Diagnosis
from motor_identification.reporting.fit_model_file import save_model
from motor_model.errors import MotorError
from motor_model.model_file import load


def test_a_fit_comes_back_from_its_file(found: Diagnosis, tmp_path: Path) -> None:
    fit = replace(found.model, standard_errors=found.model.standard_errors | {"ka": nan}, not_identifiable=("ka",))
    save_model(tmp_path / "model.yaml", fit, "2026-01-01T00:00:00+00:00")
    assert load(tmp_path / "model.yaml") == fit.parameters
    content = yaml.safe_load((tmp_path / "model.yaml").read_text(encoding="utf-8"))
    assert content["origin"]["bags"] == ["train.bag"] and content["origin"]["not_identifiable"] == ["ka"]
    assert content["origin"]["created"] == "2026-01-01T00:00:00+00:00"
    assert content["parameters"]["ks"]["standard_error"] == pytest.approx(fit.standard_errors["ks"])
    assert content["parameters"]["ka"]["standard_error"] is None  # nobody knows it


def test_a_file_that_cannot_be_written_is_said(found: Diagnosis, tmp_path: Path) -> None:
    with pytest.raises(MotorError, match="nowhere"):
        save_model(tmp_path / "nowhere" / "model.yaml", found.model, "")
