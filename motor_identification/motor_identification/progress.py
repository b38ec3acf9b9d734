"""Report progress of a long computation, and stop it when its caller says so."""

from collections.abc import Callable
from dataclasses import dataclass

from motor_model.errors import MotorError


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

    def report(self, text: str, share: float, best_effect: str, gap: float) -> None:
        """Report how far it is.

        Raises:
            Stopped: so that was what the caller wanted.
        """
        if self.stopped():
            raise Stopped("the diagnosis was stopped.")
        self.progress(Stage(text, share, best_effect, gap))
