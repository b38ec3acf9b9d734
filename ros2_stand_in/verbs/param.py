"""`ros2 param`: the parameters of running nodes."""

import argparse
import sys
from collections.abc import Iterable
from typing import Any

import yaml
from rcl_interfaces.msg import Parameter, ParameterDescriptor, ParameterType, ParameterValue
from rclpy.parameter import get_parameter_value, parameter_value_to_python

from motor_model.errors import MotorError
from ros2_stand_in.graph import discovery
from ros2_stand_in.graph.remote import Remote
from ros2_stand_in.graph.session import session

_TYPE_NAMES = {
    ParameterType.PARAMETER_NOT_SET: "not set",
    ParameterType.PARAMETER_BOOL: "boolean",
    ParameterType.PARAMETER_INTEGER: "integer",
    ParameterType.PARAMETER_DOUBLE: "double",
    ParameterType.PARAMETER_STRING: "string",
    ParameterType.PARAMETER_BYTE_ARRAY: "byte array",
    ParameterType.PARAMETER_BOOL_ARRAY: "boolean array",
    ParameterType.PARAMETER_INTEGER_ARRAY: "integer array",
    ParameterType.PARAMETER_DOUBLE_ARRAY: "double array",
    ParameterType.PARAMETER_STRING_ARRAY: "string array",
}


def names_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 param list` takes."""
    _node_arguments(parser, nargs="?")
    parser.add_argument("--param-type", action="store_true", help="print the types too")


def names(args: argparse.Namespace) -> int:
    """Print the names of the parameters."""
    with session() as ros:
        if args.node_name:
            _print_names(Remote(ros, args.node_name, args.timeout), args.param_type)
            return 0
        discovery.settle(ros, args.spin_time)
        for name in discovery.node_names(ros.node):
            print(f"{name}:")
            try:
                _print_names(Remote(ros, name), args.param_type)
            except MotorError as error:  # such as a recorder, which has none; the others still count
                print(error, file=sys.stderr)
    return 0


def _print_names(remote: Remote, with_types: bool) -> None:
    declared = remote.names()
    kinds = [f" (type: {_TYPE_NAMES[each.type]})" for each in remote.describe(declared)] if with_types else None
    for name, kind in zip(declared, kinds or [""] * len(declared), strict=True):
        print(f"  {name}{kind}")


def get_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 param get` takes."""
    _node_arguments(parser)
    parser.add_argument("parameter_name", help="name of the parameter")
    parser.add_argument("--hide-type", action="store_true", help="print the value only")


def get(args: argparse.Namespace) -> int:
    """Print a value."""
    with session() as ros:
        values = Remote(ros, args.node_name, args.timeout).values([args.parameter_name])
    if not values or values[0].type == ParameterType.PARAMETER_NOT_SET:
        raise MotorError(f"Parameter not set: '{args.node_name}' has no value for '{args.parameter_name}'.")
    (value,) = values
    kind, _, array = _TYPE_NAMES[value.type].capitalize().partition(" ")
    label = f"{kind} {'values are' if array else 'value is'}: "
    print(f"{'' if args.hide_type else label}{parameter_value_to_python(value)}")
    return 0


def assign_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 param set` takes."""
    _node_arguments(parser)
    parser.add_argument("parameter_name", help="name of the parameter")
    parser.add_argument("value", help="new value; a whole number is not a double: write 1.0")


def assign(args: argparse.Namespace) -> int:
    """Set a parameter; exit status 1 if the node refuses."""
    parameter = Parameter(name=args.parameter_name, value=_parsed(args.value))
    with session() as ros:
        (result,) = Remote(ros, args.node_name, args.timeout).set([parameter])
    reason = f": {result.reason}" if result.reason else ""
    if result.successful:
        print(f"Set parameter successful{reason}")
        return 0
    print(f"Setting parameter failed{reason}", file=sys.stderr)
    return 1


def _parsed(text: str) -> ParameterValue:
    refused = MotorError(f"'{text}' is no value: write a number, true, false, a text, or a list.")
    try:
        value = get_parameter_value(text)
    except yaml.YAMLError as error:
        raise refused from error
    if not isinstance(value.string_value, str):  # where YAML reads a mapping or a date
        raise refused
    return value


def describe_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 param describe` takes."""
    _node_arguments(parser)
    parser.add_argument("parameter_names", nargs="+", help="names of the parameters")


def describe(args: argparse.Namespace) -> int:
    """Print type, meaning and range."""
    with session() as ros:
        descriptors = Remote(ros, args.node_name, args.timeout).describe(args.parameter_names)
    for descriptor in descriptors:
        print("\n".join(_description(descriptor)))
    return 0


def _description(descriptor: ParameterDescriptor) -> Iterable[str]:
    yield f"Parameter name: {descriptor.name}"
    yield f"  Type: {_TYPE_NAMES[descriptor.type]}"
    if descriptor.description:
        yield f"  Description: {descriptor.description}"
    yield "  Constraints:"
    if descriptor.read_only:
        yield "    Read only: true"
    for span in [*descriptor.floating_point_range, *descriptor.integer_range][:1]:
        yield f"    Min value: {span.from_value}"
        yield f"    Max value: {span.to_value}"
        if span.step:
            yield f"    Step: {span.step}"
    if descriptor.additional_constraints:
        yield f"    Additional constraints: {descriptor.additional_constraints}"


def dump_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 param dump` takes."""
    _node_arguments(parser)


def dump(args: argparse.Namespace) -> int:
    """Print all parameters of a node in the form that `--params-file` reads."""
    with session() as ros:
        remote = Remote(ros, args.node_name, args.timeout)
        declared = remote.names()
        values = [parameter_value_to_python(value) for value in remote.values(declared)]
    tree: dict[str, Any] = {}
    for name, value in zip(declared, values, strict=True):
        *groups, leaf = name.split(".")
        branch = tree
        for group in groups:
            branch = branch.setdefault(group, {})
        branch[leaf] = value
    print(yaml.dump({discovery.full_name(args.node_name): {"ros__parameters": tree}}, default_flow_style=False))
    return 0


def _node_arguments(parser: argparse.ArgumentParser, nargs: str | None = None) -> None:
    parser.add_argument("node_name", nargs=nargs, help=f"name of the node{'; all nodes without one' if nargs else ''}")
    parser.add_argument("--timeout", type=float, default=1.0, metavar="N", help="wait N seconds for a node not found")
    discovery.discovery_arguments(parser)
