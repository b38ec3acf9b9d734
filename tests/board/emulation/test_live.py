"""The real firmware behind a real pseudo-terminal, in real time, with everything that can be wrong on the way."""

import time
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from threading import Event

import pytest
from emulated_board import Client
from patience import PATIENCE

from motor_board.emulation.live import LiveBoard
from motor_board.emulation.port import Port
from motor_board.errors import BoardError
from motor_driver.frames.codes import ResetCause
from motor_driver.frames.from_board import Hello, Pong, Telemetry
from motor_driver.frames.from_host import Command, Configure, Enable, Identify, Ping

Connect = Callable[[], Client]


def switch_on(client: Client, timeout: int = 1_000) -> None:
    """Output on, at 0; the longest time-out [ms], because a busy machine may hold this program up."""
    client.send(Configure(10_000, timeout, 0))
    telemetry = client.wait_for(Telemetry)
    while not telemetry.enabled:  # the first ones may be from before the configure, which latches anew
        client.send(Enable(1, telemetry.boot, telemetry.latch))
        telemetry = client.wait_for(Telemetry)


def configure(client: Client, period: int) -> None:
    """Sampling at a period [tick]; the events begin after the board's answer (its hello at power-up is not that)."""
    client.send(Configure(period, 100, 0))
    client.wait(lambda: any(hello.latch == 1 for hello in client.all(Hello)))
    client.events.clear()


def drive(client: Client, duty: int, samples: int) -> None:
    for _ in range(samples):
        client.send(Command(duty))
        client.wait_for(Telemetry)


def test_hello(connect: Connect) -> None:
    hello = connect().ask(Identify())
    assert (hello.board, hello.edges_per_revolution, hello.tick_ns, hello.pwm_top) == (1, 96, 500, 256)


@pytest.mark.parametrize("period", [10_000, 2_000], ids=["200 Hz", "1 kHz"])
def test_telemetry_without_a_gap(connect: Connect, period: int) -> None:
    client = connect()
    configure(client, period)
    client.wait_for(Telemetry, 150)
    assert {b.time - a.time for a, b in pairwise(client.all(Telemetry)[1:])} == {period}
    assert client.decode.counters.bad == client.decode.counters.lost == 0


@pytest.mark.on_time
def test_the_motor_turns_when_told_to_and_stops_when_the_driver_dies(connect: Connect, live: LiveBoard) -> None:
    client = connect()
    switch_on(client, 400)
    drive(client, 128, 60)
    assert live.truth().voltage == 6.0 and 60 < live.truth().speed < 87.1
    assert client.all(Telemetry)[-1].edge_count > 50
    client.events.clear()
    client.wait(lambda: bool(client.all(Telemetry)) and not client.all(Telemetry)[-1].enabled)
    on = [telemetry for telemetry in client.all(Telemetry) if telemetry.enabled]
    assert 60 <= len(on) <= 82 and live.truth().voltage == 0.0  # 400 ms are 80 samples; a few were heard before
    assert client.all(Telemetry)[-1].duty == 0


def test_unplug_and_replug(connect: Connect, live: LiveBoard, tmp_path: Path) -> None:
    client = connect()
    switch_on(client)
    drive(client, 128, 10)
    live.faults = replace(live.faults, plugged=False)
    with pytest.raises(OSError, match="hung up"):
        client.wait(lambda: False)
    assert not (tmp_path / "port").exists()
    live.faults = replace(live.faults, plugged=True)
    while not (tmp_path / "port").exists():
        time.sleep(0.001)
    again = connect()
    again.wait_for(Telemetry)
    again.wait(lambda: not again.all(Telemetry)[-1].enabled)
    assert live.truth().resets == 0
    again.wait(lambda: live.truth().voltage == 0.0)


def test_reset_and_opening_that_resets(connect: Connect, live: LiveBoard) -> None:
    client = connect()
    boot = client.ask(Identify()).boot
    live.reset()
    hello = client.wait_for(Hello)
    assert (hello.boot, hello.reset_cause) == (boot + 1, ResetCause.EXTERNAL)
    live.faults = replace(live.faults, reset_on_open=True)
    client.close()
    while live._port._connected:
        time.sleep(0.001)
    client = connect()
    assert client.wait_for(Hello).boot == boot + 2


def test_bit_errors_cost_frames_but_no_frame_is_wrong(connect: Connect, live: LiveBoard) -> None:
    client = connect()
    configure(client, 2_000)
    live.faults = replace(live.faults, bit_error_rate=1e-3)
    client.wait_for(Telemetry, 300)
    counters = client.decode.counters
    assert 30 < counters.lost < 400 and counters.bad > 20  # 1 − (1 − 1e-3)^288 is a quarter
    frames = client.all(Telemetry)
    assert all((b.time - a.time) % 2_000 == 0 and 0 < b.time - a.time <= 40_000 for a, b in pairwise(frames))
    assert {(f.duty, f.edge_count, f.edge_time, f.supply, f.flags) for f in frames} == {(0, 0, 0, 65535, 0)}


