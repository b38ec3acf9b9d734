"""The frames that driver and board exchange, as values; `protocol.py` turns them into bytes and back.

The normative table, with the rules of who may say what when, is motor_board/protocol/wire.yaml; tests hold this file
against it. Units: times and periods in board ticks (`Hello.tick_ns`), duty in 1/`Hello.pwm_top` of full voltage.
"""

import struct
from dataclasses import dataclass
from enum import IntEnum, IntFlag
from typing import ClassVar, TypeAlias

from motor_model.errors import MotorError

VERSION = 1
BAUD = 500_000
LONGEST_FRAME = 48  # [byte] on the wire, the closing zero included
NOT_MEASURED = 65535  # supply, current


class ProtocolError(MotorError):
    """A board that speaks another version, or a value that does not fit on the wire."""


class Decay(IntEnum):
    """What the bridge does in the off part of a PWM period."""

    BRAKE = 0
    COAST = 1


class Pwm(IntEnum):
    """How fast the bridge is pulsed."""

    STANDARD = 0  # 7.8 kHz
    SILENT = 1  # 20 kHz and above


class Board(IntEnum):
    """Kinds of boards."""

    ATMEGA328P = 1
    ATMEGA2560 = 2


class Flag(IntFlag):
    """Bits of `Telemetry.flags`."""

    ENABLED = 1
    TIMED_OUT = 2
    EDGE_VALID = 4
    REVERSE = 8
    TWO_CHANNELS = 16
    OVERCURRENT = 32
    CURRENT_UNKNOWN = 64


class ResetCause(IntFlag):
    """Bits of `Hello.reset_cause`."""

    POWER_ON = 1
    EXTERNAL = 2
    BROWN_OUT = 4
    WATCHDOG = 8


@dataclass(frozen=True, slots=True)
class Identify:
    """Host: asks for a hello."""

    TYPE: ClassVar[int] = 0x01
    BODY: ClassVar[struct.Struct] = struct.Struct("<")


@dataclass(frozen=True, slots=True)
class Configure:
    """Host: switches the output off and sets how the board samples; a hello says what holds now."""

    TYPE: ClassVar[int] = 0x02
    BODY: ClassVar[struct.Struct] = struct.Struct("<IHB")
    sample_period: int  # [tick]
    command_timeout: int  # [ms]
    decay: int


@dataclass(frozen=True, slots=True)
class Setup:
    """Host: switches the output off and sets how edges are counted; features say what holds. Since firmware 1.2."""

    TYPE: ClassVar[int] = 0x06
    BODY: ClassVar[struct.Struct] = struct.Struct("<BB")
    quadrature: int  # 1, 2, 4
    pwm: int


@dataclass(frozen=True, slots=True)
class Protect:
    """Host: switches the output off and sets which current does; protection says what holds. Since firmware 1.4."""

    TYPE: ClassVar[int] = 0x07
    BODY: ClassVar[struct.Struct] = struct.Struct("<HHHI")
    zero: int  # [5 V/1024]
    most: int  # likewise, beside zero; 0: no current does
    rated: int  # likewise
    budget: int  # of (current² − rated²)/64 × sample period/64


@dataclass(frozen=True, slots=True)
class Enable:
    """Host: output on, if boot and latch are the present ones; or off."""

    TYPE: ClassVar[int] = 0x03
    BODY: ClassVar[struct.Struct] = struct.Struct("<BBB")
    on: int
    boot: int = 0
    latch: int = 0


@dataclass(frozen=True, slots=True)
class Command:
    """Host: the duty to latch at the next sample tick."""

    TYPE: ClassVar[int] = 0x04
    BODY: ClassVar[struct.Struct] = struct.Struct("<h")
    duty: int  # [1/pwm_top]


@dataclass(frozen=True, slots=True)
class Ping:
    """Host: asks for the time."""

    TYPE: ClassVar[int] = 0x05
    BODY: ClassVar[struct.Struct] = struct.Struct("<I")
    token: int


