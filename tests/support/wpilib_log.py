"""A WPILOG as WPILib's DataLog writes it, of a motor under the four tests of a SysId routine."""

from math import floor, tau
from pathlib import Path
from struct import pack

KV, KA, KS = 0.12, 0.012, 0.25  # [V·s/rad], [V·s²/rad], [V]
TESTS = ("quasistatic-forward", "quasistatic-reverse", "dynamic-forward", "dynamic-reverse")
FORMS = {"double": "<d", "float": "<f", "int64": "<q", "boolean": "<?"}


def _least(number: int) -> bytes:
    return number.to_bytes(max((number.bit_length() + 7) // 8, 1), "little")


def record(entry: int, time: int, payload: bytes) -> bytes:
    """A record, each of its numbers as short as can be."""
    parts = _least(entry), _least(len(payload)), _least(time)
    head = (len(parts[0]) - 1) | (len(parts[1]) - 1) << 2 | (len(parts[2]) - 1) << 4
    return bytes([head]) + b"".join(parts) + payload


class Log:
    """Grows as it is written."""

    def __init__(self, extra: str = "") -> None:
        self.data = b"WPILOG" + pack("<HI", 0x0100, len(extra)) + extra.encode()
        self._kinds: list[str] = []

    def start(self, name: str, kind: str, metadata: str = "", time: int = 0) -> int:
        """Begin an entry; its number."""
        self._kinds.append(kind)
        number = len(self._kinds)
        texts = b"".join(pack("<I", len(text)) + text.encode() for text in (name, kind, metadata))
        self.data += record(0, time, b"\0" + pack("<I", number) + texts)
        return number

    def put(self, entry: int, value: float | str, time: int) -> None:
        """Append a value at a time [us]."""
        kind = self._kinds[entry - 1]
        payload = value.encode() if isinstance(value, str) else pack(FORMS[kind], value)
        self.data += record(entry, time, payload)


def write_routine(path: Path, period: float = 0.02, counts: int = 2048) -> None:
    """A drive of one motor, logged in rotations; every entry some microseconds after the one before."""
    log, steps = Log(), 100
    state = log.start("sysid-test-state-drive", "string")
    voltage = log.start("voltage-left-drive", "double", "Volt")
    position = log.start("position-left-drive", "double", "Rotation")
    speed = log.start("velocity-left-drive", "double", "Rotation per Second")
    battery, enabled = log.start("/battery", "float"), log.start("/enabled", "boolean")
    time, angle, omega = 1_000_000, 0.0, 0.0
    for name in (*(one for test in TESTS for one in (test, "none")),):
        sign = -1.0 if "reverse" in name else 1.0
        for k in range(round(5.0 / period)):
            seconds = k * period
            volts = sign * (1.0 * seconds if "quasi" in name else 7.0 if "dynamic" in name and seconds < 1.5 else 0.0)
            log.put(state, name, time)
            log.put(voltage, volts, time + 7)
            log.put(position, floor(angle / tau * counts) / counts, time + 13)
            log.put(speed, omega / tau, time + 21)
            if k % 50 == 0:
                log.put(battery, 12.4, time + 30)
                log.put(enabled, True, time + 33)
            for _ in range(steps):
                push = volts - KV * omega
                friction = KS * (1.0 if omega > 0.0 else -1.0) if omega else max(-KS, min(KS, push))
                moved = omega + (push - friction) / KA * period / steps
                omega = 0.0 if omega * moved < 0.0 and abs(volts) <= KS else moved
                angle += omega * period / steps
            time += round(period * 1e6)
    path.write_bytes(log.data)
