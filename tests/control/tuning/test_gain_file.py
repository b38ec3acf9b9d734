"""The gain file: what it says, where its model is, and that nothing is overwritten."""

from pathlib import Path

import pytest
import yaml
from tuning_bench import tuning

from motor_control.tuning.gain_file import gain_text, save_gains
from motor_model.errors import MotorError


def test_it_names_its_model_by_a_path_that_works_from_anywhere(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.chdir(tmp_path)
    values = yaml.safe_load(gain_text(tuning(source="observer"), Path("found.yaml")))["/**/motor_control"]
    assert values["ros__parameters"]["model"] == str(tmp_path / "found.yaml")
    assert values["ros__parameters"]["feedforward"] is True


def test_numbers_are_doubles_with_six_digits() -> None:
    one = tuning()
    values = yaml.safe_load(gain_text(one, Path("m.yaml")))["/**/motor_control"]["ros__parameters"]
    assert values["kp"] == pytest.approx(one.gains.kp, rel=1e-5) and isinstance(values["ki"], float)
    assert "model" not in values


def test_another_file_is_left_as_it_is(tmp_path: Path) -> None:
    path = tmp_path / "gains.yaml"
    save_gains(path, tuning(), Path("m.yaml"))
    written = path.read_bytes()
    with pytest.raises(MotorError, match="exists already and is left as it is: choose another name"):
        save_gains(path, tuning(time_constant=0.1), Path("m.yaml"))
    assert path.read_bytes() == written
    save_gains(path, tuning(time_constant=0.1), Path("m.yaml"), force=True)
    assert path.read_bytes() != written


def test_a_name_that_no_file_can_have_is_a_sentence(tmp_path: Path) -> None:
    with pytest.raises(MotorError, match=r"cannot write .*a \(File name too long\)"):
        save_gains(tmp_path / ("a" * 256), tuning(), Path("m.yaml"))
