"""What the launch files start, worked out without the launch system: it exists, and it takes what it is told."""

from collections.abc import Mapping
from pathlib import Path

import pytest
from ament_index_python.packages import get_package_prefix
from bringup_tables import NODES, SESSIONS

from motor_bringup import diff_drive, identify, motor, replay
from motor_bringup.program import Program, Session
from motor_model.errors import MotorError

BAGS = Path(__file__).resolve().parents[2] / "bags"


def by_name(session: Session) -> dict[str, Program]:
    return {program.executable: program for program in (*session.programs, *session.steps)}


def assert_exists(program: Program) -> None:
    """It is installed; a node declares what it is told, by the type it declares."""
    assert (Path(get_package_prefix(program.package)) / "lib" / program.package / program.executable).is_file()
    if not program.node:
        assert not program.parameters
        return
    defaults = {row.name: row.default for row in NODES[program.executable][1]}
    shared = {row.name for row in NODES["motor_sim"][1]}  # the emulator is told what plants share, and leaves it
    assert set(program.parameters) <= set(defaults) | (shared if program.executable == "board_emulator" else set())
    for name in set(program.parameters) & set(defaults):
        assert type(program.parameters[name]) is type(defaults[name]), name


@pytest.mark.parametrize("plant", ["sim", "hardware", "emulated"])
@pytest.mark.parametrize("namespace", ["", "left"])
def test_everything_that_is_started_exists(plant: str, namespace: str) -> None:
    told = {"plant": plant, "namespace": namespace, "model": str(BAGS / "emulated.yaml")}
    sessions = [
        motor.session({**told, "record": "true", "identification": "true", "gains": str(BAGS / "low_gain.yaml")}),
        identify.session({**told, "profile": "step", "effects": "coulomb_friction", "report": "out"}),
        replay.session({"bag": str(BAGS / "step")}),
        diff_drive.session(
            {"plant": plant, "left": "1", "right": "2", "left_model": str(BAGS / "emulated.yaml"), "record": "true"}
        ),
    ]
    for session in sessions:
        for program in (*session.programs, *session.steps):
            assert_exists(program)


@pytest.mark.parametrize(
    ("name", "told", "says"),
    [
        ("motor", {"plant": "toaster"}, "plant:=toaster is not one of the choices; they are sim, hardware, emulated."),
        ("motor", {"model": "none.yaml"}, "there is no model file .*/none.yaml: name one that there is"),
        ("motor", {"gains": "none.yaml"}, "there is no file with gains .*/none.yaml"),
        ("identify", {"parameters": "none.yaml"}, "there is no parameter file .*/none.yaml"),
        ("replay", {}, "no bag was named."),
        ("replay", {"bag": "none"}, "there is no bag .*/none"),
    ],
)
def test_what_is_wrong_is_one_sentence(name: str, told: Mapping[str, str], says: str) -> None:
    with pytest.raises(MotorError, match=says):
        SESSIONS[name].session(told)
