"""Bytes ⇄ frames: what driver and board say to each other, without a port and without a clock.

    wire = COBS(header ‖ body ‖ crc) ‖ 0x00,   header = version u8, type u8, seq u16,   crc = CRC-32 of zlib

`Encoder` numbers and packs frames, `Decoder` takes bytes as they come and gives the frames that are right; what is not
right is counted and never returned. COBS: Cheshire & Baker, IEEE/ACM Trans. Networking 7(2), 1999.
"""

import struct
import zlib
from dataclasses import dataclass, fields
from operator import attrgetter
from typing import TypeAlias

from motor_driver.frames.codes import LONGEST_FRAME, VERSION
from motor_driver.frames.from_board import Hello, OtherVersion, Telemetry
from motor_driver.frames.protocol_error import ProtocolError
from motor_driver.frames.table import FRAMES, Frame

HEADER = struct.Struct("<BBH")
CRC = struct.Struct("<I")
LEAST = HEADER.size + CRC.size

_VALUES = {kind: tuple(map(attrgetter, (field.name for field in fields(kind)))) for kind in FRAMES.values()}


@dataclass(frozen=True, slots=True)
class Arrival:
    """A frame that came whole, and its number."""

    seq: int
    frame: Frame


Event: TypeAlias = Arrival | OtherVersion


@dataclass(frozen=True, slots=True)
class LinkCounters:
    """What a decoder has seen since it was made."""

    good: int = 0  # frames
    bad: int = 0  # frames dropped: CRC, framing, length or type
    lost: int = 0  # numbers missing between good frames (those of bad frames among them)


def stuff(data: bytes) -> bytes:
    """COBS: the same information without a zero byte (data of up to 253 bytes)."""
    return b"".join(bytes([len(run) + 1]) + run for run in data.split(b"\0"))


def unstuff(data: bytes) -> bytes | None:
    """Return the inverse of `stuff`; None if `data` is not a result of it."""
    out, at = bytearray(), 0
    while at < len(data):
        code = data[at]
        run = data[at + 1 : at + code]
        if code == 0 or len(run) != code - 1 or 0 in run:
            return None
        out += run
        at += code
        if at < len(data):
            out.append(0)
    return bytes(out) if data else None


def pack(frame: Frame, seq: int, version: int = VERSION) -> bytes:
    """Pack a frame as it goes on the wire.

    Raises:
        ProtocolError: a value that does not fit its field.
    """
    try:
        body = frame.BODY.pack(*(value(frame) for value in _VALUES[type(frame)]))
    except struct.error as error:
        raise ProtocolError(f"{frame} does not fit on the wire ({error}); limit its values before sending.") from error
    data = HEADER.pack(version, frame.TYPE, seq & 0xFFFF) + body
    return stuff(data + CRC.pack(zlib.crc32(data))) + b"\0"


def unpack(chunk: bytes) -> Event | None:
    """Unpack the frame between two zeros of the wire; None if it is not right in every respect."""
    data = unstuff(chunk)
    if data is None or len(data) < LEAST or zlib.crc32(data[: -CRC.size]) != CRC.unpack(data[-CRC.size :])[0]:
        return None
    version, number, seq = HEADER.unpack_from(data)
    if version != VERSION:
        return OtherVersion(version)
    kind = FRAMES.get(number)
    if kind is None or len(data) != LEAST + kind.BODY.size:
        return None
    return Arrival(seq, kind(*kind.BODY.unpack_from(data, HEADER.size)))


class Encoder:
    """Numbers the frames of one sender."""

    def __init__(self) -> None:
        self._next = 0

    @property
    def seq(self) -> int:
        """The number of the next frame."""
        return self._next

    def send(self, frame: Frame) -> bytes:
        """The bytes of a frame; its number is the one that `Telemetry.command` names.

        Raises:
            ProtocolError: a value that does not fit its field.
        """
        data = pack(frame, self._next)
        self._next = (self._next + 1) & 0xFFFF
        return data


class Decoder:
    """Turns a stream of bytes, cut anywhere, into the frames in it."""

    def __init__(self) -> None:
        self._buffer = bytearray()
        self._overlong = False
        self._synchronised = False  # a fragment at the start of listening is nobody's mistake
        self._good = self._bad = self._lost = 0
        self._next: int | None = None
        self._boot: int | None = None

    @property
    def counters(self) -> LinkCounters:
        """What has been seen so far."""
        return LinkCounters(self._good, self._bad, self._lost)

    def receive(self, data: bytes) -> list[Event]:
        """The frames that these bytes complete."""
        events: list[Event] = []
        *chunks, rest = data.split(b"\0")
        for chunk in chunks:
            self._gather(chunk)
            event = self._close()
            if event is not None:
                events.append(event)
        self._gather(rest)
        return events

    def _gather(self, part: bytes) -> None:
        """Keep what may still become a frame, never more."""
        if not self._overlong:
            self._buffer += part
            self._overlong = len(self._buffer) >= LONGEST_FRAME

    def _close(self) -> Event | None:
        """A zero came: what was gathered is a frame, or not."""
        chunk = b"" if self._overlong else bytes(self._buffer)
        event = unpack(chunk) if chunk else None
        if event is not None:
            self._good += 1
        elif self._synchronised and (chunk or self._overlong):
            self._bad += 1
        if isinstance(event, Arrival):
            self._count_lost(event)
        self._buffer.clear()
        self._overlong, self._synchronised = False, True
        return event

    def _count_lost(self, arrival: Arrival) -> None:
        boot = arrival.frame.boot if isinstance(arrival.frame, Hello | Telemetry) else self._boot
        gap = 0 if self._next is None else (arrival.seq - self._next) & 0xFFFF
        if boot == self._boot and gap < 0x8000:  # a board that was reset numbers from 0 again
            self._lost += gap
        self._next, self._boot = (arrival.seq + 1) & 0xFFFF, boot
