"""The result of a first run as JSON, and as the driver's parameter file."""

import json
from dataclasses import asdict, dataclass
from math import isfinite, isnan
from typing import Any

from motor_driver.check.check import Check
from motor_driver.check.record import UNKNOWN
from motor_driver.check.settings import Settings
from motor_driver.frames.from_board import Hello

NODE = "/**/motor_driver"  # in any namespace


@dataclass(frozen=True, slots=True)
class Chosen:
    """What a person has chosen, and no run can find out."""

    port: str
    name: str = ""  # of the motor; empty: left out
    decay: str = "brake"
    silent_pwm: bool = False


def parameters_of(check: Check, chosen: Chosen) -> dict[str, bool | int | float | str]:
    """Return the driver's parameters that this board and motor need."""
    settings, board = check.settings, check.board
    believed = isnan(check.record.measured.supply) and not settings.supply_voltage  # nobody knows: nor shall the driver
    place = {"board_id": str(board.board_id)} if board.board_id else {"port": chosen.port}
    cures = {key: value for found in check.record.findings for key, value in found.parameters.items()}
    return {
        **({"name": chosen.name} if chosen.name else {}),
        **place,
        **_encoder_of(settings, board),
        "single_channel": board.channels == 1,
        "max_voltage": float(settings.max_voltage),
        "supply_voltage": 0.0 if believed else float(settings.supply),
        "decay": chosen.decay,
        **_sensor_of(settings),
        **({"silent_pwm": True} if chosen.silent_pwm else {}),
        **cures,
    }


def _encoder_of(settings: Settings, board: Hello) -> dict[str, int | str]:
    """Edges of one polarity, or pulses counted two- or fourfold, and the gear between encoder and output."""
    edges = settings.edges(board)
    if edges is None:
        return {}
    gear = {} if settings.gear == 1 else {"gear_ratio": settings.gear_said or str(settings.gear)}
    if settings.quadrature == 1:
        return {"edges_per_revolution": edges, **gear}
    return {"pulses_per_revolution": edges, "quadrature": settings.quadrature, **gear}


def _sensor_of(settings: Settings) -> dict[str, float]:
    """The current sensor, if there is one."""
    if settings.current_gain == 0.0:
        return {}
    return {"current_gain": settings.current_gain, "current_offset": settings.current_offset}


def parameter_text(check: Check, chosen: Chosen) -> str:
    """Return the parameter file, with what was measured as comments."""
    lines = [
        "# The driver's parameters, by `ros2 run motor_driver check`. To use them:",
        "#   ros2 run motor_driver motor_driver --ros-args --params-file THIS_FILE",
        *(f"# {row.step}: {row.text}" for row in check.record.rows),
        f"{NODE}:",
        "  ros__parameters:",
    ]
    values = parameters_of(check, chosen)
    return "\n".join([*lines, *(f"    {key}: {json.dumps(value)}" for key, value in values.items())]) + "\n"


def as_json(check: Check, chosen: Chosen) -> dict[str, Any]:
    """Return the whole result; null where there is no number."""
    record, board = check.record, check.board
    measured = {key: value if isfinite(value) else None for key, value in asdict(record.measured).items()}
    return {
        "right": check.right,
        "board": {
            "port": chosen.port,
            "board_id": board.board_id,
            "firmware": board.firmware,
            "channels": board.channels,
            "edges_per_revolution": board.edges_per_revolution or None,
        },
        "findings": [
            {"code": found.code, "sentence": found.sentence, "cure": found.cure, "parameters": found.parameters}
            for found in record.findings
        ],
        "not_known": [{"step": row.step, "text": row.text} for row in record.rows if row.mark == UNKNOWN],
        "measured": measured,
        "parameters": parameters_of(check, chosen) if check.right else None,
    }


def refused_json(settings: Settings, port: str, code: str, sentence: str) -> dict[str, Any]:
    """Return the result where no board could be checked."""
    found = {"code": code, "sentence": sentence, "cure": "", "parameters": {}}
    board = {"port": port, "board_id": settings.board_id}
    return {"right": False, "board": board, "findings": [found], "not_known": [], "measured": {}, "parameters": None}