@dataclass(frozen=True, slots=True)
class Hello:
    """Board: who it is and how it samples."""

    TYPE: ClassVar[int] = 0x81
    BODY: ClassVar[struct.Struct] = struct.Struct("<BBBBHHBHHBIIHBBB")
    firmware_major: int
    firmware_minor: int
    firmware_patch: int
    board: int
    board_id: int  # 0: not set
    edges_per_revolution: int  # 0: unknown
    channels: int
    tick_ns: int
    pwm_top: int
    decay: int
    sample_period: int  # [tick]
    shortest_period: int  # [tick]
    command_timeout: int  # [ms]
    reset_cause: int
    boot: int
    latch: int

    @property
    def firmware(self) -> str:
        """Its version."""
        return f"{self.firmware_major}.{self.firmware_minor}.{self.firmware_patch}"


@dataclass(frozen=True, slots=True)
class Telemetry:
    """Board: what was true at a sample tick."""

    TYPE: ClassVar[int] = 0x82
    BODY: ClassVar[struct.Struct] = struct.Struct("<IhIIIHHBBBB")
    time: int  # [tick] wraps
    duty: int  # [1/pwm_top] latched at this sample, held until the next
    edge_count: int  # wraps
    edge_time: int  # [tick] wraps; means something only if `edge_valid`
    edge_period: int  # [tick] 0: fewer than two edges, or too far apart
    supply: int  # [mV] NOT_MEASURED
    command: int  # seq of the newest command received
    flags: int
    errors: int  # illegal transitions of the encoder's lines, wraps
    boot: int
    latch: int

    @property
    def enabled(self) -> bool:
        """Whether the output follows commands."""
        return bool(self.flags & Flag.ENABLED)

    @property
    def edge_valid(self) -> bool:
        """Whether `edge_time` is that of an edge less than 2^31 ticks ago."""
        return bool(self.flags & Flag.EDGE_VALID)


@dataclass(frozen=True, slots=True)
class Sensed(Telemetry):
    """Board: telemetry of one that senses the motor's current. Since firmware 1.3."""

    TYPE: ClassVar[int] = 0x85
    BODY: ClassVar[struct.Struct] = struct.Struct(Telemetry.BODY.format + "H")
    current: int  # [5 V/1024] at A1, just before the tick; NOT_MEASURED


@dataclass(frozen=True, slots=True)
class Pong:
    """Board: the time."""

    TYPE: ClassVar[int] = 0x83
    BODY: ClassVar[struct.Struct] = struct.Struct("<IIIHH")
    token: int
    received: int  # [tick] the last byte of the ping was there
    sent: int  # [tick] the first byte of this frame went out
    bad_frames: int  # from the host, dropped since the reset, wraps
    dropped_samples: int  # ticks since the reset whose telemetry was not sent, wraps


@dataclass(frozen=True, slots=True)
class Features:
    """Board: what holds after a setup. Since firmware 1.2."""

    TYPE: ClassVar[int] = 0x84
    BODY: ClassVar[struct.Struct] = struct.Struct("<BBB")
    quadrature: int
    pwm: int
    silent_decays: int  # bit 0: silent PWM can brake, bit 1: it can coast


@dataclass(frozen=True, slots=True)
class Protection:
    """Board: what holds after a protect. Since firmware 1.4."""

    TYPE: ClassVar[int] = 0x86
    BODY: ClassVar[struct.Struct] = struct.Struct("<HHHI")
    zero: int
    most: int  # 0: the board does not sense the current
    rated: int
    budget: int


@dataclass(frozen=True, slots=True)
class OtherVersion:
    """A good frame of another protocol version: nothing in it can be read but this."""

    version: int

    def error(self, where: str) -> ProtocolError:
        """The refusal; `where` names the port."""
        cure = "flash the board with this workbench's firmware (ros2 run motor_board flash)"
        if self.version > VERSION:
            cure = "update this workbench, or flash the board with its older firmware (ros2 run motor_board flash)"
        return ProtocolError(
            f"The board on {where} speaks protocol version {self.version}, this driver version {VERSION}: {cure}."
        )


FromHost: TypeAlias = Identify | Configure | Setup | Protect | Enable | Command | Ping
FromBoard: TypeAlias = Hello | Telemetry | Sensed | Pong | Features | Protection
Frame: TypeAlias = FromHost | FromBoard
FRAMES: dict[int, type[Frame]] = {
    kind.TYPE: kind
    for kind in (
        *(Identify, Configure, Setup, Protect, Enable, Command, Ping),
        *(Hello, Telemetry, Sensed, Pong, Features, Protection),
    )
}
