"""Notice parameters that are set to and fro in a running loop.

The checks for faults read them, and begin anew, or look away, each time: whoever does that again and again blinds them.
"""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace

from motor_control.configuration import Value

MOST = 3  # times to and fro
WITHIN = 1.0  # [s] of the one before, at least: what comes more seldom leaves the checks time enough
SENTENCE = "{} was set to and fro {} times, each within a second: see who sets parameters."


@dataclass(frozen=True, slots=True)
class Turns:
    """What one parameter was set to."""

    value: Value
    before: Value | None = None  # the latest other one
    count: int = 0  # how often it has turned back
    latest: float = 0.0  # [s] when it last did

    def see(self, value: Value, now: float) -> "Turns":
        """The next value, at a time [s]."""
        if value == self.value:
            return self
        count, latest = self.count, self.latest
        if _turns_back(self.before, self.value, value):
            count, latest = count + 1 if count and now - latest <= WITHIN else 1, now
        return Turns(value, self.value, count, latest)


@dataclass(frozen=True, slots=True)
class Toggles:
    """What the parameters of a node were set to, of which checks read those in `checked`."""

    checked: Collection[str]
    turns: Mapping[str, Turns] = field(default_factory=dict)

    def see(self, values: Mapping[str, Value], now: float) -> tuple[str, "Toggles"]:
        """Take what is set at a time [s]: a sentence if that is once too often."""
        seen = {
            name: self.turns[name].see(value, now) if name in self.turns else Turns(value)
            for name, value in values.items()
            if name in self.checked
        }
        often = [name for name, turns in seen.items() if turns.count >= MOST and turns is not self.turns.get(name)]
        why = SENTENCE.format(" and ".join(often), MOST) if often else ""
        return why, replace(self, turns={**self.turns, **seen})


def _turns_back(before: Value | None, value: Value, after: Value) -> bool:
    """Tell whether a number that grew becomes less, or the other way; any other value turns with each change."""
    if before is None:
        return False
    if isinstance(after, str | bool) or isinstance(value, str | bool) or isinstance(before, str | bool):
        return True
    return (after - value) * (value - before) < 0.0
