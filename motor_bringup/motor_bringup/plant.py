"""The plant as programs: the simulated motor, the board's driver, or the driver with the emulated board."""

from collections.abc import Callable, Mapping
from dataclasses import replace

from motor_bringup.argument import namespace_of
from motor_bringup.files import config, named
from motor_bringup.parameter_file import parameters_for, parameters_told
from motor_bringup.program import Program, Value
from motor_model.model_file import load
from motor_model.parameters import paper_motor

# From the namespace and the model file; a user's parameter file prevails.
WORKED_OUT = "name", "max_voltage", "supply_voltage"


def plant_programs(values: Mapping[str, str]) -> tuple[Program, ...]:
    """Return what `plant:=` asks for; the program that has the motor's topics comes first.

    Raises:
        MotorError: the model or the parameter file cannot be read.
    """
    return tuple(_placed(program, values) for program in _PLANTS[values["plant"]](values))


def _placed(program: Program, values: Mapping[str, str]) -> Program:
    """In its namespace, after which its motor is called, with the parameters of the files."""
    namespace = namespace_of(values)
    own = dict(program.parameters)
    if namespace and program.executable != "board_emulator":
        own = {"name": namespace.rpartition("/")[2], **own}
    placed = replace(program, namespace=namespace)
    return replace(placed, parameters=with_files(placed.full_name, "plant.yaml", values, own))


def with_files(node: str, name: str, values: Mapping[str, str], own: Mapping[str, Value]) -> dict[str, Value]:
    """This package's values, then what the launch file works out, then the user's file, then what the user says here.

    Raises:
        MotorError: the user's file is no parameter file, or was meant for this node and is not for it.
    """
    theirs = parameters_told(node, named(values["parameters"], "parameter file")) if values["parameters"] else {}
    worked_out = {name: value for name, value in own.items() if name in WORKED_OUT}
    told = {name: value for name, value in own.items() if name not in WORKED_OUT}
    return {**parameters_for(node, config(name)), **worked_out, **theirs, **told}


def model_of(values: Mapping[str, str]) -> dict[str, Value]:
    """Return the model as the parameter of a node."""
    return {"model": named(values["model"], "model file")} if values["model"] else {}


def _full_duty(values: Mapping[str, str]) -> dict[str, Value]:
    """A model file says at what voltage its motor was driven; a driver cannot know that of an emulated board."""
    return {"max_voltage": load(values["model"]).max_voltage} if values["model"] else {}


def _sim(values: Mapping[str, str]) -> tuple[Program, ...]:
    return (Program("motor_sim", "motor_sim", parameters={**model_of(values), **_full_duty(values)}),)


def _hardware(values: Mapping[str, str]) -> tuple[Program, ...]:
    told: dict[str, Value] = {name: values[name] for name in ("port", "board_id") if values.get(name)}
    return (Program("motor_driver", "motor_driver", parameters=told),)


def _emulated(values: Mapping[str, str]) -> tuple[Program, ...]:
    link = values["port"] or "_".join(("/tmp/motor_board", *filter(None, namespace_of(values).split("/"))))
    number = values.get("board_id", "")
    wanted: dict[str, Value] = {"board_id": number} if number else {}
    flashed: dict[str, Value] = {"board_id": int(number)} if number.isdecimal() else {}
    board = Program("motor_board", "board_emulator", parameters={"link": link, **flashed, **model_of(values)})
    told = {"port": link, **wanted, **_full_duty(values), **_supply_of(_placed(board, values))}
    return Program("motor_driver", "motor_driver", parameters=told), board


def _supply_of(board: Program) -> dict[str, Value]:
    """Tell the driver of an emulated board the supply that is on its bridge, where the board does not measure it."""
    model, measured = str(board.parameters["model"]), board.parameters["supply_voltage"]
    return {} if measured else {"supply_voltage": (load(model) if model else paper_motor()).max_voltage}


_PLANTS: dict[str, Callable[[Mapping[str, str]], tuple[Program, ...]]] = {
    "sim": _sim,
    "hardware": _hardware,
    "emulated": _emulated,
}
