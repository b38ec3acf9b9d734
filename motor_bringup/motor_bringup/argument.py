"""What a launch file can be told, as a table, and the words it was told."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches

from motor_model.errors import MotorError

MEANT, MISSPELT = 0.6, 0.85  # likeness of a name to the one that was meant; of a name that can hardly mean another one
# Names that begin so are the launch system's own: it looks them up itself for every node and process.
OF_THE_SYSTEM = ("ros_", "launch-prefix", "global_params", "sigterm_timeout", "sigkill_timeout", "emulate_tty")


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


def refuse_unknown(arguments: Iterable[Argument], told: Iterable[str], alone: bool) -> None:
    """Refuse names that were told and are no arguments: the launch system drops them without a word.

    alone: whether all that was told is meant for these arguments. Where another launch file includes this one, its own
    arguments are among them; then only a name is refused that is nearly one of ours, which itself was not told.

    Raises:
        MotorError: a name is none of the arguments'.
    """
    ours, said = [argument.name for argument in arguments], list(told)
    for name in said:
        if name in ours or name.startswith(OF_THE_SYSTEM):
            continue
        near = get_close_matches(name.lower(), ours, 1, MEANT if alone else MISSPELT)
        if alone:
            meant = f": did you mean {near[0]}?" if near else "."
            file = " A node's parameter goes into a file, parameters:=FILE." if PARAMETERS.name in ours else ""
            they = f"It has {', '.join(ours)}.{file}"
            raise MotorError(f"{name}:= is no argument of this launch file, and would do nothing{meant} {they}")
        if near and near[0] not in said:
            raise MotorError(
                f"{name}:= is no argument of the launch file that is included: did you mean {near[0]}? If it is "
                f"one of your own file, pass {near[0]} as well."
            )


def namespace_of(values: Mapping[str, str]) -> str:
    """Without slashes around it."""
    return values["namespace"].strip("/")
