"""What commands may write: nothing over what is there, and nothing where it cannot be."""

from pathlib import Path

import pytest

from motor_model.errors import MotorError
from motor_ros.output_files import check_outputs


def test_what_exists_is_refused_unless_forced(tmp_path: Path) -> None:
    (tmp_path / "there.yaml").write_text("mine")
    check_outputs([tmp_path / "new.yaml", str(tmp_path / "other.json")], force=False)
    with pytest.raises(MotorError) as refused:
        check_outputs([tmp_path / "new.yaml", tmp_path / "there.yaml"], force=False)
    assert str(refused.value) == (
        f"{tmp_path}/there.yaml exists already and is left as it is: choose another name, or replace it with --force."
    )
    check_outputs([tmp_path / "there.yaml"], force=True)


@pytest.mark.parametrize("name", ["no/model.yaml", "folder"])
def test_what_could_not_be_written_is_refused_even_when_forced(name: str, tmp_path: Path) -> None:
    (tmp_path / "folder").mkdir()
    for force in (False, True):
        with pytest.raises(MotorError) as refused:
            check_outputs([tmp_path / name], force)
        assert str(refused.value) == (
            f"cannot write {tmp_path / name}: name a file in a directory that exists and can be written to."
        )


def test_a_directory_that_the_command_makes_may_be_missing(tmp_path: Path) -> None:
    check_outputs([tmp_path / "a/b/report.html"], False, made=tmp_path / "a/b")
    (tmp_path / "file").write_text("no directory")
    with pytest.raises(MotorError, match="cannot write .*/file/report.html"):
        check_outputs([tmp_path / "file/report.html"], False, made=tmp_path / "file")


def test_a_name_that_no_file_can_have_is_a_sentence(tmp_path: Path) -> None:
    for name in ("a" * 256, "a" * 256 + "/model.yaml", "b/" * 3000 + "model.yaml"):
        for made in (None, (tmp_path / name).parent):
            with pytest.raises(MotorError, match=r"cannot write .* \(File name too long\): choose another name\."):
                check_outputs([tmp_path / name], False, made)
