"""Node parameters as a table: name, default, meaning, unit and range stand in one row."""

from collections.abc import Iterable
from dataclasses import dataclass
from difflib import get_close_matches

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.exceptions import InvalidParameterTypeException, InvalidParameterValueException
from rclpy.node import Node

from motor_model.errors import MotorError

Value = bool | int | float | str
KINDS = {bool: "true or false", int: "a whole number", float: "a number", str: "text"}


@dataclass(frozen=True, slots=True)
class Row:
    """One parameter; `low` and `high` apply to numbers, `read_only` parameters are fixed at the start."""

    name: str
    default: Value
    description: str
    unit: str = ""
    low: float | None = None
    high: float | None = None
    read_only: bool = False
    any_kind: bool = False  # a text that may look like a number

    def shown(self) -> str:
        """The default as it would be typed."""
        return str(self.default).lower() if isinstance(self.default, bool) else repr(self.default)

    def meaning(self) -> str:
        """Unit, range, description and whether it can be changed, for a line of text."""
        unit = f"[{self.unit}] " if self.unit else ""
        span = f"{self.low:.10g} to {self.high:.10g}: " if self.low is not None and self.high is not None else ""
        return f"{unit}{span}{self.description}{'; fixed at the start' if self.read_only else ''}"

    def descriptor(self) -> ParameterDescriptor:
        """What `ros2 param describe` shows."""
        text = f"{self.description} [{self.unit}]" if self.unit else self.description
        descriptor = ParameterDescriptor(name=self.name, description=text, read_only=self.read_only)
        descriptor.dynamic_typing = self.any_kind
        if self.low is None or self.high is None:
            return descriptor
        if isinstance(self.default, float):
            descriptor.floating_point_range = [FloatingPointRange(from_value=self.low, to_value=self.high)]
        else:
            descriptor.integer_range = [IntegerRange(from_value=int(self.low), to_value=int(self.high))]
        return descriptor


def declare(node: Node, rows: Iterable[Row]) -> dict[str, Value]:
    """Declare all rows on the node and return the values in force.

    Raises:
        MotorError: a value given on the command line or in a file has the wrong type or is out of range.
    """
    values: dict[str, Value] = {}
    for row in rows:
        try:
            values[row.name] = node.declare_parameter(row.name, row.default, row.descriptor()).value
            if values[row.name] is None:
                raise InvalidParameterValueException(row.name, None, "it has no value")
        except (InvalidParameterTypeException, InvalidParameterValueException) as error:
            span = f" from {row.low:.10g} to {row.high:.10g}" if row.low is not None and row.high is not None else ""
            kind = KINDS[type(row.default)]
            raise MotorError(
                f"parameter {row.name} ({row.description}) takes {kind}{span} {row.unit}".rstrip()
                + f", for example {row.shown()}."
            ) from error
    return values


def unknown_parameters(node: Node, rows: Iterable[Row]) -> list[str]:
    """A sentence for every parameter that was given and that the node does not have: ROS passes over it in silence."""
    names = [row.name for row in rows]
    given: Iterable[str] = getattr(node, "_parameter_overrides", ())  # rclpy has no public name for them
    return [
        f"there is no parameter {name} here, and it has no effect{_did_you_mean(name, names)}"
        for name in sorted(given)
        if not node.has_parameter(name) and not name.startswith("qos_overrides.")
    ]


def _did_you_mean(name: str, names: list[str]) -> str:
    close = get_close_matches(name, names, 1)
    return f": did you mean {close[0]}?" if close else f"; there are {', '.join(names)}."
