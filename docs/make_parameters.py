"""Writes motor_bringup/config/*.yaml from the tables of the nodes' parameters: `python docs/make_parameters.py`."""

from collections.abc import Iterable
from pathlib import Path

from motor_board.parameters import FAULTS, SET_UP
from motor_control.parameters import ROWS as CONTROL
from motor_driver.parameters import ROWS as DRIVER
from motor_examples.diff_drive.parameters import ROWS as DIFF_DRIVE
from motor_identification.live.monitor_parameters import PARAMETERS as MONITOR
from motor_identification.service.parameters import PARAMETERS as IDENTIFICATION
from motor_ros.parameters import SHARED_PARAMETERS, Row, max_voltage_row
from motor_sim.parameters import PARAMETERS as SIM

FOLDER = Path(__file__).resolve().parents[1] / "motor_bringup" / "config"
SHARED = (*SHARED_PARAMETERS, max_voltage_row())
HEAD = """\
# {about}
# Each value is the default; behind it [unit], the range, what it means, and whether only a new start changes it.
# Copy what you change into a file of your own and launch with parameters:=FILE. Written by docs/make_parameters.py.
"""
NOTES = {"max_voltage": "a model file of a simulated motor prevails over this line"}


def own(rows: Iterable[Row]) -> tuple[Row, ...]:
    """Those that not every plant has."""
    shared = {row.name for row in SHARED}
    return tuple(row for row in rows if row.name not in shared)


# file: what it is, and sections: the nodes they are for, with their rows
FILES: dict[str, tuple[str, dict[str, tuple[Row, ...]]]] = {
    "plant.yaml": (
        "The plant: first what all plants share, so that they swap, then what each has of its own.",
        {
            "/**": SHARED,
            "/**/motor_sim": own(SIM),
            "/**/motor_driver": own(DRIVER),
            "/**/board_emulator": own((*SET_UP, *FAULTS)),
        },
    ),
    "control.yaml": ("The speed controller.", {"/**/motor_control": tuple(CONTROL)}),
    "robot.yaml": ("The differential drive of motor_examples.", {"/**/diff_drive": tuple(DIFF_DRIVE)}),
    "identification.yaml": (
        "The node that fits models to bags, and the one that compares a running motor with its model.",
        {"/**/motor_identification": tuple(IDENTIFICATION), "/**/monitor": tuple(MONITOR)},
    ),
}


def text(about: str, sections: dict[str, tuple[Row, ...]]) -> str:
    """One parameter file."""
    lines = [HEAD.format(about=about)]
    for node, rows in sections.items():
        lines += [f"{node}:", "  ros__parameters:", *map(_line, rows), ""]
    return "\n".join(lines)


def _line(row: Row) -> str:
    return f"    {row.name}: {_value(row)}  # {_meaning(row)}"


def _value(row: Row) -> str:
    if isinstance(row.default, bool):
        return str(row.default).lower()
    return f'"{row.default}"' if isinstance(row.default, str) else _number(row.default)


def _meaning(row: Row) -> str:
    return "; ".join([row.meaning(), *([NOTES[row.name]] if row.name in NOTES else [])])


def _number(value: float) -> str:
    """As YAML 1.1 reads a number back: 4.0e-06, for it takes 4e-06 for text."""
    if isinstance(value, int):
        return str(value)
    shown = repr(value)
    return shown.replace("e", ".0e") if "e" in shown and "." not in shown else shown


if __name__ == "__main__":
    for name, (about, sections) in FILES.items():
        (FOLDER / name).write_text(text(about, sections), encoding="utf-8")
