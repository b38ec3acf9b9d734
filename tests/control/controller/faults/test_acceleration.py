"""A motor that gains speed as its model could not, which makes a loop with that model swing; and those that may."""

from dataclasses import replace

import pytest
from fault_bench import KNOWN, LIMIT, SLOT

from motor_control.configuration import config_of
from motor_control.controller import controller
from motor_control.controller.faults import acceleration
from motor_control.controller.faults.evidence import Seen
from motor_control.controller.motion import Motion
from motor_control.parameters import ROWS
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_model.sample import Sample
from motor_model.sensing.board import BoardConfig, SimulatedBoard

GAINS = {"kp": 0.2, "ki": 2.5, "speed_source": "observer", "feedforward": True}
FRICTION = ("coulomb_friction",)


def run_loop(factor: float, rate: float = 200.0, edges: int = 96) -> tuple[str, float, list[float]]:
    """Half of the top speed of a model, of a motor that is so many times as fast: what is said, when [s], speeds."""
    model = Parameters({"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.4}, FRICTION)
    motor = Parameters({"kv": PAPER_KV / factor, "ka": PAPER_KA / factor, "ks": 0.4}, FRICTION)
    board = SimulatedBoard(motor, BoardConfig(sample_rate=rate, edges_per_revolution=edges, seed=1))
    info = BoardConfig(sample_rate=rate, edges_per_revolution=edges).info(model)
    config = config_of({row.name: row.default for row in ROWS} | GAINS, info, model)  # type: ignore[arg-type]
    state, voltage, speeds = controller.State(), 0.0, []
    for k in range(round(0.7 * rate)):
        output, state = controller.update(config, state, board.sample(voltage), 87.0 if k == 20 else None, k / rate)
        voltage = output.terms.voltage
        speeds.append(board.speed)
        if state.latched:
            return state.latched, k / rate - 20.0 / rate, speeds
    return "", 0.0, speeds


@pytest.mark.parametrize(
    ("factor", "rate", "edges"), [(3.0, 200.0, 96), (5.0, 200.0, 96), (8.0, 1000.0, 96), (5.0, 200.0, 960)]
)
def test_a_model_of_a_slower_motor_is_told_before_the_loop_swings(factor: float, rate: float, edges: int) -> None:
    """For ever, with a model five times as slow from -147 to 222 rad/s where 87 were asked for."""
    said, when, speeds = run_loop(factor, rate, edges)
    assert "gains speed, to " in said and "as its model could not" in said
    assert 0.005 < when < 0.04 and min(speeds) >= 0.0 and max(speeds) < 160.0


@pytest.mark.parametrize("factor", [1.0, 1.5])
def test_a_model_that_is_off_is_let_be(factor: float) -> None:
    said, _, speeds = run_loop(factor)
    assert said == "" and abs(speeds[-1] - 87.0) < 9.0


def gain(speeds: list[float], voltage: float, period: float = 0.005, config=KNOWN) -> str:  # type: ignore[no-untyped-def]
    """Feed mean speeds [rad/s] under one voltage [V]; the first sentence."""
    state, angle, edge, count = acceleration.State(), 0.0, 1_000_000_000, 0
    for k, speed in enumerate(speeds):
        angle, now = angle + speed * period, 1_000_000_000 + round(k * period * 1e9)
        if angle // SLOT > count:
            count, edge = int(angle // SLOT), now - (round((angle % SLOT) / speed * 1e9) if speed else 0)
        sample = Sample(now, speed, voltage, count, edge)
        said, state = acceleration.check(config, state, Seen(sample, speed, Motion(), 87.0, period, LIMIT))
        if said:
            return said
    return ""


def test_no_more_than_voltage_and_load_and_friction_turned_into_help() -> None:
    top, ka = KNOWN.fastest, KNOWN.kv * KNOWN.time_constant
    most = 1.2 * 1.6 * LIMIT / ka  # [rad/s²] from rest
    assert gain([min(0.35 * most * 0.005 * k, top) for k in range(60)], LIMIT) == ""
    assert "to 1" in gain([min(2.5 * most * 0.005 * k, top) for k in range(60)], LIMIT)
    coasting = [150.0 if k % 2 else 140.0 for k in range(200)]  # an irregular disc
    assert gain(coasting, 0.0) == ""
    assert gain([min(2.5 * most * 0.005 * k, top) for k in range(60)], LIMIT, config=replace(KNOWN, kv=0.0)) == ""
    assert (
        gain([min(2.5 * most * 0.005 * k, top) for k in range(60)], LIMIT, config=replace(KNOWN, stall_time=0.0)) == ""
    )
