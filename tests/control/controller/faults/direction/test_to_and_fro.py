"""Edges that lead nowhere under a voltage that turns any motor: one of two channels is lost."""

from math import inf

import pytest
from fault_bench import LIMIT, SLOT

from motor_control.controller.faults.direction import to_and_fro
from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.motion import Motion
from motor_model.sample import Sample

TWO = Config(slot=SLOT, two_channels=True)
MODEL = Config(slot=SLOT, two_channels=True, fastest=170.0, kv=LIMIT / 170.0, time_constant=0.03)
SAMPLE = 0.005  # [s]


def trembles(config: Config = TWO, share: float = 1.0, counts: tuple[int, ...] = (0, 1), every: int = 1) -> float:
    """When it is a fault [s] that edges are counted so, one in every so many samples, under a share of the voltage."""
    state, edge_time, count = to_and_fro.State(), 0, 0
    for k in range(400):
        if k % every == 0:
            edge_time, count = k * 5_000_000, counts[k // every % len(counts)]
        sample = Sample(k * 5_000_000, 0.0, share * LIMIT, count, edge_time)
        reason, state = to_and_fro.check(config, state, Seen(sample, 0.0, Motion(), 50.0, SAMPLE, LIMIT))
        if reason:
            assert f"to and fro under {share * LIMIT:.3g} V, for" in reason and "both channels" in reason
            return k * SAMPLE
    return inf


def test_edges_that_lead_nowhere_are_a_fault() -> None:
    assert trembles(MODEL) == pytest.approx(0.05, abs=0.011)
    assert trembles(TWO) == pytest.approx(0.125, abs=0.011)  # of a motor of which nothing is known
    assert trembles(MODEL, share=-1.0) == trembles(MODEL)
    assert trembles(MODEL, counts=(0, -1)) == trembles(MODEL, counts=(7, 7, 8)) == trembles(MODEL)
    assert trembles(MODEL, every=8) == pytest.approx(10 * 8 * SAMPLE, abs=0.011)


@pytest.mark.parametrize("counts", [(0, 1, 2), (0, 1, -1), tuple(range(400)), tuple(range(0, -400, -1))])
def test_a_motion_is_none_nor_a_shaft_that_swings_by_more_than_a_slot(counts: tuple[int, ...]) -> None:
    assert trembles(MODEL, counts=counts) == inf


@pytest.mark.parametrize(("share", "is_fault"), [(0.5, False), (0.54, False), (0.56, True), (-0.56, True)])
def test_less_voltage_than_friction_and_a_load_may_need_is_none(share: float, is_fault: bool) -> None:
    assert (trembles(MODEL, share=share) < inf) is is_fault


def test_a_shaft_that_trembles_at_rest_and_then_moves_is_none() -> None:
    """0.1 s on a flank from all the voltage on: a flywheel without a model, beside a machine that shakes it."""
    state = to_and_fro.State()
    for k in range(200):
        count = k % 2 if k < 20 else k - 19
        sample = Sample(k * 5_000_000, 0.0, LIMIT, count, k * 5_000_000)
        reason, state = to_and_fro.check(TWO, state, Seen(sample, 0.0, Motion(), 50.0, SAMPLE, LIMIT))
        assert reason == ""


@pytest.mark.parametrize(
    "config",
    [Config(slot=SLOT), Config(two_channels=True), Config(slot=SLOT, two_channels=True, stall_time=0.0)],
)
def test_one_channel_cannot_tell_nor_is_anything_judged_that_is_switched_off(config: Config) -> None:
    assert trembles(config) == inf


def test_a_voltage_that_turns_its_sign_turns_the_motor() -> None:
    state = to_and_fro.State()
    for k in range(400):
        voltage = LIMIT if k // 8 % 2 else -LIMIT
        sample = Sample(k * 5_000_000, 0.0, voltage, k % 2, k * 5_000_000)
        reason, state = to_and_fro.check(MODEL, state, Seen(sample, 0.0, Motion(), 50.0, SAMPLE, LIMIT))
        assert reason == ""
