"""Options that ask for a motor in ohms and newton-metres."""

import argparse

from motor_identification.estimation.request import PhysicalRequest
from motor_model.errors import MotorError
from motor_ros.command.number_types import positive


def add_physical_options(parser: argparse.ArgumentParser) -> None:
    """Add --physical, --resistance and --torque-constant."""
    group = parser.add_argument_group("in ohms and newton-metres")
    group.add_argument(
        "--physical", action="store_true", help="from the recorded current: R, L, torque constant, inertia, friction"
    )
    group.add_argument(
        "--resistance",
        type=_measured,
        metavar="OHM",
        help="the same without a current, of the armature [Ω]; 2.1±0.1 has a standard error",
    )
    group.add_argument(
        "--torque-constant",
        type=positive,
        default=0.0,
        metavar="K",
        help="with --resistance: of the data sheet [N·m/A]; the rest of kv is then viscous friction",
    )


def read_physical(options: argparse.Namespace) -> PhysicalRequest | None:
    """Read what was asked for; None if nothing was.

    Raises:
        MotorError: a torque constant without a resistance.
    """
    if options.resistance is None:
        if options.torque_constant:
            raise MotorError("--torque-constant goes with --resistance: give both, or record the current.")
        return PhysicalRequest() if options.physical else None
    resistance, error = options.resistance
    return PhysicalRequest(resistance, error, options.torque_constant)


def _measured(text: str) -> tuple[float, float]:
    """Read 2.1, 2.1±0.1 or 2.1+-0.1."""
    value, _, error = text.replace("+/-", "±").replace("+-", "±").partition("±")
    return positive(value), positive(error) if error else 0.0
