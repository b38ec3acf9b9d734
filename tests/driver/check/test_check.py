"""The state machine by plain calls on the simulated motor: each wiring is named, and the motor is off in time."""

from dataclasses import replace
from math import nan

import numpy as np
import pytest
from first_run_bench import SimulatedRun, hello, motor
from hypothesis import given, settings
from hypothesis import strategies as st

from motor_board.emulation.wiring import Wiring
from motor_driver.check.check import Check
from motor_driver.check.look import OFF, Act, Answer, Look, Prompt
from motor_driver.check.settings import Settings

TOLD = Settings(edges_per_revolution=96)
ALONE = Settings(edges_per_revolution=96, hand=False)
MOTORS = {6: motor(6.0, 6.0, 0.15), 30: motor(30.0, 12.0, 0.1), 174: motor(), 600: motor(600.0, 24.0, 0.05)}


@pytest.mark.parametrize("top", MOTORS)
@pytest.mark.parametrize("channels", [1, 2])
def test_what_is_right_is_found_right_and_measured(top: int, channels: int) -> None:
    true = MOTORS[top]
    settings = Settings(max_voltage=true.max_voltage, edges_per_revolution=96)
    run = SimulatedRun(settings, true, channels=channels, seed=top)
    check, measured = run.run(), run.check.record.measured
    assert check.record.codes == [] and check.right
    breakaway = true.values["breakaway_voltage"] / true.max_voltage
    for found in (measured.breakaway_forward, measured.breakaway_backward):
        assert breakaway - 0.001 <= found / true.max_voltage < breakaway + 0.06  # the edge comes a little later
    assert measured.gain == pytest.approx(true.gain, rel=0.04)
    assert measured.top_speed == pytest.approx(top, rel=0.04)
    assert 94 <= measured.edges_by_hand <= 98
    assert max(abs(act.voltage) for _, act, _ in run.acts) <= 0.5 * true.max_voltage


CASES = [
    ("a motor's wires exchanged, 1 channel", 1, Wiring(motor_swapped=True), ["motor_swapped"]),
    ("a motor's wires exchanged", 2, Wiring(motor_swapped=True), ["motor_swapped"]),
    ("A and B exchanged", 2, Wiring(channels_swapped=True), ["channels_swapped"]),
    ("both exchanged", 2, Wiring(motor_swapped=True, channels_swapped=True), ["channels_swapped", "motor_swapped"]),
    ("no A", 2, Wiring(a_connected=False), ["a_missing"]),
    ("no B", 2, Wiring(b_connected=False), ["b_missing"]),
    ("no supply", 1, Wiring(powered=False), ["no_power"]),
    ("stuck", 2, Wiring(shaft_stuck=True), ["stuck_shaft"]),
    ("bridge stuck on", 1, Wiring(bridge_stuck=0.4), ["bridge_stuck_on"]),
    ("hum", 1, Wiring(hum=50.0), ["hum"]),
    ("hum on both", 2, Wiring(hum=60.0), ["hum"]),
]


@pytest.mark.parametrize(("channels", "wiring", "codes"), [case[1:] for case in CASES], ids=[case[0] for case in CASES])
def test_each_wiring_is_named(channels: int, wiring: Wiring, codes: list[str]) -> None:
    run = SimulatedRun(TOLD, channels=channels, wiring=wiring)
    check = run.run()
    assert check.record.codes == codes
    assert check.right == (set(codes) <= {"motor_swapped", "channels_swapped"})
    assert check.act == OFF


@pytest.mark.parametrize(
    ("channels", "wiring", "codes"),
    [
        (2, Wiring(), []),
        (2, Wiring(motor_swapped=True), ["against"]),
        (2, Wiring(channels_swapped=True), ["against"]),
        (2, Wiring(b_connected=False), ["b_missing"]),
        (2, Wiring(a_connected=False), ["no_motion"]),
        (1, Wiring(shaft_stuck=True), ["no_motion"]),
        (1, Wiring(bridge_stuck=-0.4), ["bridge_stuck_on"]),
        (1, Wiring(hum=50.0), ["edges_at_rest"]),
    ],
)
def test_with_nobody_there_it_says_what_it_cannot_tell(channels: int, wiring: Wiring, codes: list[str]) -> None:
    assert SimulatedRun(ALONE, channels=channels, wiring=wiring).run().record.codes == codes


@pytest.mark.parametrize(
    ("supply", "codes"),
    [(nan, []), (12.0, []), (13.1, []), (13.3, ["supply_too_high"]), (9.7, []), (9.5, ["supply_too_low"])]
    + [(2.9, ["no_supply"]), (3.1, ["supply_too_low"])],
)
def test_the_supply_is_judged_where_it_is_measured_and_then_nothing_is_driven(supply: float, codes: list[str]) -> None:
    run = SimulatedRun(ALONE, supply=supply)
    assert run.run().record.codes == codes
    assert any(act.voltage for _, act, _ in run.acts) == (codes == [])


