"""What an effect is: its name, what it does, its parameters with their units and where a search looks for them."""

from dataclasses import dataclass
from math import inf


@dataclass(frozen=True, slots=True)
class Scale:
    """What a search bound is a multiple of: powers of a recording's largest voltage, largest speed and duration."""

    voltage: float = 0.0
    speed: float = 0.0
    duration: float = 0.0

    def of(self, voltage: float, speed: float, duration: float) -> float:
        """Return the size for a recording that reaches `voltage` [V] and `speed` [rad/s] in `duration` [s]."""
        return float(voltage**self.voltage * speed**self.speed * duration**self.duration)


ABSOLUTE = Scale()


@dataclass(frozen=True, slots=True)
class ParameterSpec:
    """One parameter: `off` makes its effect vanish, `low`..`high` (times `scale`) is where a search looks.

    `minimum` and `maximum` are what physics allows at all; `logarithmic` parameters are searched by their logarithm.
    What is `of_recording` has a value for every recording of a motor, such as a phase: there is no index pulse.
    `starts` are where a fit begins that adds the effect to a model (in multiples of `scale`): as many as it has local
    minima. `at_least` names a parameter that this one is never below: starts count from there.
    """

    name: str
    unit: str
    off: float
    low: float
    high: float
    scale: Scale = ABSOLUTE
    logarithmic: bool = False
    minimum: float = 0.0
    maximum: float = inf
    of_recording: bool = False
    starts: tuple[float, ...] = ()
    at_least: str | None = None


@dataclass(frozen=True, slots=True)
class Effect:
    """A named physical effect: what it does, its parameters, and the effect it cannot be without.

    Attributes:
        name: in files, messages and JSON.
        summary: what it does, as a formula or half a sentence.
        shown_by: the excitation profile (`excitation.py`) that makes it visible.
        phrase: its level, as a caution to people calls it; the name follows in brackets.
        parameters: the first is the size of the effect.
        implies: the effect it cannot be without.
        periodic: it repeats with the shaft angle (`periodic/` of the identification finds it in a spectrum).
        on_disc: it moves the disc's flanks, not the shaft: only counted edges show it, and it is the first harmonic of
            the slots, which are then learnt without it.
        linear_onset: it begins in proportion to its first parameter, so that the derivative at 0 says which other
            effects would have left the same trace.
        anywhere: it happens once, or slowly: a few pieces of a long recording do not show it.
        fitted: a fit can have it as a parameter; else it is recognised in what any fit leaves.
    """

    name: str
    summary: str
    shown_by: str
    phrase: str
    parameters: tuple[ParameterSpec, ...]
    implies: str | None = None
    periodic: bool = False
    on_disc: bool = False
    linear_onset: bool = False
    anywhere: bool = False
    fitted: bool = True

    @property
    def title(self) -> str:
        """The name as a person writes it."""
        return self.name.replace("_", " ").replace("coulomb", "Coulomb")
