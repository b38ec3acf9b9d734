"""What a launch file can be told."""

from pathlib import Path

import pytest
from bringup_tables import SESSIONS

from motor_bringup.argument import (
    MODEL,
    NAMESPACE,
    PARAMETERS,
    PLANT,
    PORT,
    Argument,
    checked,
    namespace_of,
    refuse_unknown,
)
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


@pytest.mark.parametrize(
    "name", ["parameter", "paramters", "Parameters", "plnt", "modle", "max_voltage", "x", "params"]
)
def test_a_name_that_is_no_argument_is_refused(name: str) -> None:
    """A misspelt `parameters:=` was dropped without a word, and with it the limit of 3 V in that file."""
    ours = PLANT, MODEL, NAMESPACE, PORT, PARAMETERS
    meant = {"plnt": "plant", "modle": "model", "max_voltage": "", "x": ""}.get(name, "parameters")
    said = f"^{name}:= is no argument of this launch file, and would do nothing"
    said += rf": did you mean {meant}\? It has" if meant else r"\. It has plant, model, namespace, port, parameters\."
    with pytest.raises(MotorError, match=said):
        refuse_unknown(ours, ["plant", name], alone=True)
    theirs = ["ros_namespace", "launch-prefix", "launch-prefix-filter", "sigterm_timeout", "sigkill_timeout"]
    refuse_unknown(ours, ["plant", "parameters", *theirs, "emulate_tty", "global_params"], alone=True)


@pytest.mark.parametrize("name", ["parameter", "paramters", "plnt", "name_space"])
def test_beside_the_arguments_of_another_file_only_a_misspelt_one_is_refused(name: str) -> None:
    ours = PLANT, MODEL, NAMESPACE, PORT, PARAMETERS
    theirs = ["robot_model", "robot_namespace", "left_port", "use_sim_time", "max_voltage", "params_file", "controller"]
    refuse_unknown(ours, [*theirs, "plant", "ports", "port", "ros_namespace"], alone=False)
    with pytest.raises(MotorError, match=f"^{name}:= is no argument of the launch file that is included") as refused:
        refuse_unknown(ours, [*theirs, name], alone=False)
    meant = str(refused.value).rpartition("your own file, pass ")[2].removesuffix(" as well.")
    refuse_unknown(ours, [*theirs, name, meant], alone=False)
