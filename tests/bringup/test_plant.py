"""The plant as programs: the three swap in one word."""

import itertools
from pathlib import Path

import pytest
from bringup_tables import NODES

from motor_bringup import motor

BAGS = Path(__file__).resolve().parents[2] / "bags"


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
    assert len(shared) == 12
    for a, b in itertools.combinations(first, 2):
        differing = {name for name in shared if a.parameters[name] != b.parameters[name]}
        assert differing <= {"max_voltage", "supply_voltage"}  # which a model file cannot tell of real hardware
    assert [program.parameters["max_voltage"] for program in first] == [9.0, 12.0, 9.0]
    supplies = [program.parameters["supply_voltage"] for program in first]
    assert supplies == [0.0, 0.0, 9.0]  # the emulated board's is known
    driver, board = sessions["emulated"].programs[:2]
    assert driver.parameters["port"] == board.parameters["link"] == "/tmp/motor_board"


@pytest.mark.parametrize(
    ("lines", "told"),
    [
        ("/**: {ros__parameters: {max_voltage: 3.0}}", (3.0, 12.0)),
        ("/**: {ros__parameters: {max_voltage: 3.0, supply_voltage: 24.0}}", (3.0, 24.0)),
        ("/**/board_emulator: {ros__parameters: {supply_voltage: 24.0}}", (12.0, 0.0)),  # the board measures it
        (f"/**/board_emulator: {{ros__parameters: {{model: {BAGS / 'emulated.yaml'}}}}}", (12.0, 9.0)),
    ],
)
def test_the_driver_of_an_emulated_board_is_told_its_supply(
    tmp_path: Path, lines: str, told: tuple[float, float]
) -> None:
    """A limit of 3 V on the 12 V of the emulated board was 12 V at its pins."""
    (tmp_path / "mine.yaml").write_text(lines, encoding="utf-8")
    values = {"plant": "emulated", "parameters": str(tmp_path / "mine.yaml"), "namespace": "left"}
    driver = motor.session(values).programs[0].parameters
    assert (driver["max_voltage"], driver["supply_voltage"]) == told
