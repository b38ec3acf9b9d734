"""A little voltage for a moment: the breakaway, the pace, and that the motor stops again; by plain calls."""

from collections.abc import Callable
from dataclasses import dataclass

import pytest

from motor_driver.check.drive import OutputStaysOff, break_away, hold, stop_motor
from motor_driver.check.look import Act, Look, Steps
from motor_driver.check.settings import Settings

SETTINGS = Settings(max_voltage=12.0)


@dataclass
class Line:
    """A motor without inertia: its edge rate [1/s] follows from voltage and time."""

    rate: Callable[[float, float], float]
    time: float = 0.0
    angle: float = 0.5
    switches_on: bool = True

    def run(self, steps: "Steps[object]") -> tuple[object, list[Act]]:
        """What the steps return, and what they asked for."""
        act, acts, edge = next(steps), [], 0.0
        while True:
            before, rate = self.angle, self.rate(act.voltage, self.time)
            self.time, self.angle = self.time + 0.005, self.angle + 0.005 * rate
            if int(before) != int(self.angle):
                edge = self.time - (self.angle - round(self.angle - 0.5)) / rate if rate else edge
            acts.append(act)
            try:
                act = steps.send(Look(self.time, int(self.angle), edge, act.voltage, act.on and self.switches_on))
            except StopIteration as end:
                return end.value, acts


def free(voltage: float, _: float) -> float:
    """100 edges a second for every volt over 1.5 V."""
    over = max(abs(voltage) - 1.5, 0.0)
    return 100.0 * over * (1.0 if voltage > 0.0 else -1.0)


@pytest.mark.parametrize("way", [1, -1])
def test_the_breakaway_is_where_edges_begin(way: int) -> None:
    found, acts = Line(free).run(break_away(SETTINGS, way))
    assert 1.5 < found.voltage < 1.8 and found.count * way >= 3 and not found.to_and_fro
    assert max(abs(act.voltage) for act in acts) < 1.8


def test_without_an_edge_it_ends_at_half_of_the_voltage_within_five_seconds() -> None:
    line = Line(lambda *_: 0.0)
    found, acts = line.run(break_away(SETTINGS, 1))
    assert found.voltage is None and acts[-1].voltage == pytest.approx(6.0) and 4.5 < line.time < 5.0


def test_a_shaft_that_only_gives_in_its_gears_has_not_moved() -> None:
    gives = Line(lambda u, t: 40.0 if 0.7 < t < 0.73 else free(u, t))  # one edge at 1 V
    found, _ = gives.run(break_away(SETTINGS, 1))
    assert 1.5 < found.voltage < 1.8


def test_edges_that_come_slowly_are_motion_all_the_same() -> None:
    found, acts = Line(lambda u, _: 2.0 * max(abs(u) - 1.5, 0.0)).run(break_away(SETTINGS, 1))
    assert 1.5 < found.voltage < 3.5 and max(abs(act.voltage) for act in acts) < 5.0


def test_a_board_that_does_not_switch_on_is_said() -> None:
    with pytest.raises(OutputStaysOff):
        Line(free, switches_on=False).run(break_away(SETTINGS, 1))


def test_a_steady_pace_ends_early_and_a_rising_one_at_two_seconds() -> None:
    line = Line(free)
    pace, _ = line.run(hold(-4.0))
    assert pace.rate == pytest.approx(-250.0, rel=0.01) and pace.steady and line.time < 0.8
    line = Line(lambda _, t: 100.0 * t)
    pace, _ = line.run(hold(4.0))
    assert not pace.steady and 2.0 < line.time < 2.1 and 120.0 < pace.rate < 200.0


def test_few_edges_are_a_pace_that_is_not_certain() -> None:
    pace, _ = Line(lambda *_: 4.0).run(hold(4.0))
    assert pace.rate == pytest.approx(4.0, rel=0.05) and not pace.steady and 2 <= pace.edges <= 6


def test_a_motor_that_stops_has_stopped_and_one_that_does_not_has_its_rate() -> None:
    slows = Line(lambda _, t: max(300.0 - 300.0 * t, 0.0))
    assert slows.run(stop_motor())[0] == 0.0 and 1.2 < slows.time < 1.5
    assert Line(lambda *_: 300.0).run(stop_motor())[0] == pytest.approx(300.0, rel=0.05)
    coasts = Line(lambda _, t: 300.0 * 0.7**t)
    assert coasts.run(stop_motor())[0] == 0.0 and coasts.time > 5.0
