"""Builds the firmware with avr-gcc and the emulated chip with the PC's compiler, once for each state of the sources."""

import hashlib
import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from motor_board.errors import BoardError
from motor_board.places import share

BRIDGES = {"l298n": 1, "tb6612": 2, "drv8871": 3}
WARNINGS = ("-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wsign-conversion", "-Wshadow")
STRICT = ("-Werror",)  # in tests; another version of the compiler may warn of more, and shall still build
CHIPS = ("atmega328p", "atmega2560")  # an Arduino Uno or Nano, a Mega
AVR = ("-std=gnu99", "-DF_CPU=16000000UL", "-O2", "-flto")
MOST_KEPT = 100  # results of a kind, of 17 kB: settings and states of the sources; the tests alone use forty
PACKAGES = "sudo apt install gcc-avr avr-libc libsimavr-dev libelf-dev gcc"


@dataclass(frozen=True)
class FirmwareConfig:
    """What differs from set-up to set-up (firmware/board/config.h)."""

    bridge: str = "l298n"  # l298n | tb6612 | drv8871
    board_id: int = 0
    edges_per_revolution: int = 0  # of one polarity; 0: the board does not know
    channels: int = 1  # of the encoder
    supply_full_scale: int = 0  # [mV] supply that puts 5 V on A0; 0: not measured
    current_sense: bool = False  # A1 has a voltage that follows the motor's current
    chip: str = "atmega328p"  # | atmega2560

    def defines(self) -> tuple[str, ...]:
        """As the compiler takes them.

        Raises:
            BoardError: a value that no board can have.
        """
        if self.bridge not in BRIDGES:
            raise BoardError(f"there is no bridge '{self.bridge}': choose one of {', '.join(BRIDGES)}.")
        if self.chip not in CHIPS:
            raise BoardError(f"there is no firmware for '{self.chip}': choose one of {', '.join(CHIPS)}.")
        if self.channels not in (1, 2):
            raise BoardError(f"an encoder has 1 or 2 channels, not {self.channels}.")
        values = {
            "BRIDGE": (BRIDGES[self.bridge], 255),
            "BOARD_ID": (self.board_id, 65535),
            "EDGES_PER_REVOLUTION": (self.edges_per_revolution, 65535),
            "CHANNELS": (self.channels, 2),
            "SUPPLY_FULL_SCALE": (self.supply_full_scale, 65534),
            "CURRENT_SENSE": (int(self.current_sense), 1),
        }
        for name, (value, most) in values.items():
            if not 0 <= value <= most:
                raise BoardError(f"{name.lower()} is {value}: it must be from 0 to {most}.")
        return tuple(f"-DMOTOR_{name}={value}" for name, (value, _) in values.items())


def sources(*folders: str, suffixes: Iterable[str] = (".c",)) -> list[Path]:
    """Return the files of some folders of the package."""
    return sorted(path for folder in folders for path in (share() / folder).iterdir() if path.suffix in suffixes)


def first_error(said: str) -> str:
    """Return the line of a compiler's report that says what is wrong: the first error, or else the last line."""
    lines = said.strip().splitlines() or ["it says nothing"]
    return next((line.strip() for line in lines if " error: " in line), lines[-1].strip())


def firmware(config: FirmwareConfig | None = None, strict: bool = False) -> Path:
    """Return the firmware's ELF file; with `strict` a warning is an error.

    Raises:
        BoardError: the compiler is missing or refuses the sources.
    """
    folders = ("firmware/core", "firmware/board")
    include = [f"-I{share() / folder}" for folder in folders]
    config = config or FirmwareConfig()
    options = [f"-mmcu={config.chip}", *AVR, *WARNINGS, *(STRICT if strict else ()), *config.defines(), *include]
    return _built("firmware.elf", "avr-gcc", options, folders, ())


def chip_library(strict: bool = False) -> Path:
    """Return the emulated chip as a shared library; with `strict` a warning is an error.

    Raises:
        BoardError: the compiler or libsimavr is missing.
    """
    options = ["-std=gnu11", "-O2", "-shared", "-fPIC", "-Wall", "-Wextra", *(STRICT if strict else ())]
    return _built("chip.so", "gcc", options, ("emulator",), ("-lsimavr", "-lelf"))


def core_library() -> Path:
    """Return the firmware's portable core, compiled for this computer.

    Raises:
        BoardError: the compiler is missing or refuses the sources.
    """
    options = ["-std=c99", "-O1", "-shared", "-fPIC", *WARNINGS, *STRICT]
    return _built("core.so", "gcc", options, ("firmware/core",), ())


def _cache() -> Path:
    """Beside the package's byte code, or where the user keeps such things if that cannot be written."""
    beside = Path(__file__).resolve().parent / "__pycache__"
    beside.mkdir(exist_ok=True) if os.access(beside.parent, os.W_OK) else None
    if os.access(beside, os.W_OK):
        return beside
    return Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "motor_board"


def _built(name: str, compiler: str, options: Sequence[str], folders: Sequence[str], libraries: Sequence[str]) -> Path:
    """The result of a compiler run, kept under the digest of all that went into it."""
    found = shutil.which(compiler)
    if found is None:
        raise BoardError(f"{compiler} is not installed: {PACKAGES}")
    digest = hashlib.sha256(repr((found, options, libraries)).encode())
    for path in sources(*folders, suffixes=(".c", ".h")):
        digest.update(path.read_bytes())
    result = _cache() / f"{Path(name).stem}-{digest.hexdigest()[:16]}{Path(name).suffix}"
    if not result.exists():
        _compile([found, *options, *map(str, sources(*folders))], libraries, result)
    return result


def _compile(command: list[str], libraries: Sequence[str], result: Path) -> None:
    """Run the compiler; the result appears whole or not at all."""
    result.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=result.parent) as folder:
        made = Path(folder) / result.name
        done = subprocess.run([*command, "-o", str(made), *libraries], capture_output=True, text=True)
        if done.returncode != 0:
            missing = "simavr" in done.stderr and "No such file" in done.stderr or "cannot find -l" in done.stderr
            missing = missing or "avr/io.h: No such file" in done.stderr
            raise BoardError(
                f"libraries are missing here: {PACKAGES}"
                if missing
                else f"{command[0]} refuses: {first_error(done.stderr)}"
            )
        os.replace(made, result)
    kind = f"{result.stem.partition('-')[0]}-*{result.suffix}"
    for old in sorted(result.parent.glob(kind), key=lambda path: path.stat().st_mtime)[:-MOST_KEPT]:
        old.unlink(missing_ok=True)
