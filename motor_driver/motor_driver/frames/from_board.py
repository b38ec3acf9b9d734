"""What the board says to the host."""

import struct
from dataclasses import dataclass
from typing import ClassVar, TypeAlias

from motor_driver.frames.codes import VERSION, Flag
from motor_driver.frames.protocol_error import ProtocolError


@dataclass(frozen=True, slots=True)
class Hello:
    """Who it is and how it samples."""

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
    """What was true at a sample tick."""

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
    """Telemetry of one that senses the motor's current. Since firmware 1.3."""

    TYPE: ClassVar[int] = 0x85
    BODY: ClassVar[struct.Struct] = struct.Struct(Telemetry.BODY.format + "H")
    current: int  # [5 V/1024] at A1, just before the tick; NOT_MEASURED


@dataclass(frozen=True, slots=True)
class Pong:
    """The time."""

    TYPE: ClassVar[int] = 0x83
    BODY: ClassVar[struct.Struct] = struct.Struct("<IIIHH")
    token: int
    received: int  # [tick] the last byte of the ping was there
    sent: int  # [tick] the first byte of this frame went out
    bad_frames: int  # from the host, dropped since the reset, wraps
    dropped_samples: int  # ticks since the reset whose telemetry was not sent, wraps


@dataclass(frozen=True, slots=True)
class Features:
    """What holds after a setup. Since firmware 1.2."""

    TYPE: ClassVar[int] = 0x84
    BODY: ClassVar[struct.Struct] = struct.Struct("<BBB")
    quadrature: int
    pwm: int
    silent_decays: int  # bit 0: silent PWM can brake, bit 1: it can coast


@dataclass(frozen=True, slots=True)
class Protection:
    """What holds after a protect. Since firmware 1.4."""

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


FromBoard: TypeAlias = Hello | Telemetry | Sensed | Pong | Features | Protection
