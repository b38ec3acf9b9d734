"""An angle is reached within one slot, at 0 V, without hunting: friction, backlash, coarse discs and fine ones."""

from dataclasses import replace
from math import nan, tau

import numpy as np
import pytest
from bench_board import motor, settings
from lost_line import LostLine
from tiers import mark_slow

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
        mark_slow(motor(ks=0.2, breakaway_voltage=0.4)),
        mark_slow(motor(("backlash",), backlash_angle=0.1, load_fraction=0.5)),
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


@pytest.mark.parametrize(
    ("edges", "strays", "stream"),
    [
        (96, 50.0, ()),
        (960, 5.0, ()),
        (960, 5.0, (1, 0)),
        (960, 20.0, (1, 0)),
        (960, 5.0, (nan, 0)),
        (960, 5.0, (0.0, 0)),
        (960, 5.0, (None, 0)),
        (960, 20.0, (None, 1)),
    ],
)
def test_a_line_lost_at_rest_turns_the_motor_for_a_second_at_most(
    edges: int, strays: float, stream: tuple[float | None, ...]
) -> None:
    """Each stray edge pushed it out of its angle: 174 rad/s and 960 edges turned at 30 % of the top speed for ever.

    So it did under a stream of other angles, slots away, of NaN, of speeds (0.0 here) or of releases (None) in between.
    """
    board = BoardConfig(edges_per_revolution=edges, single_channel=False)
    config = settings(motor(), board.info(motor()), 0.02)
    simulated, state, voltage, line = SimulatedBoard(motor(), board), controller.State(), 0.0, None
    state, driven = controller.refer(state, 20.0, 0.0, Kind.POSITION), []
    for k in range(1000):
        sample = simulated.sample(voltage)
        if k >= 400:
            line = line or LostLine(strays, tau / edges, 1.0)
            sample = line.report(sample, k > 400)
            if stream and k % 20 == 0:
                asked = stream[k // 20 % 2]
                if asked is None:
                    state = controller.release(state, 0.0)[1]
                else:
                    speed = isinstance(asked, float) and asked == 0.0
                    angle = 0.0 if speed else (round(20.0 * edges / tau) + asked) * tau / edges
                    state = controller.refer(state, angle, k / 200.0, Kind.SPEED if speed else Kind.POSITION)
        output, state = controller.update(config, state, sample, None, k / 200.0)
        voltage = output.terms.voltage
        driven += [k / 200.0] * (k > 400 and voltage != 0.0)
    assert state.latched or stream or "does not come back" in output.reason
    assert len(driven) / 200.0 < (1.2 if stream else 1.0) and abs(simulated.speed) < 0.1
    assert stream or driven[-1] - driven[0] < 1.0


def test_a_motor_that_is_pushed_out_of_an_angle_has_to_come_nearer() -> None:
    def push(counts: list[int]) -> tuple[position_law.Aim, position_law.State]:
        state = position_law.State(0, resting=True)
        for count in counts:
            aim, state = position_law.approach(LAW, state, 0.0, count, False, 0.1)
        return aim, state

    assert push([5] * 10)[0].speed < 0.0  # for 0.9 s, and
    aim, state = push([5] * 11)
    assert aim.rests and aim.note == position_law.AWAY
    assert position_law.approach(LAW, state, 0.0, 0, True, 0.1)[0].rests  # until somebody asks for something else
    _, asked = position_law.approach(LAW, state, 1.0, 0, True, 0.1)  # a stream of other angles does not count as that
    assert position_law.approach(LAW, asked, 0.0, 5, True, 0.1)[0].rests
    for _ in range(11):
        _, state = position_law.approach(LAW, state, 0.0, 5, True, 0.1)
    assert position_law.approach(LAW, state, 1.0, 0, True, 0.1)[0].speed > 0.0
    assert not push([5, 9, 20, 40, 40, 40, 38, 38, 38, 36, 36, 36, 34] * 2)[0].rests  # nearer, then away, then nearer
    assert not push([5, 6, 7, 8, 9, 10, 11, 10, 9])[0].rests


def test_a_stream_that_runs_away_from_a_pushed_motor_counts_what_it_follows() -> None:
    """One slot a sample, and the motor three behind: never two slots nearer to an angle, and well on its way."""
    state = position_law.State(0, resting=True, count=0)
    _, state = position_law.approach(LAW, state, 0.0, -3, False, 0.1)
    for k in range(30):
        aim, state = position_law.approach(LAW, state, 0.1 * k, k - 3, False, 0.1)
        assert aim.speed > 0.0
    for _ in range(12):
        aim, state = position_law.approach(LAW, state, 2.9, 26, False, 0.1)
    assert aim.note == position_law.AWAY  # it is held now


def test_who_comes_back_more_slowly_and_a_flywheel_have_more_time() -> None:
    """Friction half again the model's: 5 of 12 pushes were given up though the motor came back to within a slot."""

    def held(state: position_law.State, config: position_law.Config = LAW) -> float:
        for k in range(99):
            aim, state = position_law.approach(config, state, 0.0, 5, False, 0.1)
            if aim.rests:
                return 0.1 * k
        return nan

    pushed = position_law.State(0, side=-1, pushed=True)
    assert held(pushed) == pytest.approx(0.9, abs=0.15)
    assert held(replace(pushed, overshoots=1)) == pytest.approx(1.8, abs=0.15)
    flywheel = position_law.design(tau / 24, 1.0, 4.0, 12.0, 30.0)  # two slots at 0.75 rad/s²: 1.2 s
    assert 2.3 < flywheel.return_time < 2.5 and held(pushed, flywheel) == pytest.approx(flywheel.return_time, abs=0.15)
    assert position_law.design(tau / 96, 0.2, 0.0034, 12.0, 174.0).return_time == position_law.RETURN_TIME
