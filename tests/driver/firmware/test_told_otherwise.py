"""Somebody else tells a running board how to drive: another program on the port, or a device that repeats bytes.

Of 1 V that was asked for 2.5 V and more came to the pins after the next enable, unsaid, and a board whose driver had
died drove its motor for a second.
"""

from dataclasses import replace

import pytest
from driver_rig import MakeRig, Rig, problem
from electrical import ELECTRIC, LUMPED
from tiers import mark_slow

from motor_board.build import FirmwareConfig
from motor_board.emulation.faults import Faults
from motor_board.emulation.serial_line import SerialLine
from motor_board.emulation.wiring import Wiring
from motor_driver.config import Config
from motor_driver.current_limits import CurrentLimits
from motor_driver.frames.codes import Decay, Pwm
from motor_driver.frames.from_board import Hello
from motor_driver.frames.from_host import Command, Configure, Enable, FromHost, Ping, Protect, Setup
from motor_driver.protocol import pack, unstuff
from motor_model.parameters import Parameters

OTHERS = "somebody else tells the board on the port how to drive, or switches it on"
FAST = (Setup(1, 1), Configure(10_000, 1000, 1))  # 100 steps of duty in place of 256, and 1 s of time-out


def say(rig: Rig, *frames: FromHost) -> None:
    """Somebody else's bytes come to the board."""
    rig.emulator.chip.feed(b"\0" + b"".join(pack(frame, 40_000 + k) for k, frame in enumerate(frames)))


def slowly(make_rig: MakeRig, **settings: object) -> Rig:
    """A motor that is driven with 1 V."""
    rig = make_rig(**settings)
    rig.run(20)
    rig.plug()
    rig.voltage = 1.0
    rig.until(lambda: rig.pins > 0.9, 900)
    rig.run(100)
    return rig


@pytest.mark.parametrize(
    "frames",
    [
        FAST,
        mark_slow((Setup(1, 1), Configure(10_000, 120, 0))),
        mark_slow((Configure(10_000, 1000, 0),)),
        mark_slow((Configure(10_000, 120, 1),)),
        mark_slow((Configure(500_000, 1000, 0),)),
        mark_slow((Configure(1 << 24, 1000, 0),)),
    ],
    ids=str,
)
def test_after_the_next_enable_the_motor_gets_what_is_asked_for(
    make_rig: MakeRig, frames: tuple[FromHost, ...]
) -> None:
    rig = slowly(make_rig)
    volts = rig.pins
    say(rig, *frames)
    rig.run(600)
    assert rig.pins == 0.0 and rig.stops[0].startswith(OTHERS) and OTHERS in problem(rig)
    assert rig.enable() == ""
    rig.until(lambda: rig.pins != 0.0, 60)
    rig.run(300)
    assert rig.pins == volts == rig.readings[-1].sample.voltage and rig.gate.enabled
    rig.alive = False
    assert 100.0 < rig.until(lambda: rig.pins == 0.0, 1500) < 130.0


def test_it_does_so_where_no_answer_to_somebody_else_is_heard(make_rig: MakeRig) -> None:
    """What the board said of it is lost: nobody knows but by the latch."""
    rig = slowly(make_rig)
    volts = rig.pins
    rig.faults = replace(rig.faults, stuck_telemetry=True)
    say(rig, *FAST)
    rig.run(20)
    rig.faults = replace(rig.faults, stuck_telemetry=False)
    rig.run(100)
    assert rig.stops == ["the board switched off"] and rig.enable() == ""
    rig.until(lambda: rig.pins != 0.0, 60)
    rig.run(300)
    assert rig.pins == volts and rig.gate.enabled


def test_current_limits_that_somebody_else_takes_away_hold_again(make_rig: MakeRig) -> None:
    config = Config(current_gain=0.185, current_limits=CurrentLimits(4.0, 2.0, 0.2))
    motor = Parameters(LUMPED, ("coulomb_friction",), **ELECTRIC)
    board = FirmwareConfig(edges_per_revolution=96, current_sense=True)
    rig = slowly(make_rig, config=config, firmware=board, parameters=motor)
    say(rig, Protect(512, 0, 0, 0))
    rig.run(50)
    assert rig.emulator.shaft.voltage == 0.0 and rig.stops[0].startswith(OTHERS)
    assert rig.enable() == ""
    rig.until(lambda: rig.pins != 0.0, 60)
    rig.emulator.wiring = Wiring(shaft_stuck=True)
    rig.voltage = 11.0
    rig.run(150)
    assert rig.pins == 0.0 and "current was above current_limit" in rig.stops[1]


