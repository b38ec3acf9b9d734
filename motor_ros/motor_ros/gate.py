"""What a plant lets through to the motor: nothing while disabled, nothing stale, nothing that is not a number."""

from dataclasses import dataclass, replace
from math import isfinite


@dataclass(frozen=True, slots=True)
class Gate:
    """The newest command and whether it may act; every method returns the next gate."""

    enabled: bool
    timeout: float  # [s] after which a command is stale
    command: float = 0.0  # [V]
    received: int | None = None  # [ns]
    refused: int = 0  # commands that were not numbers

    def take(self, voltage: float, now: int) -> "Gate":
        """A command [V] arrives at `now` [ns]; one that is not a number stops the motor."""
        if not isfinite(voltage):
            return replace(self, command=0.0, received=None, refused=self.refused + 1)
        return replace(self, command=voltage, received=now)

    def enable(self, on: bool) -> "Gate":
        """Switch the output; a command from before the switch never acts."""
        return replace(self, enabled=on, command=0.0, received=None)

    def fresh(self, now: int) -> bool:
        """Whether there is a command at `now` [ns] that is not too old."""
        return self.received is not None and now - self.received <= self.timeout * 1e9

    def voltage(self, now: int) -> float:
        """[V] to apply at `now` [ns]."""
        return self.command if self.enabled and self.fresh(now) else 0.0

    def state(self, now: int) -> str:
        """In words, for diagnostics."""
        if not self.enabled:
            return "output off: call motor/enable with data: true"
        return "driven" if self.fresh(now) else "waiting for motor/voltage, 0 V"
