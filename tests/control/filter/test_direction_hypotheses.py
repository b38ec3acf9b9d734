"""Two directions side by side: when the second is opened, dropped, or taken for the true one."""

from math import inf

import pytest
from filter_bench import NOISE, SLOT, held, state, vector

from motor_control.filter.direction_hypotheses import (
    HEAD_START,
    OPEN,
    OVERTAKEN,
    SETTLED,
    Hypotheses,
    decide_direction,
    finish_sample,
    predict_hypotheses,
    update_hypotheses,
)
from motor_control.filter.load_jump import no_jumps


def pair(lead: float = inf, speed: float = 20.0, other: float = -20.0) -> Hypotheses:
    return Hypotheses(state(speed), state(other), lead, no_jumps())


@pytest.mark.parametrize(("margin", "opened"), [(OPEN - 0.1, True), (OPEN + 0.1, False)])
def test_doubt_at_an_edge_opens_the_mirrored_motion(margin: float, opened: bool) -> None:
    after = decide_direction(pair(), margin)
    assert (after.lead == HEAD_START) == opened
    if opened:
        assert after.other.estimate.motor.speed == -20.0


def test_the_other_one_wins_where_it_leads_by_enough() -> None:
    assert decide_direction(pair(-OVERTAKEN + 0.1), inf).likely.estimate.motor.speed == 20.0
    won = decide_direction(pair(-OVERTAKEN - 0.1), inf)
    assert won.likely.estimate.motor.speed == -20.0 and won.lead == inf


def test_it_is_dropped_once_settled_or_agreed() -> None:
    assert decide_direction(pair(SETTLED - 0.1), inf).lead == SETTLED - 0.1
    assert decide_direction(pair(SETTLED + 0.1), inf).lead == inf
    assert decide_direction(pair(1.0, 20.0, 18.0), inf).lead == inf


def test_a_wrong_direction_is_turned_round_by_the_next_edges() -> None:
    """The motor turns forwards at 30 rad/s under 2.5 V; the likely hypothesis says backwards."""
    p, commands, dt = vector(), held(2.5), SLOT / 30.0
    both = pair(3.0, -30.0, 30.0)
    for _ in range(12):
        both = predict_hypotheses(p, NOISE, both, commands, 0.0, dt)
        both = update_hypotheses(p, NOISE, both, 2.5, 1.0, False)
    assert both.likely.estimate.motor.speed == pytest.approx(30.0, rel=0.15) and both.lead == inf


def test_a_sample_without_an_edge_cuts_both_back() -> None:
    both = pair(3.0)
    both = predict_hypotheses(vector(), NOISE, both, held(1.4), 0.0, 0.02)
    after = finish_sample(vector(), NOISE, both, 1.4, 0.02, False)
    assert abs(after.likely.estimate.motor.angle) < abs(both.likely.estimate.motor.angle)
    assert abs(after.other.estimate.motor.angle) < abs(both.other.estimate.motor.angle)
    assert finish_sample(vector(), NOISE, both, 1.4, 0.02, True).likely.estimate == both.likely.estimate
