"""A computer's clock that is set while the motor runs, for `faults_live.py`: by an hour, ahead or back.

The clock of this computer stays as it is: a library of ours (`faults_clock.c`) stands between programs and it.
"""

import mmap
import os
import struct
import subprocess
from dataclasses import dataclass
from pathlib import Path

from faults_held_up import run_loop
from faults_live_stage import Stage

SOURCE = Path(__file__).with_suffix(".c")
HOUR = 3600.0  # [s]


class Clock:
    """The wall clock of programs that are started with its environment."""

    def __init__(self, folder: Path, name: str) -> None:
        """Build the library, and let the clock be right."""
        library, self._file = folder / "clock.so", folder / f"{name}.set"
        if not library.exists():
            words = ["cc", "-shared", "-fPIC", "-O2", "-o", library, SOURCE, "-ldl"]
            subprocess.run(words, check=True)
        self._file.write_bytes(bytes(8))
        self.environment = {"LD_PRELOAD": str(library), "CLOCK_SET": str(self._file)}

    def set(self, seconds: float) -> None:
        """Let the clock be ahead by so many seconds, or behind."""
        file = os.open(self._file, os.O_RDWR)
        with mmap.mmap(file, 8) as memory:
            memory[:] = struct.pack("q", round(seconds * 1e9))
        os.close(file)


@dataclass(frozen=True)
class SetClock:
    """The clock of a plant's computer, of a controller's, or of both is set."""

    plant: float  # [s] by which it is ahead then
    controller: float  # [s]

    def __call__(self, stage: Stage) -> None:
        """Let a loop run, and set the clocks."""
        clocks = []
        for begin, name in ((stage.plant, "plant"), (stage.controller, "controller")):
            clocks.append(Clock(stage.folder, name))
            stage.environment = clocks[-1].environment
            begin()
        run_loop(stage, stream=True)
        for clock, seconds in zip(clocks, (self.plant, self.controller), strict=True):
            clock.set(seconds)
