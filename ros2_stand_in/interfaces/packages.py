"""What is installed: packages, executables and interfaces on the ament path."""

import difflib
import os
from collections.abc import Iterable
from pathlib import Path

from motor_model.errors import MotorError

_INDEX = Path("share/ament_index/resource_index")


class NotInstalled(MotorError):
    """A package, executable or interface that is not on the path."""


def prefixes() -> list[Path]:
    """Where packages are looked for, first wins.

    Raises:
        NotInstalled: the workspace is not sourced.
    """
    path = os.environ.get("AMENT_PREFIX_PATH", "")
    if not path:
        raise NotInstalled("No packages are on the path: 'source env.sh' in the workbench's root, then try again.")
    return [Path(entry) for entry in path.split(os.pathsep) if entry]


def package_names() -> list[str]:
    """All packages, sorted."""
    return sorted({entry.name for prefix in prefixes() for entry in _entries(prefix / _INDEX / "packages")})


def package_prefix(package: str) -> Path:
    """The prefix that a package is installed to.

    Raises:
        NotInstalled: there is no such package.
    """
    for prefix in prefixes():
        if (prefix / _INDEX / "packages" / package).is_file():
            return prefix
    raise NotInstalled(f"Package '{package}' not found{_hint(package, package_names())}")


def executables(package: str) -> list[Path]:
    """The executable files of a package, sorted by path.

    Raises:
        NotInstalled: there is no such package.
    """
    folder = package_prefix(package) / "lib" / package
    files = (path for path in folder.rglob("*") if path.is_file() and os.access(path, os.X_OK))
    return sorted(path for path in files if not any(part.startswith(".") for part in path.relative_to(folder).parts))


def executable(package: str, name: str) -> Path:
    """The path of one executable.

    Raises:
        NotInstalled: there is no such package, or it has no such executable.
    """
    paths = executables(package)
    for path in paths:
        if path.name == name:
            return path
    have = f"it has: {', '.join(path.name for path in paths)}" if paths else "it has none"
    raise NotInstalled(f"Package '{package}' has no executable '{name}'; {have}.")


def interfaces(kind: str) -> list[str]:
    """All types of a kind (msg, srv, action), as package/kind/Name, sorted by package and name."""
    found = set()
    for prefix in prefixes():
        for package in _entries(prefix / _INDEX / "rosidl_interfaces"):
            for line in package.read_text().splitlines():
                folder, _, file = line.partition("/")
                if folder == kind and "_" not in file:
                    found.add((package.name, file.rsplit(".", 1)[0]))
    return [f"{package}/{kind}/{name}" for package, name in sorted(found)]


def definition(interface: str) -> Path:
    """The file that defines package/kind/Name.

    Raises:
        NotInstalled: the name is not of that form, or there is no such interface.
    """
    parts = interface.split("/")
    if len(parts) != 3 or not all(parts) or ".." in parts:
        raise NotInstalled(f"'{interface}' is not a type name such as std_msgs/msg/Float64.")
    package, kind, name = parts
    path = package_prefix(package) / "share" / package / kind / f"{name}.{kind}"
    if not path.is_file():
        raise NotInstalled(f"There is no interface '{interface}'{_hint(interface, interfaces(kind))}")
    return path


def _entries(folder: Path) -> Iterable[Path]:
    return folder.iterdir() if folder.is_dir() else ()


def _hint(name: str, names: list[str]) -> str:
    close = difflib.get_close_matches(name, names, n=3)
    return f"; did you mean {' or '.join(close)}?" if close else "."
