"""Numbers of the wire table: version, sizes, and what the codes in frames mean."""

from enum import IntEnum, IntFlag

VERSION = 1
BAUD = 500_000
LONGEST_FRAME = 48  # [byte] on the wire, the closing zero included
NOT_MEASURED = 65535  # supply, current


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
