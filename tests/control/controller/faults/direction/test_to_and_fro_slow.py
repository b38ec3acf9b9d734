"""Edges that lead nowhere under little voltage, of a motor with a model that has just moved along it."""

from dataclasses import replace
from math import inf, nan, tau

import pytest
from fault_bench import LIMIT

from motor_control.controller.faults.direction import to_and_fro
from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.motion import Motion
from motor_model.sample import Sample

SLOW = Config(slot=tau / 96, two_channels=True, fastest=6.0, kv=2.0, time_constant=0.03)
SAMPLE, EVERY, MOVED = 0.005, 20, 6  # [s]; samples from edge to edge; edges along the voltage before


def stops(
    share: float = 0.2,
    config: Config = SLOW,
    *,
    reference: float = 0.3,
    moved: int = MOVED,
    way: int = 1,
    motion: Motion = Motion(),  # noqa: B008
    every: int = EVERY,
    back: int = 0,
) -> int | None:
    """Count the edges that lead nowhere until it is a fault that they do, under a share of the voltage; None: never.

    moved, way: edges before, and their direction; back: edge from which the voltage is against the motion for a sample.
    """
    state = to_and_fro.State()
    for k in range(every * (moved + 80)):
        passed, rest = divmod(k, every)
        count = way * (min(passed, moved) - (passed - moved) % 2 * (passed > moved))
        dips = back and passed == moved + back and rest == 1
        voltage = (-1.0 if dips else 1.0) * (0.09 if passed <= moved else share) * LIMIT
        sample = Sample(round(k * SAMPLE * 1e9), 0.0, voltage, count, round(passed * every * SAMPLE * 1e9))
        reason, state = to_and_fro.check(config, state, Seen(sample, 0.0, motion, reference, SAMPLE, LIMIT))
        if reason:
            assert f"to and fro under {voltage:.3g} V, for" in reason and "both channels" in reason
            return passed - moved
    return None


def test_six_edges_that_lead_nowhere_are_a_fault_under_little_voltage() -> None:
    assert stops(0.2) == to_and_fro.FEW == 6


@pytest.mark.parametrize(("share", "edges"), [(0.15, 6), (0.14, 7), (0.075, 20), (0.049, None)])
def test_less_voltage_needs_more_of_them(share: float, edges: int | None) -> None:
    """Half of the voltage in all, beyond a random torque of 0.05 of it."""
    assert stops(share) == edges


@pytest.mark.parametrize(("share", "edges"), [(0.26, 6), (0.165, 35), (0.149, None)])
def test_the_load_of_the_motion_before_may_hold_the_motor(share: float, edges: int | None) -> None:
    """A tenth of the voltage, beside that random torque."""
    motion = Motion(slow_voltage=0.1 * LIMIT + SLOW.kv * 0.3, slow_speed=0.3)
    assert stops(share, motion=motion) == edges
    assert stops(0.149, replace(SLOW, friction=0.1 * LIMIT), motion=motion) == 6  # it was friction


def test_a_motor_that_has_not_moved_along_its_voltage_may_hang_in_the_balance() -> None:
    assert stops(0.5, moved=0) is None and stops(0.5, way=-1) is None
    assert stops(0.5, moved=2) == 6


@pytest.mark.parametrize("reference", [0.0, -0.3, nan])
def test_a_motion_has_to_be_asked_for(reference: float) -> None:
    assert stops(0.5, reference=reference) is None


def test_without_a_model_it_takes_more_voltage() -> None:
    assert stops(0.5, replace(SLOW, kv=0.0, fastest=inf)) is None
    assert stops(0.5, replace(SLOW, two_channels=False)) is None


def test_a_voltage_against_the_motion_begins_anew_and_does_not_forget_it() -> None:
    assert stops(0.2, back=4) == 4 + 6


@pytest.mark.parametrize(("lag", "edges"), [(0.03, 8), (0.3, 27)])
def test_a_motor_is_given_the_time_to_move_by_two_slots(lag: float, edges: int) -> None:
    """0.17 s and 0.54 s under a tenth of the voltage: sqrt(2·2·0.065·lag/(0.1·6)), half as long again."""
    assert stops(0.5, replace(SLOW, time_constant=lag), every=4) == edges
