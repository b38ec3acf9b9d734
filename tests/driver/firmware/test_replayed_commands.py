"""Bytes that drove the motor are written to the port again, by somebody who has it open or by what repeats them."""

from driver_rig import Rig

MOST = 150.0  # [ms]


def recorded(rig: Rig) -> list[bytes]:
    """What drives the motor for 0.2 s."""
    bursts: list[bytes] = []
    send = rig._in.send
    rig._in.send = lambda data, faults, now: (bursts.append(data), send(data, faults, now))[1]  # type: ignore[method-assign]
    rig.run(200)
    rig._in.send = send  # type: ignore[method-assign]
    return [burst for burst in bursts if burst]


def pins_under(rig: Rig, bursts: list[bytes]) -> list[float]:
    """[V] at the pins, every millisecond; a burst comes again every 5 ms."""
    pins = []
    for k in range(5 * len(bursts)):
        if k % 5 == 0:
            rig._in.send(bursts[k // 5], rig.faults, rig.now)
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