def test_dropped_bytes_and_delays_leave_whole_frames(connect: Connect, live: LiveBoard) -> None:
    client = connect()
    configure(client, 2_000)
    live.faults = replace(live.faults, drop_rate=1e-3, delay=0.01)
    client.wait_for(Telemetry, 300)
    assert client.decode.counters.lost > 2
    frames = client.all(Telemetry)
    assert all((b.time - a.time) % 2_000 == 0 and b.time > a.time for a, b in pairwise(frames))


def test_stuck_telemetry_is_silence_while_the_board_still_hears(connect: Connect, live: LiveBoard) -> None:
    client = connect()
    switch_on(client)
    live.faults = replace(live.faults, stuck_telemetry=True)
    end = time.monotonic() + 10
    while live.truth().voltage != 6.0:
        client.send(Command(128))
        time.sleep(0.005)
        assert time.monotonic() < end
    live.faults = replace(live.faults, stuck_telemetry=False)
    client.wait_for(Telemetry)


def test_without_its_encoder_it_counts_nothing(connect: Connect, live: LiveBoard) -> None:
    client = connect()
    live.faults = replace(live.faults, encoder_connected=False)
    switch_on(client)
    drive(client, 256, 40)
    assert live.truth().speed > 50 and client.all(Telemetry)[-1].edge_count == 0
    assert not client.all(Telemetry)[-1].edge_valid


def leave(client: Client, live: LiveBoard) -> None:
    client.close()
    while live._port._connected:
        time.sleep(0.001)


def first_heard_by(client: Client) -> int:
    """The time [tick] of the first sample that a client gets."""
    client.wait_for(Telemetry)
    return client.all(Telemetry)[0].time


def test_a_late_client_gets_no_old_frames(connect: Connect, live: LiveBoard) -> None:
    first = connect()
    seen = first.wait_for(Telemetry).time
    leave(first, live)
    while live.truth().cycle < 8 * seen + 4_000_000:
        time.sleep(0.001)
    assert first_heard_by(connect()) - seen > 480_000  # it may have been on its way


def test_what_a_client_left_unread_is_not_for_the_next(connect: Connect, live: LiveBoard) -> None:
    first = connect()
    seen = first.wait_for(Telemetry).time
    while live.truth().cycle < 8 * seen + 4_000_000:
        time.sleep(0.001)
    leave(first, live)
    assert first_heard_by(connect()) - seen > 480_000


def test_a_board_that_was_held_up_does_not_say_afterwards_what_was_before_a_client_came(
    connect: Connect, live: LiveBoard, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = connect()
    configure(first, 2_000)
    leave(first, live)
    hold, held, look = Event(), Event(), live._port.opened

    def opened() -> bool:
        held.set()
        assert hold.wait(PATIENCE)
        return look()

    monkeypatch.setattr(live._port, "opened", opened)

    def come_late() -> tuple[float, int]:
        """How much later [cycle] than a client its first sample is, and how often the board's time stood still."""
        hold.clear()
        held.clear()
        assert held.wait(PATIENCE)
        behind = live.truth()
        while time.monotonic_ns() < behind.start + (behind.cycle / behind.rate) + 30_000_000:
            time.sleep(0.001)
        late, now = connect(), time.monotonic_ns()
        hold.set()
        heard = first_heard_by(late)
        stood_still = live.truth().held_up - behind.held_up
        leave(late, live)
        return 8 * heard - ((now - behind.start) * behind.rate - behind.clock_zero), stood_still

    later, stood_still = come_late()
    while stood_still:  # for a machine that held this up for 10 ms more: its samples' times are no longer those
        later, stood_still = come_late()
    assert later > -3 * 8 * 2_000


def test_the_truth_says_when_a_sample_was(connect: Connect, live: LiveBoard) -> None:
    """A pong's times on the computer's clock: the ping went out before, the pong came after."""
    client = connect()
    live.faults = replace(live.faults, clock_error=300.0)
    client.wait_for(Telemetry, 3)
    for token in range(20):
        before = time.monotonic_ns()
        pong = client.ask(Ping(token), Pong)
        after = time.monotonic_ns()
        truth = live.truth()
        received, sent = (
            truth.start + (truth.clock_zero + 8 * tick) / truth.rate for tick in (pong.received, pong.sent)
        )
        assert truth.held_up or before < received < sent < after
    assert abs(live.truth().rate / 0.016 - 1.0003) < 1e-9


def test_a_port_that_is_taken_is_refused_in_a_sentence(live: LiveBoard, tmp_path: Path) -> None:
    with pytest.raises(BoardError, match="is the port of another emulator: set the parameter link"):
        Port(tmp_path / "port")
    (tmp_path / "file").write_text("mine")
    with pytest.raises(BoardError, match="exists and is no link to a port"):
        Port(tmp_path / "file")
    with pytest.raises(BoardError, match="cannot make .*No such file"):
        Port(tmp_path / "nowhere" / "port").plug()


def test_a_link_that_a_killed_emulator_left_is_replaced(tmp_path: Path) -> None:
    (tmp_path / "port").symlink_to("/dev/pts/9999")
    port = Port(tmp_path / "port")
    port.plug()
    assert (tmp_path / "port").exists()
    port.close()
    assert not (tmp_path / "port").is_symlink()
