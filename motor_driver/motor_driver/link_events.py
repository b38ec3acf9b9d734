"""What happens at a serial port."""

from dataclasses import dataclass
from typing import TypeAlias


@dataclass(frozen=True, slots=True)
class Opened:
    """The port was opened."""

    port: str
    at: int  # [ns] time.monotonic_ns
    roll_call: bool = False  # its board is only to say its number


@dataclass(frozen=True, slots=True)
class Received:
    """Bytes were read."""

    data: bytes
    at: int  # [ns]


@dataclass(frozen=True, slots=True)
class Closed:
    """The port is gone or cannot be opened; `why` is a sentence that names the cure."""

    why: str
    passed: bool = False  # by ourselves, in a search


Event: TypeAlias = Opened | Received | Closed
