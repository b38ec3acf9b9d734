"""What a step of the first run sees, and what it asks for."""

from collections.abc import Generator
from dataclasses import dataclass
from enum import Enum
from math import nan
from typing import TypeAlias, TypeVar

T = TypeVar("T")


class Answer(Enum):
    """What a person says to a prompt."""

    DONE = "done"
    YES = "yes"
    NO = "no"


class Prompt(Enum):
    """What a person is asked."""

    HANDS_OFF = "hands off"  # nothing is answered
    TURN = "turn"  # DONE, or NO: it cannot be turned
    TURNS = "turns"  # does the shaft turn now?
    FORWARD = "forward"  # was that forward?


@dataclass(frozen=True, slots=True)
class Look:
    """One sample."""

    time: float  # [s] on the board's clock
    count: int  # edges; with two channels backward ones count down
    edge_time: float  # [s] of the latest edge; 0 before the first
    voltage: float = 0.0  # [V] latched
    on: bool = False  # the output follows commands
    supply: float = nan  # [V] NaN if unmeasured
    current: float = nan  # [A] NaN if unmeasured
    answer: Answer | None = None  # said since the look before


@dataclass(frozen=True, slots=True)
class Act:
    """What is to be done until the next sample."""

    voltage: float = 0.0  # [V]
    on: bool = False  # the output is to follow `voltage`
    prompt: Prompt | None = None  # what a person is asked as long as it stands here


OFF = Act()
Steps: TypeAlias = Generator[Act, Look, T]
