"""The files of this package, and those that the user names."""

from pathlib import Path

from ament_index_python.packages import get_package_share_directory

from motor_model.errors import MotorError


def config(name: str) -> str:
    """Return the path of a parameter file of this package."""
    return str(Path(get_package_share_directory("motor_bringup")) / "config" / name)


def named(path: str, what: str) -> str:
    """Return an absolute path, so that it does not matter where a program is started.

    Raises:
        MotorError: there is no such file.
    """
    if not path:
        raise MotorError(f"no {what} was named.")
    found = Path(path).expanduser().absolute()
    if not found.exists():
        raise MotorError(f"there is no {what} {found}: name one that there is, or leave the argument out.")
    return str(found)
