"""What the controller answers to a sample: state, reason, and every term of the voltage."""

from dataclasses import dataclass
from math import nan

from motor_control.controller.pi import Terms

RUNNING, DISABLED, NO_SAMPLES, STOPPED = "running", "disabled", "no_samples", "stopped"


@dataclass(frozen=True)
class Output:
    """The answer to one sample, or to silence."""

    state: str
    reason: str
    reference: float  # [rad/s] behind the rate limit; NaN: none
    speed: float  # [rad/s] that the law used; NaN: none
    terms: Terms
    speed_sigma: float = nan  # [rad/s] NaN: measured, not estimated
    innovation: float = nan  # [rad] angle at the latest edge less the observer's prediction
    warning: bool = False  # somebody should read the reason
    fault: str = ""  # why the motor has to stop for good
    latency: float = nan  # [s] age of the sample; NaN: there was none
    drives: bool = False  # the voltage is to be sent: without a reference the motor is left to others
    begins: bool = False  # 0 V is to be sent before it: a plant drives with what begins at 0 V


def halt(state: str, reason: str, reference: float, speed: float) -> Output:
    """Answer 0 V, with a sentence that says why."""
    return Output(state, reason, reference, speed, Terms(reference - speed, 0.0, 0.0, 0.0, 0.0, False))
