"""Whoever goes on after every stop gets the motor later and later, and after a minute of peace at once."""

import pytest

from motor_model.sensing.repeated_stops import FORGET, LONGEST, RepeatedStops

FAULT = 0.4  # [s] that a fault takes to be known


def goes_on_at_once(seconds: float, until: float = float("inf")) -> list[tuple[float, float]]:
    """Begin and end of every motion that a supervisor without patience gets."""
    stops, now, motions = RepeatedStops(), 0.0, []
    while now < seconds:
        if stops.refuse(now):
            now += 0.01
            continue
        motions.append((now, now + FAULT))
        now += FAULT
        stops = stops.stop(now)
    return motions


def test_the_first_stop_may_be_ended_at_once_and_the_others_later_and_later() -> None:
    motions = goes_on_at_once(200.0)
    rests = [begin - end for (_, end), (begin, _) in zip(motions, motions[1:], strict=False)]
    assert rests[0] == 0.0
    assert rests[1:7] == [pytest.approx(rest, abs=0.02) for rest in (1.0, 2.0, 4.0, 8.0, 16.0, 32.0)]
    assert rests[7:] and rests[7:] == [pytest.approx(LONGEST, abs=0.02)] * len(rests[7:])


def test_a_supervisor_without_patience_gets_the_motor_for_an_eightieth_of_the_time() -> None:
    motions = goes_on_at_once(3600.0)
    late = [end - begin for begin, end in motions if begin > 100.0]
    assert 0.01 < sum(late) / 3500.0 < 0.0125
    assert len([begin for begin, _ in motions if begin < 60.0]) == 7


@pytest.mark.parametrize(("peace", "refused"), [(FORGET - 1.0, True), (FORGET + 1.0, False)])
def test_a_minute_without_a_stop_forgets(peace: float, refused: bool) -> None:
    stops = RepeatedStops().stop(10.0).stop(11.0).stop(13.0)
    assert bool(stops.stop(13.0 + peace).refuse(14.0 + peace)) == refused


def test_what_is_said() -> None:
    stops = RepeatedStops()
    assert stops.refuse(0.0) == "" and stops.announce("motor/reset") == ""
    stops = stops.stop(100.0)
    assert stops.refuse(100.0) == "" and stops.announce("motor/reset") == ""
    stops = stops.stop(101.0).stop(103.0)
    assert stops.announce("motor/reset") == (
        "It is stop number 3, each within a minute of the one before: motor/reset is refused for 2 s after it."
    )
    assert stops.refuse(103.2) == (
        "It has stopped 3 times, each within a minute of the one before: see to the cause, and wait 2 s."
    )
    assert "wait 1 s." in stops.refuse(104.9) and stops.refuse(105.1) == ""
