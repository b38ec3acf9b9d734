"""The firmware as a sketch folder, for those who flash from the Arduino IDE.

The IDE compiles only what lies in the sketch's own folder, so that the firmware's two folders are copied into one; kept
as copies in the source tree they would drift.
"""

import shutil
from pathlib import Path

from motor_board.build import FirmwareConfig, sources
from motor_board.errors import BoardError

INO = """// Firmware of the motor workbench for an Arduino Uno, Nano or Mega, by `ros2 run motor_board flash --sketch`.
// All of it is in the .c files beside this one; main.c brings its own main(), nothing of the Arduino library is used.
// Settings are in config.h.
"""


def write_sketch(folder: Path, config: FirmwareConfig) -> Path:
    """Write the sketch into a folder that is empty or not there yet; returns the .ino to open.

    Raises:
        BoardError: there is something in the folder, or it cannot be written.
    """
    defines = "\n".join(f"#define {option[2:].replace('=', ' ')}" for option in config.defines())
    try:
        if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
            raise BoardError(f"{folder} is not an empty folder: name one that does not exist yet.")
        folder.mkdir(parents=True, exist_ok=True)
        for path in sources("firmware/core", "firmware/board", suffixes=(".c", ".h")):
            shutil.copyfile(path, folder / path.name)
        text = (folder / "config.h").read_text(encoding="utf-8")
        (folder / "config.h").write_text(f"{defines}\n\n{text}", encoding="utf-8")
        ino = folder / f"{folder.resolve().name}.ino"  # the IDE wants it named after its folder
        ino.write_text(INO, encoding="utf-8")
    except OSError as error:
        raise BoardError(f"cannot write {folder} ({error.strerror}): name another folder.") from error
    return ino
