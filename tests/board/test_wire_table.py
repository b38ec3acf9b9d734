"""One table: what was generated from it is current, and the driver's frames are its rows."""

import json
import struct
from dataclasses import fields
from typing import Any

import pytest

from motor_board.places import share
from motor_board.wire_table import load_table, seal
from motor_driver import protocol
from motor_driver.frames import codes
from motor_driver.frames.from_board import OtherVersion
from motor_driver.frames.from_host import Enable
from motor_driver.frames.table import FRAMES
from motor_driver.protocol import Arrival, Decoder, pack, unpack

TABLE = load_table()
VECTORS: dict[str, Any] = json.loads((share() / "protocol" / "vectors.json").read_text(encoding="utf-8"))
KINDS = {kind.__name__.lower(): kind for kind in FRAMES.values()}


def test_the_driver_has_the_table_s_constants() -> None:
    assert (TABLE.version, TABLE.baud, TABLE.longest_frame) == (codes.VERSION, codes.BAUD, codes.LONGEST_FRAME)
    enums = {"decay": codes.Decay, "board": codes.Board, "pwm": codes.Pwm}
    for name, members in TABLE.values.items():
        assert {member.name.lower(): member.value for member in enums[name]} == members
    flags = {"flag": codes.Flag, "reset_cause": codes.ResetCause}
    for name, bits in TABLE.bits.items():
        assert {member.name.lower(): member.value for member in flags[name]} == {k: 1 << bit for k, bit in bits.items()}


def test_the_driver_has_all_of_the_table_s_frames_and_no_other() -> None:
    assert set(KINDS) == {row.name for row in TABLE.frames}


@pytest.mark.parametrize("row", TABLE.frames, ids=lambda row: row.name)
def test_the_driver_s_frames_are_the_table_s_rows(row: Any) -> None:
    kind = KINDS[row.name]
    assert (kind.TYPE, kind.BODY.format) == (row.type, row.layout)
    assert [field.name for field in fields(kind)] == [field.name for field in row.fields]


def test_no_frame_is_longer_than_the_longest() -> None:
    sizes = {row.name: struct.calcsize(row.layout) + 8 + 2 for row in TABLE.frames}
    assert max(sizes.values()) <= TABLE.longest_frame
    assert sizes["telemetry"] * 1000 < 0.8 * TABLE.baud / 10  # 1 kHz leaves a fifth of the line for the rest


@pytest.mark.parametrize("vector", VECTORS["good"], ids=lambda vector: f"{vector['frame']} {vector['seq']}")
def test_the_driver_makes_and_reads_the_vectors(vector: dict[str, Any]) -> None:
    frame = KINDS[vector["frame"]](**vector["values"])
    wire = bytes.fromhex(vector["wire"])
    assert pack(frame, vector["seq"]) == wire
    assert Decoder().receive(wire) == [Arrival(vector["seq"], frame)]


@pytest.mark.parametrize("vector", VECTORS["bad"], ids=lambda vector: vector["about"])
def test_the_driver_reads_no_bad_vector(vector: dict[str, Any]) -> None:
    decoder = Decoder()
    assert decoder.receive(b"\0" + bytes.fromhex(vector["wire"])) == []
    assert decoder.counters == protocol.LinkCounters(0, 1, 0)


def test_another_version_is_known_and_refused_in_a_sentence() -> None:
    wire = bytes.fromhex(VECTORS["other_version"]["wire"])
    (event,) = Decoder().receive(wire)
    assert event == OtherVersion(TABLE.version + 1)
    newer, older = (str(OtherVersion(v).error("/dev/ttyACM0")) for v in (TABLE.version + 1, TABLE.version - 1))
    assert "/dev/ttyACM0 speaks protocol version 2, this driver version 1" in newer and "update" in newer
    assert "speaks protocol version 0" in older and "motor_board flash" in older and "update" not in older


def test_sealing_by_the_definitions_is_what_the_driver_does() -> None:
    data = TABLE.data("enable", 0, {"on": 1, "boot": 0, "latch": 0})
    assert unpack(seal(data)[:-1]) == Arrival(0, Enable(1, 0, 0))
