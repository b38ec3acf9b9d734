"""What an effect is: its name, what it does, its parameters with their units and where a search looks for them."""

from dataclasses import dataclass
from math import inf


@dataclass(frozen=True, slots=True)
class Extent:
    """How far recordings reach: what the search box is scaled by."""

    voltage: float  # [V] the largest
    speed: float  # [rad/s] the largest
    duration: float  # [s] the longest
    sample: float = 0.005  # [s] the shortest sample period; of steady states, the time that each is the mean over
    cycles: float = 48.0  # [1/rev of the encoder's shaft] of the finest ripple that can be told from its mirror image
    steady: bool = False  # nothing but steady states, in which no motion is on its way


@dataclass(frozen=True, slots=True)
class Scale:
    """What a search bound is a multiple of: powers of what recordings reach."""

    voltage: float = 0.0
    speed: float = 0.0
    duration: float = 0.0
    sample: float = 0.0

    def of(self, extent: Extent) -> float:
        """Return the size for recordings."""
        times = extent.duration**self.duration * extent.sample**self.sample
        return float(extent.voltage**self.voltage * extent.speed**self.speed * times)


ABSOLUTE, DURATION = Scale(), Scale(duration=1)
UNSEEN_BOX = 2.0  # high over low end of the box of what no recording shows
MOST_CERTAIN_CYCLES = 2.0  # [1/rev of the encoder's shaft] that any disc shows


@dataclass(frozen=True, slots=True)
class ParameterSpec:
    """One parameter: `off` makes its effect vanish, `low`..`high` (times `scale`) is where a search looks.

    `minimum` and `maximum` are what physics allows at all; `logarithmic` parameters are searched by their logarithm.
    What is `of_recording` has a value for every recording of a motor, such as a phase: there is no index pulse.
    `starts` are where a fit begins that adds the effect to a model (in multiples of `scale`): as many as it has local
    minima. `at_least` names a parameter that this one is never below: starts count from there. `usual` is what the box
    spans in any case, in the parameter's unit, and `most_duration` the share of a recording that it never exceeds.
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
    usual: tuple[float, float] | None = None
    most_duration: float = inf
    of_encoder: bool = False  # the box ends where the encoder's view does (`Extent.cycles`)
    of_motion: bool = False  # steady states do not show it: there the box is next to nothing, at its low end

    @property
    def is_instant(self) -> bool:
        """Whether it is a time at which something begins, in every recording another."""
        return self.of_recording and self.scale == DURATION

    def box(self, extent: Extent) -> tuple[float, float]:
        """Return where a search looks in recordings that reach so far."""
        low, high = self.low * self.scale.of(extent), self.high * self.scale.of(extent)
        if self.usual is not None:
            low, high = min(low, self.usual[0]), max(high, self.usual[1])
        if self.of_encoder:
            high = max(extent.cycles, MOST_CERTAIN_CYCLES)
        if self.of_motion and extent.steady:
            return low, UNSEEN_BOX * low
        return low, min(high, self.most_duration * extent.duration)


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
        on_disc: it moves the disc's flanks, not the shaft: it is the first harmonic of the slots, which are then learnt
            without it.
        linear_onset: it begins in proportion to its first parameter, so that the derivative at 0 says which other
            effects would have left the same trace.
        holds: it holds the motor at rest under a voltage, which nothing that only shapes a motion does.
        anywhere: it happens once, or slowly: a few pieces of a long recording do not show it.
        after_reversals: it shows for a while after the motor has turned round, and nowhere else.
        constant: the effect of the same size that it is where it began before the motion did.
        of_supply: what it does depends on the share of the supply that is applied.
        stands_for: a sentence: what outside the table does the same, and what tells; empty where nothing is known to.
        splits_kv: viscous friction, which is a torque, differs from back-EMF under it; kv is both.
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
    holds: bool = False
    anywhere: bool = False
    after_reversals: bool = False
    constant: str | None = None
    of_supply: bool = False
    stands_for: str = ""
    splits_kv: bool = False
    fitted: bool = True

    @property
    def title(self) -> str:
        """The name as a person writes it."""
        return self.name.replace("_", " ").replace("coulomb", "Coulomb")
