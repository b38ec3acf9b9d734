"""An angle is reached within one slot, at 0 V, without hunting: friction, backlash, coarse discs and fine ones."""

from dataclasses import replace
from math import tau

import numpy as np
import pytest
from bench_board import motor, settings

from motor_control.controller import controller
from motor_control.controller.output import Output
from motor_control.controller.reference import position_law
from motor_control.controller.reference.demand import Kind
from motor_model.parameters import Parameters
from motor_model.sensing.board import BoardConfig, SimulatedBoard

FREE = Parameters({"kv": motor().value("kv"), "ka": motor().value("ka")})
ANGLES = (20.0, 20.3, -5.0, 0.0)  # [rad]
LAW = position_law.Config(slot=0.1, gain=10.0, deceleration=100.0, fastest=50.0)


def drive(
    plant: Parameters, edges: int, angles: tuple[float, ...], **changes: object
) -> list[tuple[int, float, Output]]:
    """For each angle: the slots it is off after 2 s, the time [s] of the last voltage, the last output."""
    board = BoardConfig(edges_per_revolution=edges, single_channel=False, slot_irregularity=0.01, seed=edges)
    config = settings(changes.pop("model", plant), board.info(plant), 0.02, **changes)  # type: ignore[arg-type]
    simulated, state, voltage, k, found = SimulatedBoard(plant, board), controller.State(), 0.0, 0, []
    for angle in angles:
        state = controller.refer(state, angle, k / 200.0, Kind.POSITION)
        voltages = []
        for _ in range(400):
            sample = simulated.sample(voltage)
            output, state = controller.update(config, state, sample, None, k / 200.0)
            voltage, k = output.terms.voltage, k + 1
            voltages.append(voltage)
        last = int(np.flatnonzero(np.array([1.0, *voltages]))[-1]) / 200.0
        found.append((round(angle * edges / tau) - sample.edge_count, last, output))
    return found


@pytest.mark.parametrize("edges", [96, 374, 2880])
def test_every_angle_is_reached_and_rested_at(edges: int) -> None:
    for off, last, output in drive(motor(), edges, ANGLES):
        assert off == 0 and 0.1 < last < 0.75
        assert output.terms.voltage == 0.0 and output.state == "running" and not output.reason


@pytest.mark.parametrize(
    "plant",
    [
        motor(ks=0.6, breakaway_voltage=1.3),
        motor(ks=0.2, breakaway_voltage=0.4),
        motor(("backlash",), backlash_angle=0.1, load_fraction=0.5),
        motor(("load_bias",), bias_voltage=0.7),
        FREE,
    ],
    ids=["more friction", "less friction", "backlash", "a load that friction holds", "no friction"],
)
def test_a_motor_that_is_not_the_model_comes_within_a_slot_too(plant: Parameters) -> None:
    for off, last, output in drive(plant, 96, ANGLES, model=motor()):
        assert abs(off) <= 1 and last < 1.5 and output.terms.voltage == 0.0


def test_a_load_that_friction_does_not_hold_is_given_up_and_said() -> None:
    """1.2 V of load, 0.9 V of breakaway: pushed out again and again; at the end 0 V, and why."""
    plant = motor(("load_bias",), bias_voltage=1.2)
    _, last, output = drive(plant, 96, (20.0,) * 5, model=motor())[-1]
    assert output.terms.voltage == 0.0 and "friction does not hold the load" in output.reason and output.warning


@pytest.mark.parametrize(
    ("single", "source", "words"),
    [(True, "observer", "does not measure the direction"), (False, "measured", "without the observer")],
)
def test_an_angle_that_cannot_be_had_is_refused_with_a_sentence(single: bool, source: str, words: str) -> None:
    board = BoardConfig(single_channel=single)
    config = settings(motor(), board.info(motor()), speed_source=source)
    state = controller.refer(controller.State(), 1.0, 0.0, Kind.POSITION)
    output, _ = controller.update(config, state, SimulatedBoard(motor(), board).sample(0.0), None, 0.0)
    assert output.terms.voltage == 0.0 and output.state == "stopped" and words in output.reason


@pytest.mark.parametrize(("angle", "runs"), [(1.3e8, True), (1.5e8, False), (-1e308, False)])
def test_an_angle_beyond_all_motion_is_refused(angle: float, runs: bool) -> None:
    """2^31 slots of 96 a turn are 1.4e8 rad; 1e308 rad ended the node with an OverflowError."""
    board = BoardConfig(single_channel=False)
    config = settings(motor(), board.info(motor()), speed_source="observer")
    state = controller.refer(controller.State(), angle, 0.0, Kind.POSITION)
    output, _ = controller.update(config, state, SimulatedBoard(motor(), board).sample(0.0), None, 0.0)
    assert (output.state == "running") == runs
    assert runs or (output.terms.voltage == 0.0 and "farther than any motor turns" in output.reason)


def test_the_approach_slows_down_and_is_never_too_slow_for_friction() -> None:
    state = position_law.begin(LAW, 100.0)
    aims = [position_law.approach(LAW, state, 100.0, count, False)[0].speed for count in range(1001)]
    assert aims[0] == 50.0 and aims[-1] == 0.0 and aims[:-1] == sorted(aims[:-1], reverse=True)
    slowest = position_law.SLOTS_PER_SECOND * LAW.slot
    assert min(aims[:-1]) == slowest and aims[960] == pytest.approx((2.0 * 100.0 * 4.0) ** 0.5, rel=1e-9)


def test_it_rests_within_a_slot_and_moves_again_only_from_further_away() -> None:
    state = position_law.begin(LAW, 1.0)
    assert not position_law.approach(LAW, state, 1.0, 8, True)[0].rests
    aim, state = position_law.approach(LAW, state, 1.0, 9, True)
    assert aim == position_law.Aim(0.0, True)
    assert position_law.approach(LAW, state, 1.0, 11, False)[0].rests
    aim, moved = position_law.approach(LAW, state, 1.0, 12, False)
    assert aim.speed < 0.0 and moved.pushes == 1
    assert not position_law.approach(LAW, state, 1.2, 9, True)[0].rests  # another angle


def test_who_jumps_over_the_slot_comes_back_slower_and_stays_in_the_end() -> None:
    state, speeds, aim = position_law.begin(LAW, 10.0), [], position_law.Aim(0.0)
    for turn in range(2 * position_law.TRIES):
        aim, state = position_law.approach(LAW, state, 10.0, 95 if turn % 2 == 0 else 105, False)
        speeds.append(abs(aim.speed))
        aim, state = position_law.approach(LAW, state, 10.0, 105 if turn % 2 == 0 else 95, True)
        if aim.rests:
            break
    assert speeds == sorted(speeds, reverse=True) and speeds[-1] < 0.1 * speeds[0]
    assert aim.rests and aim.note == position_law.STAYS.format(5) and turn < 2 * position_law.TRIES - 1
    assert position_law.approach(LAW, replace(state), 10.0, 95, True)[0].rests
