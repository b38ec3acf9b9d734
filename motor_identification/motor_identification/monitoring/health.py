"""Judge a motor's health from window to window: it fits its model, drifts away from it, or does something else."""

from dataclasses import dataclass, replace
from enum import Enum
from math import inf

from motor_identification.monitoring.model_gap import Change, Gap, Model
from motor_identification.reporting.numbers import format_error, format_unit, format_value

# Times what the identification (or the sensor) left: 60 windows of 10 s of an unchanged motor had 0.97 to 1.16 of it,
# beside a sensor's noise; a disturbance that comes and goes has more of a spread.
DRIFTING_RATIO = 2.0
# Of the RMS speed that the residual is: what a model misses by half of that is not this motor's motion (blocked,
# disabled, unplugged, reversed, another motor).
BROKEN_SHARE = 0.5
# Windows in a row, half of each new, that say the same before it is believed: one may hold a hand on the wheel.
CONFIRMATIONS = 2
MOVING_RATIO = 3.0  # times the expected residual, below which a speed says nothing about the motor
STILL_SHARE = 0.05  # of the top speed, from which on a model that moves beside a motor that stands means anything
SHORT = 0.4  # of a window, below which there is too little of it yet: half is there when it is first judged

FITS = "The motor fits its model: {}."
DRIFTS = "The motor no longer fits its model: {}.{} Look for what has changed, or identify it again."
BREAKS = (
    "The motor does not move as its model says: {}, and it should run at {:.3g}. Is it blocked, disabled, unplugged or "
    "reversed, or is this another motor's model?"
)
STANDS = "The motor stands, though its model would run at {:.3g} rad/s RMS: is it blocked, disabled or unplugged?"
AT_REST = "The motor stands, as its model does: nothing can be said of it."
TOO_LITTLE = "Heard {:.1f} s of motion so far, of {:g} s."
RESIDUAL = "residual {:.3g} rad/s RMS in {:.3g} s, {:.3g} expected, at {:.3g} rad/s RMS"
CHANGED = " Now {}."


class State(Enum):
    """What is known of a motor, in the words of `MotorHealth`."""

    UNKNOWN = "unknown"
    FITS = "fits"
    DRIFTING = "drifting"
    BROKEN = "broken"


@dataclass(frozen=True)
class Limits:
    """What a user can choose."""

    window: float = 10.0  # [s] of motion that is compared
    tolerance: float = 0.05  # of the RMS speed: residuals below it are no drift, however small the noise


@dataclass(frozen=True)
class Verdict:
    """What one window says."""

    state: State
    sentence: str
    gap: Gap | None = None
    changes: tuple[Change, ...] = ()


@dataclass(frozen=True)
class Health:
    """What is believed after all windows so far; times are [ns] on the caller's clock."""

    verdict: Verdict = Verdict(State.UNKNOWN, "Nothing was heard yet.")
    since: int = 0
    candidate: State = State.UNKNOWN
    confirmed: int = 0  # windows in a row that said the candidate


def judge_gap(gap: Gap, model: Model, limits: Limits) -> Verdict:
    """Judge one window by how far the model is from the motion."""
    if gap.duration < SHORT * limits.window:
        return Verdict(State.UNKNOWN, TOO_LITTLE.format(gap.duration, limits.window), gap)
    if gap.estimate is None:
        return _judge_still(gap, model)
    largest = max(gap.measured, gap.predicted)
    if largest < MOVING_RATIO * gap.expected:
        return Verdict(State.UNKNOWN, AT_REST, gap)
    said = RESIDUAL.format(gap.rms, gap.duration, gap.expected, gap.measured)
    if gap.rms > BROKEN_SHARE * largest:
        return Verdict(State.BROKEN, BREAKS.format(said, gap.predicted), gap)
    if gap.rms > max(DRIFTING_RATIO * gap.expected, limits.tolerance * largest):
        return Verdict(State.DRIFTING, DRIFTS.format(said, ""), gap)
    return Verdict(State.FITS, FITS.format(said), gap)


def _judge_still(gap: Gap, model: Model) -> Verdict:
    top = model.parameters.max_voltage * model.parameters.gain
    if gap.predicted > max(MOVING_RATIO * gap.expected, STILL_SHARE * top):
        return Verdict(State.BROKEN, STANDS.format(gap.predicted), gap)
    return Verdict(State.UNKNOWN, AT_REST, gap)


def add_changes(verdict: Verdict, changes: tuple[Change, ...]) -> Verdict:
    """Add to a drifting motor's verdict which of its parameters have changed."""
    if verdict.gap is None or not changes:
        return verdict
    gap = verdict.gap
    said = RESIDUAL.format(gap.rms, gap.duration, gap.expected, gap.measured)
    rows = CHANGED.format("; ".join(map(_describe, changes)))
    return replace(verdict, sentence=DRIFTS.format(said, rows), changes=changes)


def _describe(change: Change) -> str:
    unit = format_unit(change.name) and f" {format_unit(change.name)}"
    value, error = format_value(change.value, change.error), format_error(change.error)
    return f"{change.name} = {value} ± {error}{unit} (was {change.was:.4g})"


def update_health(before: Health, verdict: Verdict, now: int) -> Health:
    """Take a window's verdict in; a change of state is believed once it is confirmed, or where nothing was known.

    A motor that rests keeps the last state that was seen: standing, it is neither better nor worse.
    """
    if verdict.state is State.UNKNOWN and verdict.gap is not None and before.verdict.state is not State.UNKNOWN:
        return replace(before, candidate=State.UNKNOWN, confirmed=0)
    if verdict.state is before.verdict.state:
        return replace(before, verdict=verdict, candidate=verdict.state, confirmed=0)
    confirmed = before.confirmed + 1 if verdict.state is before.candidate else 1
    at_once = verdict.gap is None or verdict.state is State.FITS and before.verdict.state is State.UNKNOWN
    if at_once or confirmed >= CONFIRMATIONS:
        return Health(verdict, now, verdict.state, 0)
    return replace(before, candidate=verdict.state, confirmed=confirmed)


def ratio_of(gap: Gap | None) -> float:
    """RMS residual over what is expected of it; infinite where nothing is, NaN without a window."""
    if gap is None:
        return float("nan")
    return gap.rms / gap.expected if gap.expected > 0.0 else inf
