"""Edges at angles where the model's motor is not."""

from dataclasses import replace
from math import nan, tau

import numpy as np
import pytest

from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.faults.unexpected_edges import State, check, follow_innovation, longest_period
from motor_control.controller.motion import Motion
from motor_model.sample import Sample

SLOT = tau / 96
MOTOR = Config(slot=SLOT, fastest=6.0, time_constant=0.08, kv=2.0)


def needed_edges(
    config: Config, innovations: np.ndarray, voltage: float = 6.0, period: float = 0.05, undriven: int = 0
) -> int | None:
    """How many edges it takes until the motor is stopped; innovations in slots; the first some are not driven."""
    state = State(direction=1)
    for k, innovation in enumerate(innovations):
        driven = voltage if k >= undriven else 0.0
        sample = Sample(0, 3.0, driven, k, edge_period=period)
        seen = Seen(sample, 3.0, Motion(edges=1, slow_voltage=driven), 3.0, 0.005, 12.0, innovation * SLOT)
        reason, state = check(config, state, seen)
        if reason:
            return k + 1
    return None


def test_a_sum_of_unexpected_edges_from_both_sides() -> None:
    """Three quarters of a slot, to and fro: half a slot more than ordinary each."""
    to_and_fro = 0.75 * (-1.0) ** np.arange(30)
    assert needed_edges(MOTOR, to_and_fro[:3]) is None and needed_edges(MOTOR, to_and_fro) == 4


def test_a_motors_edges_are_expected() -> None:
    rng = np.random.default_rng(2)
    assert needed_edges(MOTOR, 0.05 * rng.standard_normal(20_000)) is None  # slots
    assert needed_edges(MOTOR, np.tile(0.24 * np.array([1.0, -1.0]), 500)) is None  # a ripple that the model lacks
    load = np.tile(np.r_[-0.94 * 0.93 ** np.arange(30), np.zeros(30)], 20)  # it comes, and is taken up, edge by edge
    assert needed_edges(MOTOR, load) is None


@pytest.mark.parametrize(("top", "longest"), [(6.0, 0.0661), (30.0, 0.0295), (20_000.0, 0.001145)])
def test_over_a_long_period_a_little_torque_moves_a_fast_motor_anywhere(top: float, longest: float) -> None:
    """It dithers about a standstill: 10 edges a second, of the 300,000 at its top speed."""
    config, to_and_fro = replace(MOTOR, fastest=top), 0.75 * (-1.0) ** np.arange(30)
    assert longest_period(config) == pytest.approx(longest, rel=0.01)
    assert needed_edges(config, to_and_fro, period=0.99 * longest) == 4
    assert needed_edges(config, to_and_fro, period=1.01 * longest) is None


def test_noise_is_told_after_some_ten_edges() -> None:
    rng = np.random.default_rng(3)
    counts = [needed_edges(MOTOR, rng.uniform(-1.0, 1.0, 400)) or 400 for _ in range(200)]
    assert 12 <= np.median(counts) <= 20


def test_flanks_of_a_sensor_are_uneven_and_a_motors() -> None:
    """Four a period at 0, 10, 44 and 54 % of it: every gearmotor would have been stopped."""
    uneven = np.tile([0.48, -0.12, 0.24, -0.6], 500)
    assert needed_edges(replace(MOTOR, even=False), uneven) is None
    assert needed_edges(MOTOR, uneven) is not None


def test_the_slots_of_a_disc_with_few_are_irregular_turn_by_turn() -> None:
    """Four slots, irregular by 5 %, and a torque at random: seed 950289 of `no_false_stops`, at its top speed."""
    few, rng = replace(MOTOR, few_slots=4), np.random.default_rng(4)
    slots = np.tile([-0.2, 0.4, -0.25, 0.5], 500) + 0.05 * rng.standard_normal(2000)
    assert needed_edges(few, slots) is None and needed_edges(MOTOR, slots) is not None
    assert needed_edges(replace(MOTOR, few_slots=3), slots) is not None
    counts = [needed_edges(few, rng.uniform(-1.0, 1.0, 400)) or 400 for _ in range(200)]
    assert 14 <= np.median(counts) <= 32  # noise is noise on any disc


@pytest.mark.parametrize(("voltage", "period"), [(0.0, 0.05), (6.0, 0.0)], ids=["not driven", "no period"])
def test_a_shaft_turned_by_hand_and_an_edge_without_a_period_prove_nothing(voltage: float, period: float) -> None:
    assert needed_edges(MOTOR, 0.9 * (-1.0) ** np.arange(100), voltage, period) is None


def test_what_was_shaken_is_not_held_against_what_is_driven_later() -> None:
    """Seed 97007 of random torques: its first driven edge stopped it."""
    assert needed_edges(MOTOR, 0.75 * (-1.0) ** np.arange(30), undriven=10) == 14


def test_without_an_observer_and_after_a_turn_or_a_standstill_nothing_is_known() -> None:
    assert needed_edges(MOTOR, np.full(100, nan)) is None
    state = State(excess=1.0, innovation=0.5, direction=1)
    turned = follow_innovation(state, -0.9, -3.0)
    assert turned.excess == 1.0 and turned.direction == -1 and turned.innovation == -0.9
    assert follow_innovation(state, -0.9, 3.0).excess == pytest.approx(1.65)
    stood = follow_innovation(replace(state, direction=0), -0.9, 3.0)  # seed 97007 of random torques, one channel
    assert stood.excess == 1.0 and follow_innovation(state, -0.9, 0.0).excess == 1.0
