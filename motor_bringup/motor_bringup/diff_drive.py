"""A robot of two motors: a plant and a controller for each wheel, and the differential drive above them."""

from collections.abc import Mapping
from dataclasses import replace

from motor_bringup import motor
from motor_bringup.argument import PARAMETERS, PLANT, Argument, checked
from motor_bringup.files import named
from motor_bringup.motors import BOARDS, SIDES, boards_of
from motor_bringup.parameter_file import parameters_told
from motor_bringup.plant import with_files
from motor_bringup.program import Program, Session

REFERENCE_TIMEOUT = 0.5  # [s] a drive that dies leaves no wheel turning: it sends references every 20 ms


def of_each(name: str, default: str, description: str) -> tuple[Argument, Argument]:
    """One argument for each wheel."""
    left, right = (Argument(f"{side}_{name}", default, f"{description} of the {side} wheel") for side in SIDES)
    return left, right


ARGUMENTS = (
    PLANT,
    *BOARDS,
    *of_each("model", "", "model file (YAML)"),
    *of_each("gains", "", "parameter file (YAML) with the gains of the controller, such as 'tune' writes,"),
    Argument("record", "false", "true: record each motor's topics into a bag named after it and the time"),
    PARAMETERS,
)


def session(told: Mapping[str, str]) -> Session:
    """Return what `diff_drive.launch.py` starts.

    Raises:
        MotorError: a word is none of the choices, a file cannot be read, or the boards cannot be told apart.
    """
    values = checked(ARGUMENTS, told)
    boards = boards_of(values)
    programs = [program for side in SIDES for program in _wheel(side, values, boards[side])]
    drive = Program("motor_examples", "diff_drive")
    parameters = with_files(drive.full_name, "robot.yaml", values, {})
    return Session((*programs, replace(drive, parameters=parameters)))


def _wheel(side: str, values: Mapping[str, str], board: Mapping[str, str]) -> list[Program]:
    """One motor in the namespace of its side; for its board the file that `check` wrote prevails."""
    own = {name: values[f"{side}_{name}"] for name in ("model", "gains")}
    shared = {name: values[name] for name in ("plant", "record", "parameters")}
    programs = motor.session({**shared, **own, **board, "namespace": side}).programs
    return [_let_references_end(program, values) for program in programs]


def _let_references_end(program: Program, values: Mapping[str, str]) -> Program:
    """Have a controller drop references that no longer come, unless the user's file says otherwise."""
    if program.executable != "motor_control":
        return program
    file = named(values["parameters"], "parameter file") if values["parameters"] else ""
    theirs = parameters_told(program.full_name, file) if file else {}
    timeout = {"reference_timeout": theirs.get("reference_timeout", REFERENCE_TIMEOUT)}
    return replace(program, parameters={**program.parameters, **timeout})
