"""One motor at work: a plant, the speed controller and, if wanted, a recorder."""

from collections.abc import Mapping
from dataclasses import replace
from datetime import datetime
from pathlib import Path

from motor_bringup.argument import BOARD_ID, MODEL, NAMESPACE, PARAMETERS, PLANT, PORT, Argument, checked, namespace_of
from motor_bringup.files import named
from motor_bringup.parameter_file import parameters_named
from motor_bringup.plant import model_of, plant_programs, with_files
from motor_bringup.program import Program, Session, Value

ARGUMENTS = (
    PLANT,
    MODEL,
    Argument("gains", "", "parameter file (YAML) with the controller's gains, such as 'tune' writes; empty: config/"),
    Argument("record", "false", "true: record the motor's topics into a bag named after the time; or the bag's path"),
    NAMESPACE,
    PORT,
    BOARD_ID,
    PARAMETERS,
    Argument("control", "true", "false: no controller, for voltages of your own", ("true", "false")),
    Argument("identification", "false", "true: also the services that fit models", ("true", "false")),
)


def session(told: Mapping[str, str]) -> Session:
    """Return what `motor.launch.py` starts.

    Raises:
        MotorError: a word is none of the choices, or a file that was named cannot be read.
    """
    values = checked(ARGUMENTS, told)
    programs = list(plant_programs(values))
    if values["control"] == "true":
        programs.append(_controller(values))
    if values["identification"] == "true":
        programs.append(_node("motor_identification", "identification.yaml", values, {}))
    if values["record"].lower() not in ("false", ""):
        programs.append(_recorder(values))
    return Session(tuple(programs))


def _controller(values: Mapping[str, str]) -> Program:
    gains: dict[str, Value] = {}
    if values["gains"]:
        gains = parameters_named("motor_control", named(values["gains"], "file with gains"))
    return _node("motor_control", "control.yaml", values, {**model_of(values), **gains})


def _node(name: str, file: str, values: Mapping[str, str], own: Mapping[str, Value]) -> Program:
    """The node of a package of that name."""
    program = Program(name, name, namespace=namespace_of(values))
    return replace(program, parameters=with_files(program.full_name, file, values, own))


def _recorder(values: Mapping[str, str]) -> Program:
    namespace = namespace_of(values)
    bag = values["record"]
    if bag.lower() == "true":
        bag = f"{namespace.replace('/', '_') or 'motor'}_{datetime.now():%Y_%m_%d-%H_%M_%S}"
    where = ("--topic-namespace", namespace) if namespace else ()
    arguments = (str(Path(bag).expanduser()), *where)
    return Program("motor_identification", "record", arguments, node=False, needed=False)
