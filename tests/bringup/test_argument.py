"""What a launch file can be told."""

from pathlib import Path

import pytest
from bringup_tables import SESSIONS

from motor_bringup.argument import MODEL, PLANT, Argument, checked, namespace_of
from motor_model.errors import MotorError


@pytest.mark.parametrize("name", SESSIONS)
def test_arguments_are_documented(name: str) -> None:
    rows: tuple[Argument, ...] = SESSIONS[name].ARGUMENTS
    page = (Path(__file__).resolve().parents[2] / "motor_bringup" / "README.md").read_text(encoding="utf-8")
    assert len({row.name for row in rows}) == len(rows)
    for row in rows:
        assert len(row.description) > 10 and f"`{row.name}`" in page, row.name


def test_what_is_not_said_has_its_default_and_blanks_do_not_count() -> None:
    values = checked((PLANT, MODEL), {"model": " my.yaml "})
    assert values == {"plant": "sim", "model": "my.yaml"}
    with pytest.raises(MotorError, match="plant:=toaster is not one of the choices; they are sim, hardware, emulated"):
        checked((PLANT,), {"plant": "toaster"})


@pytest.mark.parametrize(("said", "meant"), [("", ""), ("/", ""), ("left", "left"), ("/a/b/", "a/b")])
def test_a_namespace_may_be_said_with_slashes(said: str, meant: str) -> None:
    assert namespace_of({"namespace": said}) == meant
