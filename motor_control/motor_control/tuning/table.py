"""What `tune` prints: gains, margins, predictions, what bounds the loop, and what to be careful about."""

from math import isfinite

from motor_control.tuning.design import Tuning
from motor_control.tuning.speed_feedback import OBSERVER
from motor_model.parameters import Parameters

SWINGS = "speed [rad/s]  shaft swings [%]  reported [%]  voltage [V]"
FRICTION = (
    "The model has {:.3g} V of friction that these gains know nothing of; '--speed-source observer' writes it into the "
    "feed-forward."
)
BEYOND = "At this time constant the disc makes the shaft swing by {:.3g} % of the speed; {:.3g} ms keep it to {:.3g} %."
TRUST = (
    "These numbers take the model for the motor. Gain and delay of the real one may differ from it by the margins "
    "before the loop oscillates; the step is the model's own."
)


def as_table(tuning: Tuning) -> str:
    """Three tables: the gains and what they predict, swings over the speed, what keeps the loop from being faster."""
    margins, large = tuning.margins, tuning.large_step
    rows = (
        ("kp", f"{tuning.gains.kp:.4g}", "V/(rad/s)"),
        ("ki", f"{tuning.gains.ki:.4g}", "V/rad"),
        ("closed-loop time constant", f"{1e3 * tuning.time_constant:.3g}", "ms, 63 % of a small step"),
        ("gain margin", _finite(margins.gain_db, ".1f"), "dB"),
        ("phase margin", _finite(margins.phase, ".0f"), "deg"),
        ("delay margin", _finite(1e3 * margins.delay, ".3g"), "ms"),
        ("overshoot of a small step", f"{100 * tuning.step.overshoot:.1f}", "%"),
        (f"overshoot of 0 to {large.reference:.3g} rad/s", f"{100 * large.overshoot:.1f}", "%, within the voltage"),
    )
    width = max(len(name) for name, _, _ in rows) + 2
    lines = [f"{name:{width}}{value:9}{unit}".rstrip() for name, value, unit in rows]
    return "\n".join([*lines, "", *_swings(tuning), "", *_bounds(tuning)])


def cautions(tuning: Tuning, parameters: Parameters) -> list[str]:
    """Sentences about what the numbers alone do not say."""
    said = []
    swing = max(ripple.speed for _, ripple in tuning.ripples)
    if swing > 1.01 * tuning.wish.oscillation:
        said.append(BEYOND.format(100 * swing, 1e3 * tuning.bounds[-1].time_constant, 100 * tuning.wish.oscillation))
    friction = max(parameters.value("ks"), parameters.value("breakaway_voltage"))
    if tuning.wish.source == OBSERVER:
        said.append(TRUST)
    elif friction > 0.0:
        said.append(FRICTION.format(friction))
    return said


def _swings(tuning: Tuning) -> list[str]:
    encoder = tuning.sight.encoder
    lines = [
        f"What slots irregular by {100 * encoder.slot_irregularity:.3g} % and a timer of "
        f"{1e6 * encoder.edge_resolution:.3g} µs make of a constant reference, peak to peak:",
        SWINGS,
    ]
    for speed, ripple in tuning.ripples:
        swing, reported = 100 * ripple.speed, 100 * ripple.reported
        lines.append(f"{speed:<15.4g}{swing:<18.2f}{reported:<14.2f}{ripple.voltage:.3f}")
    return lines


def _bounds(tuning: Tuning) -> list[str]:
    lines = ["what bounds the time constant from below, each with those above it"]
    width = max(len(bound.name) for bound in tuning.bounds) + 2
    lines += [f"{bound.name:{width}}{1e3 * bound.time_constant:.3g} ms" for bound in tuning.bounds]
    return lines


def _finite(value: float, form: str) -> str:
    return format(value, form) if isfinite(value) else "none"