def test_a_board_that_is_switched_off_and_on_by_somebody_else_between_two_samples_is_a_stop(make_rig: MakeRig) -> None:
    rig = slowly(make_rig)
    session = rig.driver.session
    assert session is not None and session.latest is not None
    boot, latch = session.latest.boot, session.latest.latch
    count = len(rig.readings)
    rig.until(lambda: len(rig.readings) > count, 10)
    say(rig, *FAST, Enable(1, boot, (latch + 2) % 256), Command(256))
    fast = [0.0]
    for _ in range(100):
        rig.run(1)
        fast.append(rig.pins)
    assert rig.stops[0].startswith(OTHERS) and sum(volts > 2.0 for volts in fast) <= 11  # two samples
    assert set(fast[20:]) == {0.0}


@pytest.mark.parametrize("frames", [FAST, mark_slow((Configure(10_000, 120, 0),))], ids=str)
def test_as_long_as_somebody_goes_on_nothing_is_switched_on_and_nothing_starts_by_itself_then(
    make_rig: MakeRig, frames: tuple[FromHost, ...]
) -> None:
    rig = slowly(make_rig)
    pins = set()
    for k in range(150):
        say(rig, *frames)
        rig.run(10)
        if k == 20:
            assert rig.enable() == ""
        pins |= {rig.pins} if k > 2 else set()
    assert pins == {0.0} and not rig.gate.enabled
    rig.run(500)
    assert rig.pins == 0.0 and rig.enable() == ""
    rig.until(lambda: rig.pins != 0.0, 60)


def test_a_command_of_somebody_else_under_the_number_of_a_ping_of_ours_is_a_stop(make_rig: MakeRig) -> None:
    """It came again and again: 12 V for a tenth of the time, unsaid, where 1 V was asked for."""
    rig = slowly(make_rig)
    send = rig._in.send

    def send_more(data: bytes, faults: object, now: int) -> None:
        send(data, faults, now)  # type: ignore[arg-type]
        for part in data.split(b"\0"):
            plain = unstuff(part) if part else None
            if plain is not None and plain[1] == Ping.TYPE:
                send(pack(Command(256), int.from_bytes(plain[2:4], "little")), faults, now)  # type: ignore[arg-type]

    rig._in.send = send_more  # type: ignore[method-assign]
    pins: list[float] = []
    while len(pins) < 3000 and not rig.stops:
        rig.run(1)
        pins.append(rig.pins)
    for _ in range(100):
        rig.run(1)
        pins.append(rig.pins)
    assert len(rig.stops) == 1 and "obeyed a command that this driver had not sent" in rig.stops[0]
    assert sum(volts > 2.0 for volts in pins) <= 11 and set(pins[-80:]) == {0.0}


def test_a_board_with_silent_pwm_is_known_again_after_a_reset(make_rig: MakeRig) -> None:
    """Its steps of duty are those of the other PWM until it is configured: "another board than the one that ran"."""
    rig = slowly(make_rig, config=Config(pwm=Pwm.SILENT, decay=Decay.COAST))
    rig.emulator.reset()
    rig.run(600)
    assert rig.stops[-1].startswith("the board was reset") and rig.enable() == ""
    rig.until(lambda: rig.pins != 0.0, 60)


class Slow(SerialLine):
    """Bytes that all come equally late, and of which some hellos are lost."""

    def __init__(self, delay: float) -> None:
        super().__init__(0)
        self._delay = round(delay * 1e6)  # [ns]
        self.lost: set[int] = set()  # of the next hellos, from 1 on
        self._hellos, self._begun = 0, b""

    def send(self, data: bytes, faults: Faults, now: int) -> None:
        *frames, self._begun = (self._begun + data).split(b"\0")
        for frame in frames:
            plain = unstuff(frame) if frame else None
            self._hellos += bool(self.lost) and plain is not None and plain[1] == Hello.TYPE
            if plain is None or plain[1] != Hello.TYPE or self._hellos not in self.lost:
                self._late.append((now + self._delay, frame + b"\0"))


@pytest.mark.parametrize(("delay", "lost"), [(30.0, {2}), (44.0, {2}), (30.0, {1, 3}), (30.0, {2, 3})], ids=str)
def test_on_a_slow_line_that_loses_an_answer_an_enable_soon_after_an_off_is_no_stop(
    make_rig: MakeRig, delay: float, lost: set[int]
) -> None:
    """The first time that the board is told, the switch's off is still under way: of 25 enables 4 were stops."""
    rig = make_rig()
    rig._in, rig._out = Slow(delay), (out := Slow(delay))
    rig.run(20)
    rig.plug()
    rig.voltage = 1.0
    rig.until(lambda: rig.pins > 0.9, 2000)
    rig.run(300)
    assert rig.enable(False) == ""
    rig.run(100)
    out.lost = lost
    assert rig.pins == 0.0 and rig.enable() == ""
    rig.until(lambda: rig.pins > 0.9, 600)
    assert rig.stops == []
