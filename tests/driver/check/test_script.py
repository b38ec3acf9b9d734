"""The order of the steps: nothing is driven before board, supply, rest and encoder are right."""

import pytest
from first_run_bench import SimulatedRun

from motor_board.emulation.wiring import Wiring
from motor_driver.check.look import Prompt
from motor_driver.check.settings import Settings

TOLD = Settings(edges_per_revolution=96)


def test_the_steps_come_in_their_order_and_the_motor_is_off_for_the_first() -> None:
    run = SimulatedRun(TOLD, channels=2)
    steps = [row.step for row in run.run().record.rows]
    assert steps == ["supply", "at rest", "encoder", "motion", "direction", "speed"]
    first = next(k for k, (_, act, _) in enumerate(run.acts) if act.on)
    asked = [act.prompt for _, act, _ in run.acts[:first] if act.prompt]
    assert asked[0] is Prompt.HANDS_OFF and asked[-1] is Prompt.TURN
    assert not any(act.on and act.prompt for _, act, _ in run.acts)


@pytest.mark.parametrize(
    "wiring",
    [Wiring(bridge_stuck=0.4), Wiring(hum=50.0), Wiring(a_connected=False), Wiring(b_connected=False)],
)
def test_what_is_wrong_with_the_motor_off_keeps_it_off(wiring: Wiring) -> None:
    run = SimulatedRun(TOLD, channels=2, wiring=wiring)
    assert run.run().record.wrong and not any(act.on for _, act, _ in run.acts)


def test_a_motor_that_turns_in_one_direction_only_is_named() -> None:
    class Half(Wiring):
        def drive(self, share: float) -> float:
            return max(share, 0.0)

    class Same(Wiring):
        def drive(self, share: float) -> float:
            return abs(share)

    class Full(Wiring):
        def drive(self, share: float) -> float:
            return 0.3 * ((share > 0.08) - (share < -0.08))

    for wiring, code in ((Half(), "one_way"), (Same(), "same_way"), (Full(), "not_proportional")):
        assert SimulatedRun(TOLD, channels=2, wiring=wiring).run().record.codes == [code]
