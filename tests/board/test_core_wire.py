"""The firmware's codec, on this computer: against the shared vectors, zlib and the driver's codec."""

import json
import zlib
from ctypes import byref, create_string_buffer
from typing import Any

import firmware_core as core
import pytest
from hypothesis import given
from hypothesis import strategies as st

from motor_board.places import share
from motor_board.wire_table import load_table, seal
from motor_driver.frames.from_host import Ping
from motor_driver.frames.table import FRAMES
from motor_driver.protocol import Arrival, Decoder, pack, stuff, unstuff

VECTORS: dict[str, Any] = json.loads((share() / "protocol" / "vectors.json").read_text(encoding="utf-8"))
TABLE = load_table()


class Reader:
    """The firmware's reader of frames."""

    def __init__(self) -> None:
        self.core, self.reader = core.load(), core.FrameReader()

    def receive(self, wire: bytes) -> list[tuple[int, int, int, bytes]]:
        """Version, type, seq and body of the frames in some bytes."""
        frames, frame = [], core.Frame()
        for byte in wire:
            if self.core.frame_read(byref(self.reader), byte, byref(frame)):
                frames.append((frame.version, frame.type, frame.seq, bytes(frame.body[: frame.size])))
        return frames


def sealed(frame_type: int, seq: int, body: bytes) -> bytes:
    """A frame as the firmware sends it."""
    data, wire = create_string_buffer(bytes(4) + body + bytes(4), 48), create_string_buffer(48)
    length = core.load().frame_seal(data, frame_type, seq, len(body), wire)
    return wire.raw[:length]


@given(st.binary(max_size=200))
def test_crc_is_zlib_s(data: bytes) -> None:
    assert core.load().crc_of(data, len(data)) == zlib.crc32(data)


@given(st.binary(max_size=250))
def test_cobs_is_the_driver_s(data: bytes) -> None:
    out = create_string_buffer(256)
    length = core.load().cobs_stuff(data, len(data), out)
    assert out.raw[:length] == stuff(data)


@given(st.binary(max_size=250) | st.binary(max_size=250).map(stuff))
def test_cobs_is_undone_and_refused_as_the_driver_does(data: bytes) -> None:
    plain = unstuff(data)
    buffer = create_string_buffer(data, len(data) + 1)
    length = core.load().cobs_unstuff(buffer, len(data))
    assert buffer.raw[:length] == (plain or b"")


@pytest.mark.parametrize("vector", VECTORS["good"], ids=lambda vector: f"{vector['frame']} {vector['seq']}")
def test_the_firmware_makes_and_reads_the_vectors(vector: dict[str, Any]) -> None:
    row, wire = TABLE.frame(vector["frame"]), bytes.fromhex(vector["wire"])
    body = TABLE.data(row.name, vector["seq"], vector["values"])[4:]
    assert sealed(row.type, vector["seq"], body) == wire
    assert Reader().receive(wire) == [(TABLE.version, row.type, vector["seq"], body)]


def test_the_firmware_reads_no_vector_whose_bytes_are_bad() -> None:
    for vector in VECTORS["bad"]:
        reader = Reader()
        frames = reader.receive(b"\0" + bytes.fromhex(vector["wire"]))
        by_its_type = "type" in vector["about"] or "a byte too" in vector["about"]  # right bytes; device_act refuses
        assert len(frames) == by_its_type and reader.reader.bad == (not by_its_type), vector["about"]


def test_the_firmware_sees_another_version() -> None:
    ((version, *_),) = Reader().receive(bytes.fromhex(VECTORS["other_version"]["wire"]))
    assert version == VECTORS["other_version"]["version"]


pieces = st.one_of(
    st.binary(max_size=60),
    st.integers(0, 65535).map(lambda seq: pack(Ping(seq * 65537), seq)),
    st.integers(0, 65535).map(lambda seq: seal(TABLE.data("command", seq, {"duty": 0}))),
    st.just(b"\0"),
)


@given(st.lists(pieces, max_size=12).map(b"".join))
def test_firmware_and_driver_read_the_same_from_anything(wire: bytes) -> None:
    reader, decoder = Reader(), Decoder()
    known = [
        (frame_type, seq, body)
        for _, frame_type, seq, body in reader.receive(wire)
        if frame_type in FRAMES and FRAMES[frame_type].BODY.size == len(body)
    ]
    events = [event for event in decoder.receive(wire) if isinstance(event, Arrival)]
    assert known == [(event.frame.TYPE, event.seq, pack(event.frame, 0) and _body(event)) for event in events]
    assert reader.reader.bad == decoder.counters.bad


def _body(event: Arrival) -> bytes:
    plain = unstuff(pack(event.frame, event.seq)[:-1])
    assert plain is not None
    return plain[4:-4]
