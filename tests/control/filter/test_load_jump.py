"""The test for a jump of the load: found with its size where there is one, quiet where there is none."""

import numpy as np
import pytest
from filter_bench import KA, KV, NOISE, SLOT, held, state, vector

from motor_control.filter.edge_update import update_at_edge
from motor_control.filter.load_jump import (
    LONGEST,
    UNEARNED,
    add_onsets,
    detect_jump,
    estimate_jump,
    no_jumps,
    predict_jumps,
    track_level,
)
from motor_control.filter.prediction import find_acting_voltage, predict_state


def run(load: float, seed: int, edges: int = 10) -> tuple[float, bool]:
    """Edges of a motor at 20 rad/s whose load jumps at the fourth: the load found at the end, and whether at once."""
    p, rng = vector(), np.random.default_rng(seed)
    u = 20.0 * p[0]
    x, jumps, found = state(20.0), no_jumps(), False
    speed, at = 20.0, 0.0
    for k in range(edges):
        acceleration = -(load + KV * (speed - 20.0)) / KA if k >= 3 and load else 0.0
        travel = SLOT + NOISE.flank * rng.standard_normal() - at
        dt = travel / (0.5 * (speed + np.sqrt(speed**2 + 2 * acceleration * travel)))
        at, speed = travel + at - SLOT, speed + acceleration * dt
        commands = held(u)
        jumps = predict_jumps(p, jumps, find_acting_voltage(p, commands, dt), x.estimate.motor.speed, dt)
        x = predict_state(p, NOISE, x, commands, 0.0, dt)
        after = update_at_edge(p, NOISE, x, jumps, u, 1.0, False)
        found |= k >= 3 and after.state.estimate.load - x.estimate.load > 0.1
        x, jumps = after.state, after.jumps
    return x.estimate.load, found


def test_a_jump_is_found_with_its_size() -> None:
    loads, found = zip(*(run(0.6, seed) for seed in range(8)), strict=True)
    assert np.mean(loads) == pytest.approx(0.6, abs=0.12) and sum(found) >= 6


def test_without_a_jump_the_load_stays() -> None:
    loads, found = zip(*(run(0.0, seed, 40) for seed in range(8)), strict=True)
    assert np.max(np.abs(loads)) < 0.1 and sum(found) == 0


def test_a_signature_is_what_a_volt_does() -> None:
    p, dt = vector(), 0.004
    jumps = add_onsets(p, no_jumps(), 0.002)
    assert jumps["load"][:2].tolist() == [1.0, 1.0] and jumps["speed"][0] == pytest.approx(-0.0005 / KA)
    later = predict_jumps(p, jumps, 3.0, 40.0, dt)
    assert np.all(later["speed"][:2] < jumps["speed"][:2] - 0.6 * dt / KA)
    assert jumps["speed"][0] == pytest.approx(-0.0005 / KA)  # what was given is as it was
    assert predict_jumps(p, jumps, 3.0, 40.0, 0.0) is jumps or np.array_equal(
        predict_jumps(p, jumps, 3.0, 40.0, 0.0), jumps
    )


def test_an_estimate_shrinks_toward_none_where_little_is_known() -> None:
    little, much = estimate_jump(0.5, 1.0, 0.001, 0.5), estimate_jump(500.0, 1000.0, 0.001, 0.5)
    assert little.mean < 0.15 and much.mean == pytest.approx(0.498, abs=0.002)
    assert little.log_odds < 0.0 < much.log_odds


@pytest.mark.parametrize(("since", "kept"), [(0.9 * LONGEST, True), (1.1 * LONGEST, False)])
def test_slots_that_take_long_are_not_tested(since: float, kept: bool) -> None:
    test = detect_jump(vector(), state(8.0, SLOT, since=since), no_jumps(), 1e-5, 1e-6, True)
    assert not test.found and bool(np.any(test.jumps["span"] > 0.0)) == kept


def test_the_level_is_earned() -> None:
    assert track_level(1.0, 10.0, True) == pytest.approx(1.24)  # a large score counts for nine
    assert track_level(1.0, 0.0, False) == UNEARNED
