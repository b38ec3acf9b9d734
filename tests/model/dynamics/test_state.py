"""States that a motion begins with."""

import pytest

from motor_model.dynamics.state import at_rest, turning
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters


def test_a_motor_at_rest_has_no_direction_yet() -> None:
    assert at_rest(3.0) == (3.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@pytest.mark.parametrize("speed", [50.0, -50.0])
def test_a_turning_motor_has_its_current_settled_and_its_play_taken_up(speed: float) -> None:
    state = turning(Parameters({"kv": PAPER_KV, "ka": PAPER_KA}).vector(), speed, 6.0)
    assert (state.angle, state.speed, state.play, state.turned) == (0.0, speed, 0.0, 0.0)
    assert state.drive == pytest.approx(6.0 - PAPER_KV * speed)
    assert state.direction == (1.0 if speed > 0.0 else -1.0)
