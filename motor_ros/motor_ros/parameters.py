"""Node parameters as a table: name, default, meaning, unit and range stand in one row."""

from collections.abc import Iterable
from dataclasses import dataclass
from difflib import get_close_matches

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.exceptions import InvalidParameterTypeException, InvalidParameterValueException
from rclpy.node import Node

from motor_model.errors import MotorError
from motor_model.gearing.encoder_count import DEFAULT_EDGES, MOST_EDGES

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
    checked: bool = False  # checks for faults read it: to be set to and fro in a running loop is a stop

    def shown(self) -> str:
        """The default as it would be typed."""
        return str(self.default).lower() if isinstance(self.default, bool) else repr(self.default)

    def meaning(self) -> str:
        """Unit, range, description and whether it can be changed, for a line of text."""
        return f"{self.summary()}{'; fixed at the start' if self.read_only else ''}"

    def summary(self) -> str:
        """Unit, range and description."""
        unit = f"[{self.unit}] " if self.unit else ""
        span = f"{self.low:.10g} to {self.high:.10g}: " if self.low is not None and self.high is not None else ""
        return f"{unit}{span}{self.description}"

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


def given_parameters(node: Node) -> list[str]:
    """Name the parameters that the command line and files give a node, whether or not it has them."""
    given: Iterable[str] = getattr(node, "_parameter_overrides", ())  # rclpy has no public name for them
    return sorted(name for name in given if not name.startswith("qos_overrides."))


def unknown_parameters(node: Node, rows: Iterable[Row]) -> list[str]:
    """Name, a sentence each, given parameters that the node does not have: ROS passes over them in silence."""
    names = [row.name for row in rows]
    return [
        f"there is no parameter {name} here, and it has no effect{_did_you_mean(name, names)}"
        for name in given_parameters(node)
        if not node.has_parameter(name)
    ]


def _did_you_mean(name: str, names: list[str]) -> str:
    close = get_close_matches(name, names, 1)
    return f": did you mean {close[0]}?" if close else f"; there are {', '.join(names)}."


# What simulated and real motor share, so that they swap.
SHARED_PARAMETERS = (
    Row("name", "motor", "the motor's name: frame_id of its samples, joint of joint_states", read_only=True),
    Row("sample_rate", 200.0, "samples per second", "Hz", 10.0, 1000.0, read_only=True),
    Row(
        "edges_per_revolution",
        DEFAULT_EDGES,
        "counts per turn of the encoder's shaft, of one polarity; pulses_per_revolution prevails",
        "",
        1,
        MOST_EDGES,
        read_only=True,
    ),
    Row(
        "single_channel",
        True,
        "the encoder has one channel and does not measure direction; with quadrature 2 or 4 it has two",
        read_only=True,
    ),
    Row(
        "quadrature",
        1,
        "counts in a period of one channel: 1 (one polarity), 2 (both of A) or 4 (both of both)",
        "",
        1,
        4,
        read_only=True,
    ),
    Row(
        "pulses_per_revolution",
        0,
        "periods of one channel per turn of the encoder's shaft; times quadrature it makes the counts; 0: not said",
        "",
        0,
        MOST_EDGES,
        read_only=True,
    ),
    Row(
        "gear_ratio",
        "1",
        "turns of the encoder's shaft per turn of the output, which speed and angle are of: 34.014, 9291/273",
        read_only=True,
        any_kind=True,
    ),
    Row(
        "supply_voltage",
        0.0,
        "voltage at full duty, where none is measured; 0: as max_voltage",
        "V",
        0.0,
        100.0,
        read_only=True,
    ),
    Row("command_timeout", 0.1, "without a command for this long the motor gets 0 V", "s", 0.005, 10.0, read_only=True),
    Row(
        "enabled_at_start",
        True,
        "true: the output is on as soon as voltages begin, at 0 V or from a new sender; false: off until motor/enable",
        read_only=True,
    ),
    Row(
        "stall_time",
        0.4,
        "half of max_voltage and more without an edge for this long, or against the motion, is a stop; 0: never",
        "s",
        0.0,
        60.0,
        read_only=True,
    ),
)


def max_voltage_row(default: float = 12.0) -> Row:
    """Return the shared parameter whose default a model file may set."""
    return Row("max_voltage", default, "the motor's; commands are limited to it", "V", 0.1, 100.0, read_only=True)
