"""Where the package's files are: beside this package in the source tree, else in its installed share folder."""

from functools import cache
from pathlib import Path

_HERE = Path(__file__).resolve().parent


@cache
def share() -> Path:
    """Return the folder with firmware/, emulator/ and protocol/."""
    source = _HERE.parent
    if (source / "firmware").is_dir():
        return source
    from ament_index_python.packages import get_package_share_directory  # only an installed copy needs it

    return Path(get_package_share_directory("motor_board"))
