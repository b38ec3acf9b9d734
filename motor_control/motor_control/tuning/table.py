"""Format a tuning as text: gains, margins, predictions, limits of the time constant, cautions."""

from math import isfinite

from motor_control.tuning.design import Tuning
from motor_control.tuning.speed_feedback import OBSERVER
from motor_model.parameters import Parameters
from motor_model.text_table import align_columns

RIPPLE = ("speed [rad/s]", "shaft [%]", "reported [%]", "voltage [V]")
FRICTION = (
    "The model has {:.3g} V of friction, which these gains do not compensate. With '--speed-source observer' the "
    "feed-forward does."
)
BEYOND = (
    "At this time constant the disc causes {:.3g} % speed ripple. A time constant of {:.3g} ms keeps it at {:.3g} %."
)
TRUST = (
    "These margins assume that the model is exact. The loop oscillates where gain or delay of the real motor differ "
    "from the model's by more than the margins."
)


def as_table(tuning: Tuning) -> str:
    """Format three tables: gains with their predictions, ripple over the speed, limits of the time constant."""
    margins, large = tuning.margins, tuning.large_step
    rows = (
        ("kp", f"{tuning.gains.kp:.4g}", "V/(rad/s)"),
        ("ki", f"{tuning.gains.ki:.4g}", "V/rad"),
        ("closed-loop time constant", f"{1e3 * tuning.time_constant:.3g}", "ms to 63 % of a small step"),
        ("gain margin", _finite(margins.gain_db, ".1f"), "dB"),
        ("phase margin", _finite(margins.phase, ".0f"), "deg"),
        ("delay margin", _finite(1e3 * margins.delay, ".3g"), "ms"),
        ("overshoot, small step", f"{100 * tuning.step.overshoot:.1f}", "%"),
        (f"overshoot, 0 to {large.reference:.3g} rad/s", f"{100 * large.overshoot:.1f}", "% with the voltage limit"),
    )
    return "\n\n".join((align_columns(rows), _format_ripple(tuning), _format_bounds(tuning)))


def cautions(tuning: Tuning, parameters: Parameters) -> list[str]:
    """List sentences about what the numbers alone do not say."""
    said = []
    ripple = max(ripple.speed for _, ripple in tuning.ripples)
    if ripple > 1.01 * tuning.wish.oscillation:
        said.append(BEYOND.format(100 * ripple, 1e3 * tuning.bounds[-1].time_constant, 100 * tuning.wish.oscillation))
    friction = max(parameters.value("ks"), parameters.value("breakaway_voltage"))
    if tuning.wish.source == OBSERVER:
        said.append(TRUST)
    elif friction > 0.0:
        said.append(FRICTION.format(friction))
    return said


def _format_ripple(tuning: Tuning) -> str:
    encoder = tuning.sight.encoder
    title = (
        f"Steady-state ripple from encoder errors ({100 * encoder.slot_irregularity:.3g} % slots, "
        f"{1e6 * encoder.edge_resolution:.3g} µs timer), peak to peak:"
    )
    rows = [
        (f"{speed:.4g}", f"{100 * ripple.speed:.2f}", f"{100 * ripple.reported:.2f}", f"{ripple.voltage:.3f}")
        for speed, ripple in tuning.ripples
    ]
    return f"{title}\n{align_columns([RIPPLE, *rows])}"


def _format_bounds(tuning: Tuning) -> str:
    rows = [(bound.name, f"{1e3 * bound.time_constant:.3g} ms") for bound in tuning.bounds]
    return f"Lower limits of the closed-loop time constant (cumulative):\n{align_columns(rows)}"


def _finite(value: float, form: str) -> str:
    return format(value, form) if isfinite(value) else "none"
