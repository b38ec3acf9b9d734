"""The same motor at another voltage and another speed behaves the same: nothing is scaled in volts or rad/s."""

from functools import cache

import numpy as np
import pytest
from bench_board import DEFAULTS
from tiers import keep_fast

from motor_control.configuration import config_of
from motor_control.tuning.simulated_loop import Rehearsal, rehearse
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_model.sensing.board import BoardConfig

PROFILE = (0.57, -0.57, 0.0, 0.02, -0.02)  # of the top speed


@cache
def run(volts: float, edges: int, source: str, single: bool) -> Rehearsal:
    """The paper's motor with friction, scaled to a voltage and to so many edges a turn; in shares of its top speed."""
    speed, voltage = 96 / edges, volts / 12.0
    kv, ka = PAPER_KV * voltage / speed, PAPER_KA * voltage / speed
    values = {
        "kv": kv,
        "ka": ka,
        "ks": 0.4 * voltage,
        "breakaway_voltage": 0.9 * voltage,
        "stribeck_speed": 4.0 * speed,
    }
    plant = Parameters(values, ("static_friction",), max_voltage=volts)
    board = BoardConfig(
        edges_per_revolution=edges, single_channel=single, start_angle=0.01 * speed, edge_resolution=0.0
    )
    observed = source == "observer"
    loop = {"kp": ka / 0.02, "ki": kv / 0.02, "voltage_limit": volts, "speed_source": source, "feedforward": observed}
    config = config_of({**DEFAULTS, **loop}, board.info(plant), plant if observed else None)  # type: ignore[dict-item]
    top = 174.1 * speed
    result = rehearse(plant, board, config, lambda t: PROFILE[min(int(t / 0.6), 4)] * top, 3.0)
    return Rehearsal(result.time, result.speed / top, result.used / top, result.voltage / volts)


@pytest.mark.parametrize(
    ("volts", "edges"),
    keep_fast([(1.2, 96), (48.0, 96), (12.0, 2784), (12.0, 32), (1.2, 2784), (0.24, 96)], (48.0, 96), (1.2, 2784)),
)
@pytest.mark.parametrize("source", ["observer", "measured"])
@pytest.mark.parametrize("single", [True, False])
def test_a_scaled_motor_behaves_the_same(volts: float, edges: int, source: str, single: bool) -> None:
    """Top speeds of 6 to 522 rad/s, 0.24 to 48 V."""
    scaled, same = run(volts, edges, source, single), run(12.0, 96, source, single)
    assert same.speed[100] == pytest.approx(0.57, rel=0.02) and abs(np.mean(same.speed[-60:]) + 0.02) < 0.005
    assert np.max(np.abs(scaled.speed - same.speed)) < 2e-3
    assert np.max(np.abs(scaled.voltage - same.voltage)) < 0.05
