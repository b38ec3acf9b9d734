"""What a node says of itself on the command line: `--help` and `--version`, answered before anything starts."""

import argparse
import os
import re
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.metadata import version
from typing import NoReturn

from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.utilities import remove_ros_args

from motor_model.printable import escape
from motor_ros.parameters import Row
from motor_ros.topics import ROBOT_TOPICS, SERVICES, TOPICS

INVALID_ARGUMENTS = (rclpy_implementation.RCLInvalidROSArgsError, rclpy_implementation.UnknownROSArgsError)
NAMESPACE = re.compile(r"/|(/[A-Za-z_][A-Za-z0-9_]*)+")
BAD_NAMESPACE = (
    "'{}' is no namespace: write -r __ns:=/left, which is a slash before each name, of letters, digits (not first) and "
    "_, and none at the end"
)
PLANT_SUBSCRIBES = ("motor/voltage", "motor/speed")  # the latter while somebody else publishes it
PLANT_PUBLISHES = ("motor/speed", "motor/info", "joint_states", "/diagnostics")


@dataclass(frozen=True, slots=True)
class Program:
    """A node as a program; topics and services as in the tables of `topics`, those of a motor behind its namespace."""

    package: str
    name: str
    about: str
    rows: tuple[Row, ...]
    example: str  # a command line
    publishes: tuple[str, ...] = ()
    subscribes: tuple[str, ...] = ()
    services: tuple[str, ...] = ()
    requests: tuple[str, ...] = ()  # services of others

    @property
    def command(self) -> str:
        """How it is started."""
        return f"ros2 run {self.package} {self.name}"


def answer(program: Program, words: Sequence[str]) -> None:
    """Return if the words after the program's name are arguments of ROS alone.

    Raises:
        SystemExit: `--help` or `--version` has been answered (status 0), or there is another word (status 2).
    """
    parser = _Parser(program)
    if "_ARGCOMPLETE" in os.environ:
        _complete(program)
    if said := refuse_namespace(words):
        parser.error(said)
    try:
        rest = remove_ros_args([program.name, *words])[1:]
    except UnicodeEncodeError:
        parser.error("what is given has bytes that are no UTF-8")
    except INVALID_ARGUMENTS as error:
        parser.error(plain_sentence(error))
    parser.parse_args(rest)


def refuse_namespace(words: Sequence[str]) -> str:
    """Say which namespace among the words is none, which ROS says in other words or none; "" if all are."""
    parts = [word.partition("__ns:=") for word in words]
    given = [after for before, sign, after in parts if sign and ":=" not in before]
    return next((BAD_NAMESPACE.format(one) for one in given if not NAMESPACE.fullmatch(one)), "")


def _complete(program: Program) -> None:
    """Answer a shell that asks what could come next, and exit."""
    from argcomplete import SuppressCompleter, autocomplete

    parser = argparse.ArgumentParser(prog=program.name)
    parser.add_argument("--version", action="store_true")
    parser.add_argument("--ros-args", action="store_true")
    parameter = parser.add_argument("-p", "--param", action="append")
    parameter.completer = lambda **_: [f"{row.name}:=" for row in program.rows]  # type: ignore[attr-defined]
    renamed = parser.add_argument("-r", "--remap", action="append")
    renamed.completer = SuppressCompleter()  # type: ignore[attr-defined]
    parser.add_argument("--params-file", action="append")
    autocomplete(parser, always_complete_options=False)


def plain_sentence(error: Exception) -> str:
    """Return what ROS says of arguments that it does not understand, without the places in its sources."""
    if isinstance(error, rclpy_implementation.UnknownROSArgsError):
        return f"unknown ROS arguments: {str(error).strip('[]')}"
    text = str(error).removeprefix("Failed to parse ROS arguments: ").removeprefix("failed to initialize rcl: ")
    return " ".join(re.split(r"\. Error:|, at /", text)[0].split())


class _Parser(argparse.ArgumentParser):
    """Takes no arguments but `--help` and `--version`; the rest of a node's command line belongs to ROS."""

    def __init__(self, program: Program) -> None:
        usage = f"{program.command} [--help] [--version] [--ros-args [-p NAME:=VALUE]... [-r OLD:=NEW]...]"
        super().__init__(prog=program.name, usage=usage, add_help=True)
        self._program = program
        self.add_argument("--version", action="version", version=f"{program.name} {version(program.package)}")

    def format_help(self) -> str:
        return f"{self.format_usage()}\n{describe(self._program)}"

    def error(self, message: str) -> NoReturn:
        print(
            f"{self._program.name}: {escape(message, longest=0)}. Parameters stand behind --ros-args, such as "
            f"--ros-args{self._program.example.split('--ros-args')[1]}; see --help.",
            file=sys.stderr,
        )
        sys.exit(2)


def describe(program: Program) -> str:
    """Return what the node is for, its parameters, topics and services, and an example."""
    topics = {topic.name: topic for topic in (*TOPICS, *ROBOT_TOPICS)}
    services = {service.name: service for service in SERVICES}
    fixed = all(row.read_only for row in program.rows)
    title = f"parameters{', fixed at the start,' if fixed else ''} and their defaults"
    sections = {
        title: [(row.name, row.shown(), row.summary() if fixed else row.meaning()) for row in program.rows],
        "publishes": [(name, topics[own(name)].type_name, topics[own(name)].way) for name in program.publishes],
        "subscribes to": [(name, topics[own(name)].type_name, topics[own(name)].way) for name in program.subscribes],
        "services and actions": [(name, services[name].type_name, services[name].does) for name in program.services],
        "calls": [(name, services[own(name)].type_name, services[own(name)].does) for name in program.requests],
    }
    parts = [program.about, *(_section(title, rows) for title, rows in sections.items() if rows)]
    return "\n\n".join([*parts, f"example:\n  {program.example}\n"])


def own(name: str) -> str:
    """Return a topic's or service's name in its motor's namespace, as it stands in the tables."""
    before, slash, after = name.partition("/motor/")
    return f"motor/{after}" if slash else before


def _section(title: str, rows: list[tuple[str, str, str]]) -> str:
    widths = [max(len(row[i]) for row in rows) for i in range(2)]
    lines = (f"  {name:{widths[0]}}  {kind:{widths[1]}}  {meaning}".rstrip() for name, kind, meaning in rows)
    return "\n".join([f"{title}:", *lines])
