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
        MotorError: there is no such file, or the name is one that no file can have.
    """
    if not path:
        raise MotorError(f"no {what} was named.")
    found = Path(path).expanduser().absolute()
    try:
        there = found.exists()
    except OSError as error:  # such as a name of more than 255 characters
        raise MotorError(f"the {what} {found} cannot be read ({error.strerror}): name another one.") from error
    if not there:
        raise MotorError(f"there is no {what} {found}: name one that there is, or leave the argument out.")
    return str(found)
