"""Look up installed interfaces by names such as `std_msgs/msg/Float64`: the one place where a name becomes an import.

The name comes out of a bag or from the network, and whoever wrote it must not choose what is imported: it has to have
the form of an interface's name, be in the ament index, and its Python package has to lie in the prefix named there.
"""

import re
import sys
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from ament_index_python.packages import PackageNotFoundError, get_package_prefix

from motor_model.errors import MotorError

# As rosidl's own parser has it; behind _ stands a part of a service or an action, such as Diagnose_Feedback.
_NAME = re.compile(r"([a-z][a-z0-9_]*)/(msg|srv|action)/([A-Z][A-Za-z0-9]*)((?:_[A-Za-z0-9]+)*)")


class NotInstalled(MotorError):
    """A type that is not one of the installed interfaces."""


def definition_file(type_name: str, suffix: str = "") -> Path:
    """Return the installed file that defines a type; `suffix` chooses another beside it, such as `.json`.

    Raises:
        NotInstalled: the name is not of the form package/kind/Name, or there is no such interface.
    """
    match = _NAME.fullmatch(type_name)
    if match is None:
        raise NotInstalled(f"{type_name!r} is not the name of a type; one looks like std_msgs/msg/Float64.")
    package, kind, name, _part = match.groups()
    path = _prefix(package) / "share" / package / kind / f"{name}{suffix or f'.{kind}'}"
    if not path.is_file():
        raise NotInstalled(f"the type {type_name} is not installed here: install its package and source it.")
    return path


def load(type_name: str) -> Any:
    """Return the class of an installed message, service or action type, or of a part of one.

    Raises:
        NotInstalled: there is no such type, or its Python code is not where its package is installed.
    """
    definition_file(type_name)
    package, kind, name = type_name.split("/")
    _check_place(package)
    try:
        return getattr(import_module(f"{package}.{kind}"), name)
    except (ImportError, AttributeError) as error:
        raise NotInstalled(f"{type_name} cannot be loaded ({error}): build its package, then source it.") from error


def load_message(type_name: str) -> Any:
    """Return the class of an installed type that can be sent on a topic.

    Raises:
        NotInstalled: there is no such type, or it is a service or an action as a whole.
    """
    found = load(type_name)
    if not hasattr(found, "get_fields_and_field_types"):
        raise NotInstalled(f"{type_name} is not the type of a message; one looks like std_msgs/msg/Float64.")
    return found


def _prefix(package: str) -> Path:
    try:
        return Path(get_package_prefix(package)).resolve()
    except (PackageNotFoundError, LookupError, OSError, ValueError) as error:
        raise NotInstalled(f"the package {package} is not installed here: install it and source it.") from error


def _check_place(package: str) -> None:
    """Refuse a package that Python would take from elsewhere, such as the working directory."""
    loaded = sys.modules.get(package)
    spec = loaded.__spec__ if loaded is not None else find_spec(package)
    places = list(spec.submodule_search_locations or ()) if spec is not None else []
    prefix = _prefix(package)
    if not places or not all(Path(place).resolve().is_relative_to(prefix) for place in places):
        where = f"in {places[0]}" if places else "nowhere"
        raise NotInstalled(f"the Python package {package} is {where}, not in {prefix} where it is installed.")
