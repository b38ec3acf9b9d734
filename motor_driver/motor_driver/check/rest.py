"""Watch the encoder while the motor is off: edges then are a bridge that is stuck on, the mains' hum, or noise."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from motor_driver.check.look import Act, Answer, Prompt, Steps
from motor_model.sensing.mains_rhythm import is_mains

QUIET = 1.0  # [s] without an edge is rest
PATIENCE = 3.0  # [s] in which a shaft that was turning comes to rest
EVEN = 0.2  # scatter of intervals, share of their mean: irregular slots of a motor that turns show 0.05, chance 1


@dataclass(frozen=True)
class Edge:
    """The latest edge at a sample."""

    time: float  # [s] on the board's clock
    count: int


@dataclass(frozen=True)
class Rhythm:
    """How edges follow each other."""

    rate: float  # [1/s]
    even: bool
    one_way: bool  # the count runs; to and fro it does not, with two channels

    @property
    def mains(self) -> bool:
        """Whether it is that of the mains."""
        return self.even and is_mains(self.rate)


def rhythm_of(edges: Sequence[Edge]) -> Rhythm:
    """Return the rhythm of edges, of which a sample shows the latest only."""
    times, counts = np.array([edge.time for edge in edges]), np.array([edge.count for edge in edges])
    passed = np.diff(counts)
    if len(edges) < 4 or times[-1] <= times[0]:
        return Rhythm(len(edges) / QUIET, even=False, one_way=False)
    one_way = bool(abs(passed.sum()) > 0.9 * np.abs(passed).sum())
    if one_way:
        each = np.diff(times) / np.maximum(np.abs(passed), 1)
        rate = float(abs(passed.sum()) / (times[-1] - times[0]))
    else:  # up and down again
        each = times[2:] - times[:-2]
        rate = float(1.0 / each.mean())
    return Rhythm(rate, bool(each.std() < EVEN * each.mean()), one_way)


@dataclass(frozen=True)
class Rest:
    """What the encoder does while the motor is off."""

    code: str = ""  # of a finding; empty: it rests
    rate: float = 0.0  # [1/s]


def watch_rest(two_channels: bool, hand: bool, hand_time: float) -> Steps[Rest]:
    """Wait until the encoder rests; where it does not, find out why."""
    edges: list[Edge] = []
    look = yield Act(prompt=Prompt.HANDS_OFF)
    begun = quiet = look.time
    seen = Edge(look.edge_time, look.count)
    while look.time - quiet < QUIET and look.time - begun < PATIENCE:
        look = yield Act(prompt=Prompt.HANDS_OFF)
        now = Edge(look.edge_time, look.count)
        if now != seen:
            seen, quiet = now, look.time
            edges.append(now)
    if look.time - quiet >= QUIET:
        return Rest()
    rhythm = rhythm_of([edge for edge in edges if edge.time > edges[-1].time - QUIET])
    answer = (yield from ask(Prompt.TURNS, hand_time)) if hand else None
    return Rest(cause_of(rhythm, two_channels, answer), rhythm.rate)


def cause_of(rhythm: Rhythm, two_channels: bool, turns: Answer | None) -> str:
    """Return the finding's code; `turns`: what somebody who looks at the shaft says."""
    if turns is Answer.YES:
        return "bridge_stuck_on"
    if turns is Answer.NO:
        return "hum" if rhythm.mains else "noise"
    if rhythm.even and rhythm.one_way and (two_channels or not rhythm.mains):
        return "bridge_stuck_on"
    if rhythm.mains:
        return "hum" if two_channels else "edges_at_rest"
    return "noise"


def ask(prompt: Prompt, most: float) -> Steps[Answer | None]:
    """Return what a person answers, with the motor off; None after `most` [s]."""
    look = yield Act(prompt=prompt)
    begun = look.time
    while look.answer is None and look.time - begun < most:
        look = yield Act(prompt=prompt)
    return look.answer
