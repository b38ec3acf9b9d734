"""What a launch file can be told, as a table, and the words it was told."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from motor_model.errors import MotorError


@dataclass(frozen=True, slots=True)
class Argument:
    """One launch argument; everything is text there."""

    name: str
    default: str
    description: str
    choices: tuple[str, ...] = ()


PLANT = Argument(
    "plant",
    "sim",
    "sim: motor_sim; hardware: motor_driver and the board on a port; emulated: motor_driver and the emulated board",
    ("sim", "hardware", "emulated"),
)
MODEL = Argument("model", "", "model file (YAML) of the motor; empty: the paper's motor")
NAMESPACE = Argument("namespace", "", "of this motor's topics; one for each motor where there are several")
PORT = Argument("port", "", "the board's serial port; empty: the only one on USB, or the emulated board's own")
BOARD_ID = Argument("board_id", "", "number the board was flashed with; it is found by that, on whatever port")
PARAMETERS = Argument("parameters", "", "parameter file (YAML) whose values prevail over those in config/")


def checked(arguments: Iterable[Argument], told: Mapping[str, str]) -> dict[str, str]:
    """All values, defaults where nothing was said.

    Raises:
        MotorError: a word is none of the choices.
    """
    values = {argument.name: told.get(argument.name, argument.default).strip() for argument in arguments}
    for argument in arguments:
        if argument.choices and values[argument.name] not in argument.choices:
            raise MotorError(
                f"{argument.name}:={values[argument.name]} is not one of the choices; they are "
                f"{', '.join(argument.choices)}."
            )
    return values


def namespace_of(values: Mapping[str, str]) -> str:
    """Without slashes around it."""
    return values["namespace"].strip("/")
