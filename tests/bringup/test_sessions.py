"""What the launch files start, worked out without the launch system: it exists, and it takes what it is told."""

import itertools
import subprocess
from collections.abc import Mapping
from pathlib import Path

import pytest
from ament_index_python.packages import get_package_prefix
from bringup_tables import NODES, SESSIONS

from motor_bringup import identify, motor, replay
from motor_bringup.argument import Argument
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
    ]
    for session in sessions:
        for program in (*session.programs, *session.steps):
            assert_exists(program)


def test_plants_swap_in_that_word_only() -> None:
    """Whatever the plant, the others are started in the same way, and the plants share what they share."""
    model = {"model": str(BAGS / "emulated.yaml"), "record": "bag"}
    sessions = {plant: motor.session({**model, "plant": plant}) for plant in ("sim", "hardware", "emulated")}
    plants = {"motor_sim", "motor_driver", "board_emulator"}
    others = [[p for p in session.programs if p.executable not in plants] for session in sessions.values()]
    assert others[0] == others[1] == others[2] and len(others[0]) == 2
    first = [session.programs[0] for session in sessions.values()]
    assert [program.executable for program in first] == ["motor_sim", "motor_driver", "motor_driver"]
    shared = {row.name for row in NODES["motor_sim"][1]} & {row.name for row in NODES["motor_driver"][1]}
    assert len(shared) == 9
    for a, b in itertools.combinations(first, 2):
        differing = {name for name in shared if a.parameters[name] != b.parameters[name]}
        assert differing <= {"max_voltage"}  # which a model file cannot tell of real hardware
    assert [program.parameters["max_voltage"] for program in first] == [9.0, 12.0, 9.0]
    driver, board = sessions["emulated"].programs[:2]
    assert driver.parameters["port"] == board.parameters["link"] == "/tmp/motor_board"


def test_two_motors_keep_apart() -> None:
    left, right = (
        motor.session({"plant": "emulated", "namespace": name, "record": "true"}) for name in ("left", "/right/")
    )
    programs = by_name(left), by_name(right)
    assert [p["motor_driver"].namespace for p in programs] == ["left", "right"]
    assert [p["motor_driver"].parameters["name"] for p in programs] == ["left", "right"]
    assert [p["board_emulator"].parameters["link"] for p in programs] == [
        "/tmp/motor_board_left",
        "/tmp/motor_board_right",
    ]
    assert all(
        p["record"].arguments[1:] == ("--topic-namespace", name)
        for p, name in zip(programs, ("left", "right"), strict=True)
    )
    assert all(
        p["record"].arguments[0].startswith(name) for p, name in zip(programs, ("left_20", "right_20"), strict=True)
    )


def test_which_value_prevails(tmp_path: Path) -> None:
    """Ours, what follows from model and namespace, the user's file, the user's words."""
    file = tmp_path / "mine.yaml"
    file.write_text(
        "/**:\n  ros__parameters: {sample_rate: 500.0, max_voltage: 7.0, kp: 0.5, ki: 0.5}\n", encoding="utf-8"
    )
    told = {"parameters": str(file), "model": str(BAGS / "emulated.yaml"), "namespace": "left"}
    programs = by_name(motor.session({**told, "gains": str(BAGS / "low_gain.yaml")}))
    plant, control = programs["motor_sim"].parameters, programs["motor_control"].parameters
    assert (plant["sample_rate"], plant["max_voltage"], plant["name"]) == (500.0, 7.0, "left")
    assert (control["kp"], control["ki"], control["voltage_limit"]) == (0.02, 0.25, 12.0)
    assert by_name(motor.session({"parameters": str(file)}))["motor_control"].parameters["kp"] == 0.5


def test_replay_takes_the_motor_as_it_was_recorded() -> None:
    session = replay.session({"bag": str(BAGS / "emulated"), "loop": "true", "start": "1.5"})
    (simulated,), (play,) = session.programs, session.steps
    assert simulated.namespace == "simulated" and simulated.remappings == (("motor/voltage", "/motor/voltage"),)
    expected = {"max_voltage": 9.0, "edges_per_revolution": 96, "single_channel": True, "name": "motor_simulated"}
    assert {name: simulated.parameters[name] for name in expected} == expected
    assert simulated.parameters["sample_rate"] == pytest.approx(200.0) and play.arguments[1:] == (
        "--start-offset",
        "1.5",
        "--loop",
    )
    log = (Path(__file__).resolve().parents[2] / "motor_sim" / "motor_sim" / "node.py").read_text(encoding="utf-8")
    assert f'f"{session.ready} ' in log  # what play waits for is what motor_sim says


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


def test_the_words_for_a_shell_mean_the_same(tmp_path: Path) -> None:
    told = {"namespace": "left", "plant": "emulated", "record": "bag"}
    for program in motor.session(told).programs:
        words = " ".join(program.command)
        assert words.startswith(f"ros2 run {program.package} {program.executable}")
        assert ("--ros-args -r __ns:=/left" in words) == program.node
    control = Program("motor_control", "motor_control", parameters={"kp": -1.0})
    done = subprocess.run(control.command, capture_output=True, text=True, timeout=60)
    assert done.returncode == 1 and "parameter kp (proportional gain)" in done.stderr


@pytest.mark.parametrize("name", SESSIONS)
def test_arguments_are_documented(name: str) -> None:
    rows: tuple[Argument, ...] = SESSIONS[name].ARGUMENTS
    page = (Path(__file__).resolve().parents[2] / "motor_bringup" / "README.md").read_text(encoding="utf-8")
    assert len({row.name for row in rows}) == len(rows)
    for row in rows:
        assert len(row.description) > 10 and f"`{row.name}`" in page, row.name
