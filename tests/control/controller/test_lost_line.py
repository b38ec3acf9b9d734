"""An encoder line that is lost, quiet or noisy: the motor stops in time, and does not go to full speed on the way."""

from math import tau

import pytest
from bench_board import motor
from lost_line import lose_line
from tiers import keep_fast

from motor_control.controller import controller


@pytest.mark.parametrize("rate", keep_fast([200.0, 1000.0], 200.0))
@pytest.mark.parametrize("strays", [0.0, 2.0, 5.0, 50.0, 100.0])
@pytest.mark.parametrize(("source", "known"), [("measured", False), ("measured", True), ("observer", True)])
def test_a_line_lost_at_100_rad_per_s(source: str, known: bool, strays: float, rate: float) -> None:
    """It was full voltage for ever wherever an edge came now and then."""
    loss = lose_line(motor(), 100.0, strays, rate=rate, source=source, model=motor() if known else None)
    assert loss.stopped is not None and 0.01 < loss.stopped < 0.5
    assert loss.reason.startswith("Edges do not fit") and "motor/reset" in loss.reason


@pytest.mark.parametrize("known", [False, True])
@pytest.mark.parametrize(("edges", "hum", "reference"), [(8, 50.0, 60.0), (8, 50.0, 75.0), (16, 100.0, 60.0)])
def test_hum_on_a_coarse_disc_stops_the_motor(edges: int, hum: float, reference: float, known: bool) -> None:
    """It was the top speed for ever: all the voltage was there before the speed's average had settled."""
    model = motor() if known else None
    loss = lose_line(motor(), reference, hum, edges=edges, model=model, lost=1.0, hum=True, duration=6.0)
    assert loss.stopped is not None and 0.2 < loss.stopped < 4.0 and loss.fastest > 100.0
    assert lose_line(motor(), reference, hum, edges=edges, model=model, lost=9.0, duration=5.0).stopped is None


@pytest.mark.parametrize("known", [False, True])
@pytest.mark.parametrize(
    ("edges", "hum", "share"), [(8, 100.0, 0.75), (8, 100.0, 0.9), (5, 60.0, 0.75), (10, 120.0, 0.9)]
)
def test_hum_of_the_mains_near_what_is_wanted_stops_the_motor(
    edges: int, hum: float, share: float, known: bool
) -> None:
    """At half of the top speed it was the top speed for ever: a heavy load shows as much but for the rhythm."""
    reference, model = hum * tau / edges / share, motor() if known else None
    assert 80.0 < reference < 105.0
    loss = lose_line(motor(), reference, hum, edges=edges, model=model, lost=1.0, hum=True, duration=4.0)
    assert loss.stopped is not None and 0.2 < loss.stopped < 0.9 and "hums with" in loss.reason
    assert lose_line(motor(), share * reference, hum, edges=edges, model=model, lost=9.0, duration=4.0).stopped is None


@pytest.mark.parametrize("known", [False, True])
def test_hum_that_was_there_before_moves_no_motor(known: bool) -> None:
    loss = lose_line(motor(), 60.0, 50.0, edges=8, model=motor() if known else None, lost=0.0, hum=True, asked=0.9)
    assert loss.stopped == 0.9 and loss.fastest == 0.0 and "at 0 V" in loss.reason


@pytest.mark.parametrize(("source", "known"), [("measured", False), ("measured", True), ("observer", True)])
def test_a_line_lost_at_3_rad_per_s_does_not_take_the_motor_to_full_speed(source: str, known: bool) -> None:
    """It was 168 rad/s for 1.3 to 1.9 s."""
    loss = lose_line(motor(), 3.0, 0.0, source=source, model=motor() if known else None)
    assert loss.stopped is not None and loss.stopped < 0.6 and 20.0 < loss.fastest < 75.0


def test_without_an_integral_too() -> None:
    """The gain alone asks for half the voltage, which was never a stall; known by the model."""
    loss = lose_line(motor(), 3.0, 0.0, model=motor(), kp=2.0, ki=0.0)
    assert loss.stopped is not None and loss.stopped < 0.5


@pytest.mark.parametrize("volts", [1.2, 12.0, 48.0])
@pytest.mark.parametrize(("top", "edges"), [(6.0, 2400), (30.0, 480), (174.0, 96), (600.0, 24)])
def test_whatever_the_top_speed_and_the_voltage(top: float, edges: int, volts: float) -> None:
    kv = volts / top
    plant = motor(kv=kv, ka=0.08 * kv, ks=0.03 * volts, breakaway_voltage=0.06 * volts, stribeck_speed=0.02 * top)
    gains = {"kp": 4.0 * kv, "ki": 50.0 * kv, "voltage_limit": volts}
    plant = type(plant)(plant.values, plant.effects, max_voltage=volts)
    for known in (False, True):
        loss = lose_line(plant, 0.57 * top, 5.0, model=plant if known else None, edges=edges, **gains)
        assert loss.stopped is not None and loss.stopped < 0.5


def test_a_line_that_holds_is_no_fault() -> None:
    for source in ("measured", "observer"):
        loss = lose_line(motor(), 100.0, 0.0, source=source, lost=9.0)
        assert loss.stopped is None and controller.STOPPED not in loss.reason


@pytest.mark.parametrize(("reference", "strays"), [(0.0, 5.0), (0.0, 20.0), (0.0, 50.0), (1e-3, 20.0), (-1e-6, 20.0)])
def test_a_line_lost_at_rest_turns_nothing(reference: float, strays: float) -> None:
    """The observer drove against the motion that it took every stray edge for: up to 60 % of the top speed for ever."""
    loss = lose_line(motor(), reference, strays, source="observer", model=motor())
    assert loss.stopped is None and loss.fastest == 0.0


def test_with_two_channels_it_turns_the_motor_by_half_the_voltage_at_most() -> None:
    """A load may be larger than friction there; it was 78 to 96 % of the top speed, for seconds or for ever."""
    loss = lose_line(motor(), 0.0, 20.0, source="observer", model=motor(), single_channel=False)
    assert loss.stopped is not None and loss.stopped < 2.0 and 5.0 < loss.fastest < 0.5 * 174.0
