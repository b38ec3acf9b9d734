"""The emulated microcontroller: the real firmware on libsimavr, advanced cycle by cycle by its caller."""

from ctypes import c_uint8, c_uint64
from dataclasses import dataclass
from enum import IntEnum
from math import ceil, floor
from pathlib import Path

from motor_board.emulation.edges import Edges
from motor_board.emulation.interrupts import MOST_VECTORS, VECTORS, InterruptLoad
from motor_board.emulation.library import Load, load_library
from motor_board.errors import BoardError

FREQUENCY = 16_000_000  # [Hz]
MOST_BYTES = 4096  # taken out at once
CONVERTER_STEPS, CONVERTER_REFERENCE = 1024, 5.0  # [V]


class Hang(IntEnum):
    """How a program fails."""

    HALTED = 0  # an endless loop, interrupts off
    LOOPING = 1  # an endless loop while interrupts run
    TICKLESS = 2  # all runs but the sample tick


@dataclass(frozen=True, slots=True)
class Pins:
    """Mean levels of the bridge's pins, in 1/256."""

    enable: int  # D3
    forward: int  # D5, on a Mega D7
    reverse: int  # D6

    @property
    def share(self) -> float:
        """Of the full voltage that the bridge gives, −1 to 1 (at most one of the pins is pulsed)."""
        return self.enable * (self.forward - self.reverse) / 65536


class Chip:
    """The chip that a program is for. Time is in clock cycles since power-up and goes on through resets."""

    def __init__(self, elf: Path) -> None:
        """Raises: BoardError: the ELF is none for this chip, or libsimavr is missing."""
        self._library = load_library()
        self._chip = self._library.chip_open(str(elf).encode())
        if not self._chip:
            raise BoardError(
                f"{elf} is no program for an ATmega328P or ATmega2560: "
                "build it again (ros2 run motor_board flash --build)."
            )
        self._bytes = (c_uint8 * MOST_BYTES)()
        self._cycles = (c_uint64 * MOST_BYTES)()

    def close(self) -> None:
        """Give its memory back."""
        if self._chip:
            self._library.chip_close(self._chip)
            self._chip = None

    @property
    def name(self) -> str:
        """Which chip it is, as the compiler calls it."""
        return str(self._library.chip_name(self._chip).decode())

    @property
    def cycle(self) -> int:
        """Now."""
        return int(self._library.chip_cycle(self._chip))

    def run(self, until: int) -> bool:
        """Run until a cycle, or until the pins have changed (True).

        Raises:
            BoardError: the program has crashed.
        """
        came_back: int = self._library.chip_run(self._chip, until)
        if came_back == 2:
            raise BoardError("the firmware on the emulated chip has crashed: report this, with what was sent to it.")
        return came_back == 1

    @property
    def pins(self) -> Pins:
        """Of the bridge, now."""
        pins = self._library.chip_pins(self._chip)
        return Pins(pins.enable, pins.forward, pins.reverse)

    @property
    def written(self) -> int:
        """The cycle at which the program last wrote to the pins, a little before `run` came back for it."""
        return int(self._library.chip_written(self._chip))

    @property
    def pull_ups(self) -> tuple[bool, bool]:
        """Whether those of the encoder's lines, A and B, are switched on."""
        bits = int(self._library.chip_pull_ups(self._chip))
        return bool(bits & 1), bool(bits & 2)

    def set_edges(self, after: int, edges: Edges) -> None:
        """Replace the encoder's edges after a cycle by these, ascending.

        Raises:
            BoardError: there are more of them than the chip has room for.
        """
        count = len(edges.cycle)
        cycles, what = (edges.cycle.ctypes.data, edges.what.ctypes.data) if count else (None, None)
        if self._library.chip_edges(self._chip, after, cycles, what, count) < count:
            raise BoardError("more encoder edges than the emulated board has room for: use shorter steps.")

    def feed(self, data: bytes) -> int:
        """Bytes into the serial port; how many of them there was room for."""
        return int(self._library.chip_feed(self._chip, data, len(data)))

    def drain(self) -> bytes:
        """What has come out of the serial port."""
        return bytes(self._bytes[: self._drain()])

    def drain_with_cycles(self) -> list[tuple[int, int]]:
        """The bytes that came out, each with the cycle at which it began."""
        count = self._drain()
        return list(zip(self._bytes[:count], self._cycles[:count], strict=True))

    def _drain(self) -> int:
        return int(self._library.chip_drain(self._chip, self._bytes, self._cycles, MOST_BYTES))

    def reset(self) -> None:
        """Press the reset button."""
        self._library.chip_reset(self._chip)

    def power_up(self) -> None:
        """Switch the board's power off and on."""
        self._library.chip_power_up(self._chip)

    @property
    def resets(self) -> int:
        """How often it was reset since power-up, for whatever reason."""
        return int(self._library.chip_resets(self._chip))

    @property
    def clock_zero(self) -> int:
        """The cycle at which the program last started its own clock, from 0."""
        return int(self._library.chip_clock_zero(self._chip))

    def supply(self, volts_at_a0: float) -> None:
        """The voltage at A0 [V]."""
        self._library.chip_supply(self._chip, _millivolts(volts_at_a0))

    @property
    def sensing(self) -> int:
        """The cycle at which the program began to convert A1 since the last look, or 0: say now what is there."""
        return int(self._library.chip_sensing(self._chip))

    def sense(self, volts_at_a1: float) -> None:
        """The voltage at A1 [V]; the chip's clamps keep it from 0 to 5 V."""
        self._library.chip_sense(self._chip, _millivolts(volts_at_a1))

    def hang(self, how: Hang) -> None:
        """Let the program fail in a way that only its watchdog ends."""
        self._library.chip_hang(self._chip, how)

    def load(self) -> tuple[dict[str, InterruptLoad], int]:
        """What interrupts have cost since the last call, and for how many cycles the program slept."""
        loads, names = (Load * MOST_VECTORS)(), VECTORS[self.name]
        slept = int(self._library.chip_load(self._chip, loads))
        rows = {names.get(i, str(i)): row for i, row in enumerate(loads) if row.calls}
        return {
            name: InterruptLoad(row.calls, row.cycles, row.longest, row.waited) for name, row in rows.items()
        }, slept


def _millivolts(volts: float) -> int:
    """What the emulator is to be told, so that its converter reads as a real one.

    A real one has 1,024 steps of 5/1,024 V; simavr makes 1,023 steps of the reference, and takes whole millivolts.
    """
    step = min(max(floor(volts * CONVERTER_STEPS / CONVERTER_REFERENCE), 0), CONVERTER_STEPS - 1)
    return ceil(1000.0 * CONVERTER_REFERENCE * step / (CONVERTER_STEPS - 1))
