"""The serial line's faults: as many as were asked for, in order, and none without being asked."""

from motor_board.emulation.faults import Faults
from motor_board.emulation.serial_line import SerialLine

DATA = bytes(range(256)) * 400


def through(faults: Faults) -> bytes:
    wire = SerialLine(1)
    wire.send(DATA, faults, 0)
    return wire.receive(0)


def test_a_sound_wire_passes_everything_at_once() -> None:
    assert through(Faults()) == DATA


def test_bits_flip_at_their_rate() -> None:
    out = through(Faults(bit_error_rate=1e-3))
    flipped = sum((a ^ b).bit_count() for a, b in zip(DATA, out, strict=True))
    expected = 1e-3 * 8 * len(DATA)  # 819 ± 29
    assert 0.85 * expected < flipped < 1.15 * expected


def test_bytes_are_lost_at_their_rate_and_the_others_stay_in_order() -> None:
    out = through(Faults(drop_rate=0.1))
    assert 0.88 * len(DATA) < len(out) < 0.92 * len(DATA)
    rest = iter(DATA)
    assert all(byte in rest for byte in out)


def test_late_bytes_come_in_order_and_within_the_delay() -> None:
    wire = SerialLine(1)
    sent = [bytes([k]) for k in range(100)]
    for k, data in enumerate(sent):
        wire.send(data, Faults(delay=0.01), k * 1_000_000)
    assert wire.receive(0) == b"" and 0 < len(wire.receive(50_000_000)) < 51
    wire.send(b"end", Faults(), 99_000_000)
    late = wire.receive(109_000_000)
    assert late.endswith(b"\x63end")  # nothing overtakes what is before it
    assert wire.receive(10**12) == b""


def test_a_cut_loses_what_is_on_its_way() -> None:
    wire = SerialLine(1)
    wire.send(b"lost", Faults(delay=0.01), 0)
    wire.cut()
    assert wire.receive(10**9) == b""
