"""Report progress of a long computation, and stop it when its caller says so."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from time import monotonic
from typing import Any, Generic, TypeVar

from motor_model.errors import MotorError

R = TypeVar("R")

TELL_EVERY = 0.1  # [s]
HALF = 1000  # simulations: a fit of friction takes 200 after its search, one of backlash and ripple some thousands


class Stopped(MotorError):
    """The computation was told to stop."""


@dataclass(frozen=True)
class Stage:
    """How far a diagnosis is."""

    text: str
    share: float  # done, 0 to 1
    best_effect: str
    gap: float  # [rad/s] of the best model so far


@dataclass(frozen=True)
class ProgressReporter:
    """Progress out, stop in."""

    progress: Callable[[Stage], None]
    stopped: Callable[[], bool]
    keep: Callable[[Any], None] = lambda result: None  # told of every result on the way

    def beyond(self, share: float) -> "ProgressReporter":
        """The same, of what is done at the end: progress that goes on from this share."""
        return replace(self, progress=lambda stage: self.progress(replace(stage, share=max(share, stage.share))))

    def report(self, text: str, share: float, best_effect: str, gap: float) -> None:
        """Report how far it is.

        Raises:
            Stopped: so that was what the caller wanted.
        """
        if self.stopped():
            raise Stopped("the diagnosis was stopped.")
        self.progress(Stage(text, share, best_effect, gap))


@dataclass
class TimeLimit(Generic[R]):
    """A limit in time that counts once there is a result to return: keeps the best so far, and says when to stop."""

    seconds: float
    stopped: Callable[[], bool]  # the caller's own wish, which is no limit
    is_better: Callable[[R, R], bool]  # the first result than the second one
    clock: Callable[[], float] = monotonic
    best: R | None = None
    done: bool = False  # nothing is stopped any more: what is left is to say the result
    _begun: float = field(init=False)

    def __post_init__(self) -> None:
        self._begun = self.clock()

    def keep(self, result: R) -> None:
        """Keep a result if it is the best so far."""
        if self.best is None or self.is_better(result, self.best):
            self.best = result

    def begin_with(self, result: R) -> None:
        """Begin with a result, which from now on is the best so far; one from before may be of other data."""
        self.best = result

    @property
    def reached(self) -> bool:
        """Whether the time is used up, and there is a result."""
        return self.best is not None and not self.done and self.clock() - self._begun > self.seconds

    def begin_again(self) -> bool:
        """Forget the results so far, which another search is to find anew; False, and nothing of it, without time."""
        if self.clock() - self._begun > self.seconds:
            return False
        self.best, self.done = None, False
        return True

    def over(self) -> bool:
        """Whether to stop, for either reason."""
        return self.stopped() or self.reached


@dataclass
class Heartbeat:
    """Progress of stages whose length nobody knows: counts simulations, and never says to stop.

    A problem asks it before every simulation (`Problem.stopped`). Half a stage's part of the bar is done after `HALF`
    simulations, half of the rest after as many again: the bar moves as long as something is done, and never arrives.
    """

    tell: Callable[[str, float], None]  # what is being done, share done 0 to 1
    _text: str = ""  # empty: the stage tells its own progress
    _from: float = 0.0
    _to: float = 0.0
    _count: int = 0
    _told: float = field(default_factory=monotonic)  # [s]

    def begin(self, text: str, start: float, end: float) -> None:
        """Begin a stage that has this part of the whole."""
        self._text, self._from, self._to, self._count = text, start, end, 0
        self.tell(text, start)

    def __call__(self) -> bool:
        """Count a simulation, and tell a few times a second; false, for it is not to stop."""
        self._count += 1
        if self._text and monotonic() - self._told >= TELL_EVERY:
            self._told = monotonic()
            share = self._to - (self._to - self._from) * 0.5 ** (self._count / HALF)
            self.tell(f"{self._text}, {self._count} simulations", share)
        return False
