"""Files of the package, and those that a user names."""

from pathlib import Path

import pytest

from motor_bringup.files import config, named
from motor_model.errors import MotorError


@pytest.mark.parametrize("name", ["plant.yaml", "control.yaml", "identification.yaml"])
def test_the_packages_own_are_there(name: str) -> None:
    assert Path(config(name)).is_file() and Path(config(name)).is_absolute()


def test_what_a_user_names_is_found_from_anywhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "model.yaml").write_text("", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("HOME", str(tmp_path))
    assert named("model.yaml", "model file") == named("~/model.yaml", "model file") == str(tmp_path / "model.yaml")


def test_what_is_not_there_is_named_whole(tmp_path: Path) -> None:
    with pytest.raises(MotorError, match=f"there is no model file {tmp_path}/none.yaml: name one that there is"):
        named(str(tmp_path / "none.yaml"), "model file")
    with pytest.raises(MotorError, match=r"no bag was named\."):
        named("", "bag")


def test_a_name_that_no_file_can_have_is_a_sentence() -> None:
    with pytest.raises(MotorError, match=r"the bag /.*a cannot be read \(File name too long\): name another one\."):
        named("/tmp/" + "a" * 256, "bag")
