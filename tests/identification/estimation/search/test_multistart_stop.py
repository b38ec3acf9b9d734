"""The stopping rule: two descents at the noise, many where local minima differ."""

import numpy as np
import pytest

from motor_identification.estimation.request import Descent
from motor_identification.estimation.search.multistart_stop import (
    SAME_COST,
    UNSEEN_SHARE,
    meets_stopping_rule,
    select_agreeing,
)
from motor_identification.estimation.search.objective import Objective


def objective(noise_cost: float = 0.0, negligible: float = 0.0) -> Objective:
    nothing = np.zeros(1)
    return Objective(
        nothing,
        nothing + 1.0,
        nothing > 0,
        lambda x: x[:, 0],
        lambda x: x,
        noise_cost=noise_cost,
        negligible=negligible,
    )


def descents(*costs: float) -> list[Descent]:
    return [Descent(np.zeros(1), cost, 10, 0) for cost in costs]


@pytest.mark.parametrize(("times", "agreeing"), [(0.99, 2), (1.01, 1)])
def test_descents_agree_within_a_share_of_the_cost(times: float, agreeing: int) -> None:
    ended = descents(1.0, 1.0 + times * SAME_COST, 5.0)
    assert len(select_agreeing(ended, objective())) == agreeing


def test_costs_as_good_as_nothing_agree() -> None:
    ended = descents(1e-14, 9e-13)
    assert len(select_agreeing(ended, objective())) == 1
    assert len(select_agreeing(ended, objective(negligible=1e-12))) == 2


@pytest.mark.parametrize(("noise", "over"), [(1.01, True), (0.99, False)])
def test_two_are_enough_where_noise_explains_the_cost(noise: float, over: bool) -> None:
    assert meets_stopping_rule(descents(1.0, 1.0), objective(noise_cost=noise)) is over
    assert not meets_stopping_rule(descents(1.0), objective(noise_cost=noise))
    assert not meets_stopping_rule(descents(1.0, 2.0), objective(noise_cost=noise))


@pytest.mark.parametrize(("count", "over"), [(6, False), (7, True)])
def test_one_local_minimum_is_believed_after_seven(count: int, over: bool) -> None:
    """w(w + 1)/(n(n − 1)) with w = 1 falls to 0.05 between n = 6 and n = 7."""
    assert 2.0 / (6 * 5) > UNSEEN_SHARE > 2.0 / (7 * 6)
    assert meets_stopping_rule(descents(*[1.0] * count), objective()) is over


@pytest.mark.parametrize(("count", "over"), [(15, False), (16, True)])
def test_three_local_minima_take_longer(count: int, over: bool) -> None:
    """12/(n(n − 1)) falls to 0.05 at n = 16; and the least one has to be found twice."""
    costs = [1.0] * (count - 2) + [2.0, 3.0]
    assert meets_stopping_rule(descents(*costs), objective()) is over
    assert not meets_stopping_rule(descents(0.5, *costs), objective())
