"""What the steps have shown: direction from hand, eye and counts; edges that the board could not count."""

import pytest
from first_run_bench import SimulatedRun, motor

from motor_driver.check.drive import Breakaway
from motor_driver.check.judge import judge_direction
from motor_driver.check.look import Answer
from motor_driver.check.record import Record
from motor_driver.check.settings import Settings

TOLD = Settings(edges_per_revolution=96)


@pytest.mark.parametrize(
    ("two", "by_hand", "count", "answer", "codes"),
    [
        (True, 1, 3, None, []),
        (True, 1, -3, None, ["motor_swapped"]),
        (True, -1, -3, None, []),  # the encoder's exchange was found by hand already
        (True, -1, 3, None, ["motor_swapped"]),
        (True, 0, 3, Answer.YES, []),
        (True, 0, 3, Answer.NO, ["motor_swapped", "channels_swapped"]),
        (True, 0, -3, Answer.YES, ["channels_swapped"]),
        (True, 0, -3, Answer.NO, ["motor_swapped"]),
        (True, 0, 3, None, []),
        (True, 0, -3, None, ["against"]),
        (False, 0, 3, Answer.NO, ["motor_swapped"]),
        (False, 0, 3, None, []),
    ],
)
def test_what_is_exchanged_follows_from_hand_eye_and_counts(
    two: bool, by_hand: int, count: int, answer: Answer | None, codes: list[str]
) -> None:
    record = Record()
    judge_direction(two, record, by_hand, Breakaway(1.0, count, 3), answer)
    assert record.codes == codes


@pytest.mark.parametrize(("top", "codes"), [(610.0, []), (690.0, ["too_many_edges"])])
def test_more_edges_than_the_board_counts_are_said_before_they_come(top: float, codes: list[str]) -> None:
    """96 edges at 654 rad/s are 10,000 a second."""
    run = SimulatedRun(TOLD, motor(top), channels=2)
    assert run.run().record.codes == codes
    assert "the board counts 10000 for certain" in run.check.record.rows[-2].text or not codes
