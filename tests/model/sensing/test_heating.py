"""A motor without an edge is stopped by the mean square of its voltage; one that turns within a slot is not."""

from dataclasses import replace

import numpy as np
import pytest
from motion_samples import sample

from motor_model.excitation import PROFILES
from motor_model.parameters import Parameters
from motor_model.sensing.board import BoardConfig, SimulatedBoard
from motor_model.sensing.motion_check import MotionCheck


@pytest.mark.parametrize("name", ["chirp", "reversals"])
@pytest.mark.parametrize(("top", "lag", "edges"), [(6.0, 0.15, 8), (6.0, 0.3, 8), (6.0, 0.3, 20), (30.0, 0.5, 8)])
def test_a_healthy_motor_may_turn_to_and_fro_within_a_slot(name: str, top: float, lag: float, edges: int) -> None:
    """The project's own profiles stopped a slow motor with a coarse disc; a shaft that is blocked then is a fault."""
    kv = 12.0 / top
    plant = Parameters({"kv": kv, "ka": kv * lag, "ks": 0.4}, ("coulomb_friction",))
    board = SimulatedBoard(plant, BoardConfig(edges_per_revolution=edges, single_channel=True))
    check, shape = MotionCheck(12.0, True), PROFILES[name]
    for volts in shape.voltage(np.arange(0.0, shape.duration, 0.005), 12.0):
        check = check.see(last := board.sample(float(volts)))
        assert check.stop == ""
    for k in range(1, 1000):
        blocked = replace(last, sample_time=last.sample_time + 5_000_000 * k, speed=0.0, voltage=12.0 * (-1.0) ** k)
        check = check.see(blocked)
        if check.stop:
            break
    assert 0.0 < 0.005 * k < 2.0


@pytest.mark.parametrize(
    ("volts", "low", "high"),
    [
        ([12.0, -12.0], 0.4, 0.55),
        ([12.0, 0.0], 1.0, 1.2),
        ([7.2] * 20 + [-7.2] * 20, 1.8, 2.0),
        ([12.0] * 60 + [0.0] * 20, 0.4, 0.7),
        ([8.4, 0.0], np.inf, np.inf),  # 0.495 of 12 V in the mean square
        ([5.9, -5.9], np.inf, np.inf),
    ],
)
def test_a_voltage_that_comes_and_goes_heats_a_motor_as_one_that_stays(
    volts: list[float], low: float, high: float
) -> None:
    """It was never strong for the stall time, and never stopped."""
    check, stopped = MotionCheck(12.0, False), np.inf
    for k in range(4000):
        check = check.see(sample(0.005 * k, 7, 0.0, volts[k % len(volts)]))
        if check.stop:
            stopped = 0.005 * k
            break
    assert low <= stopped <= high
    if stopped < np.inf:
        assert check.stop.startswith("no edges, and 6.") and " V in the mean square for 1.6 s: " in check.stop
    moving = MotionCheck(12.0, True)
    for k in range(4000):
        moving = moving.see(sample(0.005 * k, k // 50, 0.0, volts[k % len(volts)]))  # four edges a second
        assert moving.heating.heat < 0.4
    never = MotionCheck(12.0, True, stall_time=0.0)
    for k in range(1000):
        never = never.see(sample(0.005 * k, 7, 0.0, 12.0 if k % 2 else -12.0))
        assert never.stop == ""