@pytest.mark.parametrize(("supply", "codes"), [(0.29, ["no_supply"]), (0.31, ["supply_too_low"])])
def test_a_missing_supply_is_less_than_a_quarter_of_what_is_expected(supply: float, codes: list[str]) -> None:
    settings = replace(ALONE, max_voltage=1.2, supply_voltage=0.0)
    assert SimulatedRun(settings, supply=supply).run().record.codes == codes


def test_counts_that_cannot_be_true_and_counts_that_nobody_knows() -> None:
    assert SimulatedRun(TOLD, edges=48).run().record.codes == ["wrong_counts"]
    assert SimulatedRun(Settings()).run().record.codes == ["unknown_counts"]
    assert SimulatedRun(Settings(hand=False)).run().record.codes == ["no_counts"]


def test_a_stop_from_outside_ends_it_for_good() -> None:
    check = Check(ALONE, hello())
    check.see(Look(0.0, 0, 0.0))
    check.abort("Ctrl-C")
    assert check.done and not check.right and check.see(Look(0.005, 0, 0.0)) == OFF
    assert check.record.findings[-1].sentence == "The check has stopped the motor: Ctrl-C."


def test_a_board_that_does_not_switch_on_is_a_stop() -> None:
    check, act, time = Check(ALONE, hello()), Act(), 0.0
    while not check.done and time < 10.0:
        act = check.see(Look(time, 0, 0.0, on=False))
        assert act.voltage == 0.0
        time += 0.005
    assert check.record.findings[-1].sentence.endswith("the board does not switch its output on.")


def test_nobody_who_answers_is_waited_for_no_longer_than_was_said() -> None:
    check, time = Check(Settings(edges_per_revolution=96, hand_time=5.0), hello()), 0.0
    while check.act.prompt is None or check.act.prompt.value != "turn":
        check.see(Look(time, 0, 0.0))
        time += 0.005
    begun = time
    while check.act.prompt is not None:
        check.see(Look(time, 0, 0.0))
        time += 0.005
    assert 4.9 < time - begun < 5.1


@pytest.mark.parametrize("turning", [False, True])
def test_a_shaft_that_may_be_in_a_hand_is_not_driven(turning: bool) -> None:
    """Nobody has said that the turn is done: whoever turns it still does, or has gone."""
    check, time, count = Check(Settings(edges_per_revolution=96, hand_time=5.0), hello()), 0.0, 0
    while not check.done and time < 30.0:
        count += turning and check.act.prompt is Prompt.TURN
        act = check.see(Look(time, count, 0.01 * count))
        assert act.voltage == 0.0 and not act.on
        time += 0.005
    assert check.record.codes == ["nobody_answered"] and not check.right


def test_a_current_that_is_measured_gives_the_stall_current() -> None:
    check, time = Check(ALONE, hello()), 0.0
    act, moved = Act(), False
    while not check.done and time < 30.0:
        moved = abs(act.voltage) > (1.0 if moved else 2.0)
        edge = round(time, 2) if moved else 0.5
        act = check.see(Look(time, 0, edge, act.voltage, act.on, current=0.5 * act.voltage, answer=Answer.DONE))
        time += 0.005
    assert check.record.measured.stall_current == pytest.approx(6.0, rel=0.02)  # 12 V over 2 ohm
    assert "about 6 A if the motor were blocked at 12 V" in [row.text for row in check.record.rows]


@given(st.integers(0, 2**32 - 1), st.sampled_from([1, 2]), st.booleans())
@settings(max_examples=25, deadline=None)
def test_whatever_comes_it_ends_within_its_limits(seed: int, channels: int, hand: bool) -> None:
    """Edges, counts, supplies and answers at random, with some sense at times: no exception, no voltage beyond."""
    random = np.random.default_rng(seed)
    check = Check(Settings(edges_per_revolution=96, hand=hand, hand_time=2.0), hello(channels))
    act, time, count, edge = Act(), 1.0, 0, 0.0
    rate = float(random.choice([0.0, 3.0, 50.0, 900.0, 30_000.0]))
    for _ in range(12_000):
        if random.random() < 0.01:
            rate = float(random.choice([0.0, 3.0, 50.0, 900.0, 30_000.0])) * (
                act.voltage != 0.0 or random.random() < 0.2
            )
        passed = int(random.poisson(rate * 0.005)) * int(random.choice([-1, 1]))
        count, edge = count + passed, time - 0.001 * random.random() if passed else edge
        answer = random.choice([None, None, None, *Answer]) if random.random() < 0.02 else None
        supply = float(random.choice([12.0, nan, 0.0, 30.0])) if random.random() < 0.0005 else 12.0
        act = check.see(Look(time, count, edge, act.voltage, act.on, supply, answer=answer))
        assert abs(act.voltage) <= 6.0
        time += 0.005 if random.random() > 1e-4 else 0.3
        if check.done:
            break
    assert check.done and check.act == OFF and check.record.rows
