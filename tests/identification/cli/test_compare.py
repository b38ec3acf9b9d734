"""`compare` reads what identify writes, errors and all."""

from pathlib import Path

import pytest

from motor_identification.cli.compare import main
from motor_model.model_file import load_errors, save
from motor_model.parameters import Parameters


def test_two_files_side_by_side(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    left, right = (str(tmp_path / f"{side}.yaml") for side in ("left", "right"))
    save(left, Parameters({"kv": 0.5, "ka": 0.03}), {"kv": 0.001})
    save(right, Parameters({"kv": 0.52, "ka": 0.03}), {"kv": 0.001, "ka": 0.0001})
    assert load_errors(left)["kv"] == 0.001 and load_errors(left)["ka"] != load_errors(left)["ka"]
    assert main([left, right]) == 0
    out = capsys.readouterr().out
    assert "0.5000 ± 0.001" in out and "+4 % (14 σ)" in out and "right differs from left in kv." in out
    assert main([left, str(tmp_path / "none.yaml")]) == 1
    assert "cannot read the model file" in capsys.readouterr().err
