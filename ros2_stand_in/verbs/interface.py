"""`ros2 interface`: definitions of message, service and action types."""

import argparse
import re
import sys
from collections.abc import Iterator

from motor_model.errors import MotorError
from ros2_stand_in.interfaces import packages

_TITLES = {"msg": "Messages", "srv": "Services", "action": "Actions"}
_INTEGERS = {f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)}
_PRIMITIVES = _INTEGERS | {"bool", "byte", "char", "float32", "float64", "string", "wstring"}
_FIELD = re.compile(r"\s*(?P<type>[A-Za-z][\w/]*)(<=\d+)?(\[[^\]]*\])?\s+[A-Za-z]\w*")
_COMMENT = re.compile(r"""^((?:[^#"']|"[^"]*"|'[^']*')*)\#.*$""")


def interfaces_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 interface list` takes."""
    for kind, title in _TITLES.items():
        flags = f"-{kind[0]}", f"--only-{kind}s"
        parser.add_argument(*flags, action="append_const", dest="kinds", const=kind, help=f"{title.lower()} only")


def interfaces(args: argparse.Namespace) -> int:
    """Print all interface types."""
    for kind, title in _TITLES.items():
        if kind in (args.kinds or _TITLES):
            print(f"{title}:")
            for name in packages.interfaces(kind):
                print(f"    {name}")
    return 0


def show_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 interface show` takes."""
    parser.add_argument("type", help="type, such as motor_msgs/srv/Identify; '-' reads it from standard input")
    comments = parser.add_mutually_exclusive_group()
    comments.add_argument("--all-comments", action="store_true", help="show comments inside nested types too")
    comments.add_argument("--no-comments", action="store_true", help="show no comments and no empty lines")


def show(args: argparse.Namespace) -> int:
    """Print a definition; types inside it follow their field, indented by a tab."""
    name = sys.stdin.readline().strip() if args.type == "-" else args.type
    if not name:
        raise MotorError("No type came on standard input; name one, such as std_msgs/msg/Float64.")
    for line in _lines(name, not args.no_comments, args.all_comments, 0):
        print(line)
    return 0


def _lines(name: str, comments: bool, inner_comments: bool, depth: int) -> Iterator[str]:
    package = name.split("/")[0]
    for line in packages.definition(name).read_text().splitlines():
        code = _COMMENT.sub(r"\1", line).strip()
        text = line.rstrip() if comments else code
        if text or comments:
            yield "\t" * depth + text if text else ""
        nested = _nested_type(code, package)
        if nested:
            yield from _lines(nested, inner_comments, inner_comments, depth + 1)


def _nested_type(code: str, package: str) -> str | None:
    """The message type of a field; None if this line is no field, or one of a primitive type."""
    field = _FIELD.match(code)
    if field is None or field["type"] in _PRIMITIVES:
        return None
    name = "std_msgs/Header" if field["type"] == "Header" else field["type"]
    inner_package, _, base = name.rpartition("/")
    return f"{(inner_package or package).split('/')[0]}/msg/{base}"
