"""Decide when a multi-start search stops: descents agree, and hardly a local minimum is left unseen."""

from collections.abc import Sequence

from motor_identification.estimation.request import Descent
from motor_identification.estimation.search.objective import Objective

SAME_COST = 0.01  # of the cost: descents this close ended in one local minimum
UNSEEN_SHARE = 0.05  # of further descents that would end in a local minimum not seen yet, at which the search is over


def select_agreeing(descents: Sequence[Descent], objective: Objective) -> list[Descent]:
    """Select the descents that ended at the least cost."""
    limit = (1.0 + SAME_COST) * min(descent.cost for descent in descents) + objective.negligible
    return [descent for descent in descents if descent.cost <= limit]


def meets_stopping_rule(descents: Sequence[Descent], objective: Objective) -> bool:
    """Decide whether more descents would hardly find a lower local minimum.

    Where noise explains the best cost, there is no lower one: two descents are enough. Elsewhere, of n descents that
    ended in w local minima, a share of w(w + 1)/(n(n − 1)) more would be expected to end in minima not seen yet
    (C. Boender, A. Rinnooy Kan, Mathematical Programming 37, 1987).
    """
    agreeing = len(select_agreeing(descents, objective))
    if min(descent.cost for descent in descents) <= max(objective.noise_cost, objective.negligible):
        return agreeing >= 2
    rest, minima = sorted(descent.cost for descent in descents), 0
    while rest:
        limit = (1.0 + SAME_COST) * rest[0] + objective.negligible
        rest, minima = [cost for cost in rest if cost > limit], minima + 1
    count = len(descents)
    return agreeing >= 2 and minima * (minima + 1) <= UNSEEN_SHARE * count * (count - 1)
