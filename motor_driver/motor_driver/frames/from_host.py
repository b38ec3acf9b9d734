"""What the host says to the board."""

import struct
from dataclasses import dataclass
from typing import ClassVar, TypeAlias


@dataclass(frozen=True, slots=True)
class Identify:
    """Asks for a hello."""

    TYPE: ClassVar[int] = 0x01
    BODY: ClassVar[struct.Struct] = struct.Struct("<")


@dataclass(frozen=True, slots=True)
class Configure:
    """Switches the output off and sets how the board samples; a hello says what holds now."""

    TYPE: ClassVar[int] = 0x02
    BODY: ClassVar[struct.Struct] = struct.Struct("<IHB")
    sample_period: int  # [tick]
    command_timeout: int  # [ms]
    decay: int


@dataclass(frozen=True, slots=True)
class Setup:
    """Switches the output off and sets how edges are counted; features say what holds. Since firmware 1.2."""

    TYPE: ClassVar[int] = 0x06
    BODY: ClassVar[struct.Struct] = struct.Struct("<BB")
    quadrature: int  # 1, 2, 4
    pwm: int


@dataclass(frozen=True, slots=True)
class Protect:
    """Switches the output off and sets which current does; protection says what holds. Since firmware 1.4."""

    TYPE: ClassVar[int] = 0x07
    BODY: ClassVar[struct.Struct] = struct.Struct("<HHHI")
    zero: int  # [5 V/1024]
    most: int  # likewise, beside zero; 0: no current does
    rated: int  # likewise
    budget: int  # of (current² − rated²)/64 × sample period/64


@dataclass(frozen=True, slots=True)
class Enable:
    """Output on, if boot and latch are the present ones; or off."""

    TYPE: ClassVar[int] = 0x03
    BODY: ClassVar[struct.Struct] = struct.Struct("<BBB")
    on: int
    boot: int = 0
    latch: int = 0


@dataclass(frozen=True, slots=True)
class Command:
    """The duty to latch at the next sample tick."""

    TYPE: ClassVar[int] = 0x04
    BODY: ClassVar[struct.Struct] = struct.Struct("<h")
    duty: int  # [1/pwm_top]


@dataclass(frozen=True, slots=True)
class Ping:
    """Asks for the time."""

    TYPE: ClassVar[int] = 0x05
    BODY: ClassVar[struct.Struct] = struct.Struct("<I")
    token: int


FromHost: TypeAlias = Identify | Configure | Setup | Protect | Enable | Command | Ping
