"""Bytes that drove the motor are written to the port again, by somebody who has it open or by what repeats them."""

from collections.abc import Callable

from driver_rig import Rig
from emulated_board import MS

from motor_driver.frames.from_host import Command
from motor_driver.protocol import Encoder

MOST = 150.0  # [ms]


def recorded_with_times(rig: Rig, act: Callable[[], object]) -> list[tuple[int, bytes]]:
    """What is sent while something is done, each burst with its cycle."""
    bursts: list[tuple[int, bytes]] = []
    send = rig._in.send
    rig._in.send = lambda data, faults, now: (bursts.append((rig.emulator.chip.cycle, data)), send(data, faults, now))[
        1
    ]  # type: ignore[method-assign]
    act()
    rig._in.send = send  # type: ignore[method-assign]
    return [(cycle, burst) for cycle, burst in bursts if burst]


def recorded(rig: Rig) -> list[bytes]:
    """What drives the motor for 0.2 s."""
    return [burst for _, burst in recorded_with_times(rig, lambda: rig.run(200))]


def pins_under(rig: Rig, bursts: list[bytes]) -> list[float]:
    """[V] at the pins, every millisecond; a burst comes again every 5 ms, and all of them for long enough."""
    pins = []
    for k in range(max(5 * len(bursts), round(2.0 * MOST))):
        if k % 5 == 0:
            rig._in.send(bursts[k // 5 % len(bursts)], rig.faults, rig.now)
        rig.run(1)
        pins.append(rig.pins)
    return pins


def test_commands_that_come_again_do_not_act_beside_a_driver(running: Rig) -> None:
    """They drove the motor at 98 % of their voltage while 0 V was asked for, and nobody noticed."""
    bursts = recorded(running)
    running.voltage = 0.0
    running.until(lambda: running.pins == 0.0, 30)
    assert set(pins_under(running, bursts)) == {0.0} and running.stops == []
    running.voltage = 6.0
    running.until(lambda: running.pins == 6.0, 30)


def test_commands_that_come_again_keep_no_dead_driver_s_motor_running(running: Rig) -> None:
    """For ever, as if the driver lived."""
    bursts = recorded(running)
    running.alive = False
    pins = pins_under(running, bursts)
    assert pins.index(0.0) < MOST and set(pins[pins.index(0.0) :]) == {0.0}


def test_another_s_commands_that_are_there_from_the_enable_on_stop_the_motor(running: Rig) -> None:
    """Frames of a second driver with numbers ahead of the first one's: 6 V for ever, while 0 V was asked for."""
    running.voltage = 0.0
    running.until(lambda: running.pins == 0.0, 30)
    running.gate = running.gate.enable(False)
    running.run(50)
    session = running.driver.session
    assert session is not None
    foreign, running.gate = Encoder(), running.gate.enable(True)
    foreign._next = (session.encoder.seq + 500) % 65536
    pins = []
    for k in range(400):
        if k % 2 == 0:
            running._in.send(foreign.send(Command(128)), running.faults, running.now)
        running.run(1)
        pins.append(running.pins)
    assert len(running.stops) == 1 and "obeyed a command that this driver had not sent" in running.stops[0]
    assert sum(volts != 0.0 for volts in pins) < 75 and set(pins[100:]) == {0.0}


def test_a_whole_session_that_comes_again_after_a_power_down_drives_nothing(make_rig: Callable[..., Rig]) -> None:
    """Start for start the chip woke up with the same number, and obeyed the recorded enable and all that followed."""
    rig = make_rig()
    rig.run(20)
    rig.voltage = 6.0
    session = recorded_with_times(rig, lambda: (rig.plug(), rig.run(600)))
    assert rig.pins == 6.0
    rig.alive = False
    for starts in (1, 255, 1):  # all in all 256, after which their numbers of 8 bits come again
        for _ in range(starts):
            rig.run(6)
            rig.emulator.power_up()
        start, pins = rig.emulator.chip.cycle, set()
        for cycle, burst in session:
            rig.run((start + cycle - rig.emulator.chip.cycle) / MS)
            rig._in.send(burst, rig.faults, rig.now)
            pins.add(rig.pins)
        assert pins == {0.0}


def test_commands_of_a_session_far_back_keep_no_motor_running(running: Rig) -> None:
    """The numbers of frames wrap: those from half of a turn back were newer than the driver's latest."""
    bursts = recorded(running)
    session = running.driver.session
    assert session is not None
    for _ in range(40):  # the driver goes on to numbers from which the old ones are ahead, but not near
        session.encoder._next, session.count = (session.encoder.seq + 1000) % 65536, session.count + 1000
        running.run(20)
    assert running.stops == [] and running.pins == 6.0
    running.alive = False
    pins = pins_under(running, bursts)
    assert pins.index(0.0) < MOST and set(pins[pins.index(0.0) :]) == {0.0}
