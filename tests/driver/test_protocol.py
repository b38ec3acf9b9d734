"""Bytes ⇄ frames on the driver's side: nothing wrong is ever returned, and little is lost with it."""

from dataclasses import fields
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from motor_driver.frames.from_board import Hello, Pong, Telemetry
from motor_driver.frames.from_host import Command, Ping
from motor_driver.frames.protocol_error import ProtocolError
from motor_driver.frames.table import FRAMES, Frame
from motor_driver.protocol import Arrival, Decoder, Encoder, LinkCounters, pack, stuff, unstuff

RANGES = {"B": (0, 255), "H": (0, 65535), "h": (-32768, 32767), "I": (0, 2**32 - 1)}
HELLO = dict.fromkeys((field.name for field in fields(Hello)), 0)


def values(kind: type[Frame]) -> st.SearchStrategy[Frame]:
    return st.builds(kind, *(st.integers(*RANGES[letter]) for letter in kind.BODY.format[1:]))


frames = st.one_of([values(kind) for kind in FRAMES.values()])


@given(st.binary(max_size=250))
def test_cobs_has_no_zero_and_comes_back(data: bytes) -> None:
    assert 0 not in stuff(data) and len(stuff(data)) == len(data) + 1
    assert unstuff(stuff(data)) == data


@given(st.binary(min_size=1, max_size=250))
def test_whatever_is_no_cobs_is_refused(data: bytes) -> None:
    plain = unstuff(data)
    assert plain is None or stuff(plain) == data


@given(st.lists(frames, max_size=8), st.lists(st.integers(0, 300)))
def test_frames_come_back_however_the_bytes_are_cut(sent: list[Frame], cuts: list[int]) -> None:
    encoder, decoder = Encoder(), Decoder()
    wire = b"".join(map(encoder.send, sent))
    places = sorted({min(cut, len(wire)) for cut in cuts})
    events = [
        event for a, b in zip([0, *places], [*places, len(wire)], strict=True) for event in decoder.receive(wire[a:b])
    ]
    assert events == [Arrival(i, frame) for i, frame in enumerate(sent)]
    assert decoder.counters == LinkCounters(len(sent), 0, 0)


@given(st.lists(frames, min_size=3, max_size=6), st.data())
def test_damage_costs_at_most_the_frames_it_touches(sent: list[Frame], data: st.DataObject) -> None:
    """One byte is changed, lost or added: at most two frames are gone, the others are right, and none is made up."""
    encoder, decoder = Encoder(), Decoder()
    wire = bytearray(b"".join(map(encoder.send, sent)))
    at = data.draw(st.integers(0, len(wire) - 1))
    kind = data.draw(st.sampled_from(["change", "lose", "add"]))
    byte = data.draw(st.integers(0, 255))
    wire[at : at + (kind != "add")] = b"" if kind == "lose" else bytes([byte])
    events = decoder.receive(bytes(wire))
    whole = [Arrival(i, frame) for i, frame in enumerate(sent)]
    assert all(event in whole for event in events)
    assert len(events) >= len(sent) - 2


@given(st.binary(max_size=400))
def test_noise_is_no_frame_and_a_good_one_after_it_is(noise: bytes) -> None:
    decoder = Decoder()
    assert decoder.receive(noise) == []
    assert decoder.receive(b"\0" + pack(Ping(7), 3)) == [Arrival(3, Ping(7))]


def test_20_000_damaged_frames_give_no_wrong_value() -> None:
    """1 bit in 100 flips; benchmarks/wire_fuzz.py does the same with a million."""
    random = np.random.default_rng(2)
    encoder, decoder = Encoder(), Decoder()
    sent = [Telemetry(*map(int, random.integers(0, 256, 9)), boot=3, latch=0) for _ in range(20_000)]
    wire = np.frombuffer(b"".join(map(encoder.send, sent)), dtype=np.uint8)
    flips = np.packbits(random.random((len(wire), 8)) < 0.01, axis=1)[:, 0]
    events = decoder.receive((wire ^ flips).tobytes())
    assert 500 < len(events) < 3_000  # 36 bytes stay whole with a chance of 0.055
    assert all(isinstance(event, Arrival) and event.frame == sent[event.seq] for event in events)
    counters = decoder.counters
    assert counters.good == len(events) and 15_000 < counters.bad < 40_000
    assert counters.lost == events[-1].seq - events[0].seq + 1 - len(events)  # type: ignore[union-attr]


def test_a_fragment_at_the_start_is_nobody_s_mistake() -> None:
    decoder = Decoder()
    wire = pack(Ping(7), 3)
    assert decoder.receive(wire[4:] + wire) == [Arrival(3, Ping(7))]
    assert decoder.counters == LinkCounters(1, 0, 0)


def test_an_endless_frame_takes_no_memory() -> None:
    decoder = Decoder()
    for _ in range(1_000):
        decoder.receive(b"\x01" * 1_000)
    assert len(decoder._buffer) < 2_000
    assert decoder.receive(b"\0" + pack(Ping(1), 0)) == [Arrival(0, Ping(1))]


def test_lost_frames_are_counted_over_the_wrap_but_not_over_a_reset() -> None:
    decoder = Decoder()
    telemetry = {
        "duty": 0,
        "edge_count": 0,
        "edge_time": 0,
        "edge_period": 0,
        "supply": 0,
        "command": 0,
        "flags": 0,
        "errors": 0,
    }

    def hear(seq: int, boot: int | None) -> int:
        frame = Pong(0, 0, 0, 0, 0) if boot is None else Telemetry(time=0, **telemetry, boot=boot, latch=0)
        decoder.receive(pack(frame, seq))
        return decoder.counters.lost

    assert [hear(65_533, 9), hear(65_534, 9), hear(1, 9), hear(2, None), hear(4, 9)] == [0, 0, 2, 2, 3]
    assert [hear(0, 10), hear(1, 10), hear(3, 10)] == [3, 3, 4]
    decoder.receive(pack(Hello(**HELLO | {"boot": 11}), 0))
    assert [hear(1, 11), hear(3, 11)] == [4, 5]


@pytest.mark.parametrize("frame", [Command(40_000), Ping(-1), Ping(2**32)])
def test_a_value_that_does_not_fit_is_refused_in_a_sentence(frame: Any) -> None:
    with pytest.raises(ProtocolError, match="does not fit on the wire"):
        pack(frame, 0)
