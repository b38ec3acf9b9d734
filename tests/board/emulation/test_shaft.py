"""The motor on the pins: its plan is that of the model, cut back where the voltage changes."""

from math import tau

import numpy as np
import pytest

from motor_board.emulation.chip import FREQUENCY
from motor_board.emulation.edges import Line
from motor_board.emulation.shaft import EncoderConfig, Shaft
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters, paper_motor
from motor_model.simulate import simulate

SECOND = int(FREQUENCY)


def test_it_turns_as_the_model_does_and_counts_every_slot() -> None:
    shaft = Shaft(paper_motor(), EncoderConfig(seed=3))
    shaft.drive(0, 0.5)
    edges = shaft.plan(SECOND)
    shaft.drive(SECOND, 0.5)
    truth = simulate(paper_motor(), np.zeros(1), np.array([6.0]), np.array([0.0, 1.0]))
    assert (shaft.angle, shaft.speed) == pytest.approx((truth.angle[-1], truth.speed[-1]), rel=1e-9)
    assert shaft.voltage == 6.0 and shaft.planned == SECOND
    assert abs(len(edges.cycle) - truth.angle[-1] / tau * 96) <= 1.0
    assert np.all(np.diff(edges.cycle.astype(np.int64)) > 0) and edges.cycle[-1] <= SECOND


def test_what_was_planned_beyond_a_change_of_the_voltage_is_void() -> None:
    shaft = Shaft(paper_motor(), EncoderConfig(seed=3))
    shaft.drive(0, 1.0)
    shaft.plan(SECOND)
    shaft.drive(SECOND // 2, 0.0)  # half-way
    assert shaft.planned == SECOND // 2
    shaft.plan(SECOND)
    shaft.drive(SECOND, 0.0)
    times, volts = np.array([0.0, 0.5]), np.array([12.0, 0.0])
    truth = simulate(paper_motor(), times, volts, np.array([0.0, 0.5, 1.0]))
    assert (shaft.angle, shaft.speed) == pytest.approx((truth.angle[-1], truth.speed[-1]), rel=1e-9)


def test_a_delay_is_the_models() -> None:
    motor = Parameters({"kv": PAPER_KV, "ka": PAPER_KA, "delay": 0.1}, ("transport_delay",))
    shaft = Shaft(motor, EncoderConfig(seed=3))
    shaft.drive(0, 1.0)
    edges = shaft.plan(SECOND)
    assert edges.cycle[0] > 0.1 * SECOND
    shaft.drive(SECOND, 1.0)
    truth = simulate(motor, np.zeros(1), np.array([12.0]), np.array([0.0, 1.0]))
    assert shaft.angle == pytest.approx(truth.angle[-1], rel=1e-9)


def test_missed_edges_are_as_many_as_asked_for() -> None:
    motor = Parameters({"kv": PAPER_KV, "ka": PAPER_KA, "miss_rate": 0.1}, ("missed_edges",))
    counts = []
    for one in (paper_motor(), motor):
        shaft = Shaft(one, EncoderConfig(seed=3))
        shaft.drive(0, 1.0)
        counts.append(sum(len(shaft.plan(k * SECOND // 4).cycle) for k in range(1, 9)))
    assert counts[0] > 4000 and 0.08 < 1.0 - counts[1] / counts[0] < 0.12


@pytest.mark.parametrize("share", [1.0, -1.0])
def test_the_second_channel_is_a_quarter_of_a_slot_behind_or_ahead(share: float) -> None:
    shaft = Shaft(paper_motor(), EncoderConfig(seed=3, channels=2))
    shaft.drive(0, share)
    what = shaft.plan(SECOND // 4).what
    rising = what[(what & Line.A_FALLS) == 0]
    assert len(rising) > 100 and {bool(line & Line.B_HIGH) for line in rising} == {share < 0.0}
