"""Hold the result of a diagnosis: which effects were missing, what each of them explains, and what is left."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from math import isfinite

from motor_identification.diagnosis.thresholds import EXPLAINED_GAP
from motor_identification.discrepancy.structure import Structure
from motor_identification.measurement.sanity_checks import Undriven
from motor_identification.noise.error_model import Disturbance
from motor_identification.recording import Floats
from motor_identification.uncertainty.result import Fit
from motor_identification.validation.held_out import HeldOut
from motor_model.effects import EFFECT_BY_NAME


class Verdict(str, Enum):
    """How a diagnosis ended."""

    EXPLAINED = "explained"  # effects were found and the gap is at the noise floor
    NOTHING_MISSING = "nothing_missing"
    UNEXPLAINED = "unexplained"  # something is missing that is not in the table
    UNDECIDED = "undecided"  # something is or may be missing, and this recording cannot tell which


@dataclass(frozen=True)
class Alternative:
    """Another effect that was tried where a finding was made."""

    effect: str
    gap_after: float  # [rad/s]
    evidence: float  # logarithm of the likelihood ratio to the model without it, on held-out data


NO_SIZE = 2.0  # standard errors of a size, within which of none it tells that something is there, and not how much


@dataclass(frozen=True)
class Finding:
    """An effect that was missing."""

    effect: str
    gap_before: float  # [rad/s] on held-out data
    gap_after: float
    evidence: float
    where: str  # a sentence: where the model without it was wrong
    parameters: dict[str, tuple[float, float]]  # value and standard error, in the final model
    alternatives: tuple[Alternative, ...]  # best first
    ambiguous_with: tuple[str, ...]  # effects that explain as much in this recording
    suggested_experiment: str  # a profile that would tell them apart; empty if none is needed
    sensor_may_lag: bool = False  # a lag that speeds leave, too, which were smoothed or late before they were logged
    beside_torque: bool = False  # the model without it was fitted beside a random torque
    given_up: tuple[str, ...] = ()  # effects that the model without it had, and the final one has not

    @property
    def has_size(self) -> bool:
        """Whether the recordings determine any of its parameters; and where there is but one, as more than none."""
        own = [spec for spec in EFFECT_BY_NAME[self.effect].parameters if not spec.of_recording]
        if len(own) == 1 and own[0].name in self.parameters:
            value, error = self.parameters[own[0].name]
            if isfinite(error) and abs(value - own[0].off) < NO_SIZE * error:
                return False
        return not self.parameters or any(isfinite(error) for _, error in self.parameters.values())


def list_vague(findings: Sequence[Finding]) -> list[Finding]:
    """List findings of which no parameter is determined; not what another one that is cannot be without."""
    needed = {EFFECT_BY_NAME[one.effect].implies for one in findings if one.has_size}
    return [one for one in findings if not one.has_size and one.effect not in needed]


@dataclass(frozen=True)
class Nearest:
    """Effects of the table that come nearest to a recording in which something else is missing; they may stand in."""

    effects: tuple[str, ...]
    gap: float  # [rad/s] with them


@dataclass(frozen=True)
class Imitated:
    """An effect that a recording could not have shown, since beside it kv would be another, and all else as it is."""

    effect: str
    size: float  # that matters, of its first parameter
    kv: float  # [V·s/rad] that the motor would have beside it


@dataclass(frozen=True)
class Diagnosis:
    """Verdict, findings, and the model with them; gaps in rad/s on held-out data."""

    verdict: Verdict
    findings: tuple[Finding, ...]
    baseline: Fit  # with the effects that were known before
    model: Fit
    gap_before: float
    gap_after: float
    noise_floor: float  # what sensor, random torque and the gains of the runs leave together
    sensor_floor: float  # what the sensor alone leaves
    disturbance: Disturbance | None  # the random torque, where there is one
    structure: tuple[Structure, ...]  # what free curves still predict, the most telling variable first
    undetectable: tuple[str, ...]  # effects that this recording could not have shown
    suggested_experiment: str
    before: HeldOut  # the baseline on held-out data
    after: HeldOut
    slot_share: float  # of the sensor's unit: irregular slots, or a logged speed's noise beside what is known of it
    bags: tuple[str, ...]
    validation: tuple[str, ...]
    miscounted: int  # intervals that were left out because edges were missed
    left_out: int  # intervals with a reversal
    trace: Floats  # [rad/s] the gap after each step, the first entry before any
    duration: float  # [s]
    undetermined: tuple[str, ...] = ()  # effects that would explain more, of which this recording determines nothing
    nearest: Nearest | None = None  # where nothing explains the gap, but something takes away most of it
    gain_scatter: float = 0.0  # standard deviation of the runs' gains, as of a supply that differs; 0 where they agree
    imitated: Imitated | None = None  # of what could not be shown, what would make kv another by most
    undriven: Undriven | None = None  # a motor that ran on at 0 V, of which no effect is looked for
    time_limit: float = 0.0  # [s] that ended the search before everything was tried; 0 where none did

    @property
    def leaves_more(self) -> bool:
        """Whether more is left than the sensor leaves, that no random torque makes."""
        return self.gap_after > EXPLAINED_GAP * self.sensor_floor and self.disturbance is None

    @property
    def is_unpredicted(self) -> bool:
        """Whether more is left than the sensor leaves, that no random torque makes and nothing measured predicts."""
        return self.leaves_more and not any(one.certain for one in self.structure)

    @property
    def is_of_no_motor(self) -> bool:
        """Whether kv ended at the limit of what is searched: no motor moves like this, and what it lacks is unsure."""
        return self.model.on_bound.get("kv", False)
