"""When a search from many starts is over: independent descents end at one cost, and hardly a valley is left unseen."""

from dataclasses import dataclass

from motor_identification.estimation.objective import Floats, Landscape

AGREE = 0.01  # of the cost
UNSEEN = 0.05  # share of the descents that would end in a valley not seen yet, at which the search is over


@dataclass(frozen=True)
class Descent:
    """Where least squares ended."""

    place: Floats  # (D,)
    cost: float
    evaluations: int
    swarm: int  # number of the swarm from whose places it began


def alike(descents: list[Descent], landscape: Landscape) -> list[Descent]:
    """Those that ended at the least cost."""
    limit = (1.0 + AGREE) * min(descent.cost for descent in descents) + landscape.nothing
    return [descent for descent in descents if descent.cost <= limit]


def agreed(descents: list[Descent], landscape: Landscape) -> bool:
    """Whether more descents would hardly find a lower cost.

    Where noise explains the best cost, there is no lower one: two descents are enough. Elsewhere, of n descents that
    ended in w valleys, a share of w(w + 1)/(n(n − 1)) more would be expected to end in valleys not seen yet
    (C. Boender, A. Rinnooy Kan, Mathematical Programming 37, 1987).
    """
    agreeing = len(alike(descents, landscape))
    if min(descent.cost for descent in descents) <= max(landscape.explained, landscape.nothing):
        return agreeing >= 2
    rest, valleys = sorted(descent.cost for descent in descents), 0
    while rest:
        limit = (1.0 + AGREE) * rest[0] + landscape.nothing
        rest, valleys = [cost for cost in rest if cost > limit], valleys + 1
    count = len(descents)
    return agreeing >= 2 and valleys * (valleys + 1) <= UNSEEN * count * (count - 1)
