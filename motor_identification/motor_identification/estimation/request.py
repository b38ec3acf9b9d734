"""Requests of fits, with the only home of a search's defaults, and the report of a search: data alone."""

from dataclasses import dataclass
from math import inf

import numpy as np
from numpy.typing import NDArray

from motor_identification.recording import Floats
from motor_model.errors import MotorError


@dataclass(frozen=True)
class SearchConfig:
    """Upper limits of a search: `particles` and `epochs` of every swarm, and their product for all evaluations.

    Raises:
        MotorError: a number that no search can do with.
    """

    particles: int = 50
    epochs: int = 200
    seed: int = 0

    def __post_init__(self) -> None:
        if self.particles < 2 or self.epochs < 1 or self.seed < 0:
            raise MotorError("particles must be at least 2, epochs at least 1, and the seed not negative.")

    @property
    def budget(self) -> int:
        """Evaluations after which nothing more is begun."""
        return self.particles * (self.epochs + 1)


@dataclass(frozen=True)
class PhysicalRequest:
    """What to make physics of: a measured current, or (above 0) a resistance and perhaps a torque constant.

    Raises:
        MotorError: a number that no motor has.
    """

    resistance: float = 0.0  # [Ω] 0: from the current
    resistance_error: float = 0.0  # [Ω] standard error
    torque_constant: float = 0.0  # [N·m/A] 0: unknown

    def __post_init__(self) -> None:
        numbers = (self.resistance, self.resistance_error, self.torque_constant)
        if not all(0.0 <= number < inf for number in numbers) or (self.resistance == 0.0 and any(numbers)):
            raise MotorError(
                "a resistance and a torque constant are positive numbers, and the constant needs the resistance."
            )


@dataclass(frozen=True)
class Request:
    """What to fit beyond kv and ka (of a diagnosis: what is known), how hard to search, and on how many cores.

    Raises:
        MotorError: a time limit that is none.
    """

    effects: tuple[str, ...] = ()
    search: SearchConfig = SearchConfig()
    workers: int = 1
    physical: PhysicalRequest | None = None  # None: armature voltages only
    time_limit: float = inf  # [s] after which a diagnosis tries nothing more, and says the best it has

    def __post_init__(self) -> None:
        if not self.time_limit > 0.0:
            raise MotorError(f"the time limit must be a positive number of seconds: {self.time_limit:g} is none.")


@dataclass(frozen=True)
class Descent:
    """The local minimum in which least squares ended."""

    theta: Floats  # (D,)
    cost: float
    evaluations: int
    swarm: int  # number of the swarm from whose particles it began


@dataclass(frozen=True)
class SearchReport:
    """The best θ of a global search, what it took, and how far it is to be trusted."""

    theta: Floats  # (D,)
    cost: float
    evaluations: int  # simulations of one motor, those for derivatives included
    trace: Floats  # best cost after each epoch of a swarm and each descent
    spent: NDArray[np.int64]  # evaluations until then
    descents: tuple[Descent, ...]  # best first
    agreeing: int  # how many of them ended at the best cost
    swarms: int  # each from a seed of its own
    agreed: bool  # whether that was the reason to stop; else the evaluations were used up

    @property
    def rms(self) -> Floats:
        """The trace as root mean squares: of an output error [rad/s]."""
        return np.asarray(np.sqrt(self.trace))
