"""Hold what a model leaves in a recording, with the motion that it left it in; and what its disc alone would leave."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import tau

import numpy as np

from motor_identification.discrepancy.motion_history import MotionHistory
from motor_identification.noise.error_data import ErrorData
from motor_identification.noise.error_model import ErrorModel
from motor_identification.noise.slots.first_harmonic import bound_chance_eccentricity
from motor_identification.recording import Bools, Floats

ROBUST = 4.0  # standard deviations: beyond, a white residual counts linearly


@dataclass(frozen=True)
class Rest:
    """What a model leaves in one recording, with the motion's history; masks of shape (I,)."""

    errors: ErrorData
    history: MotionHistory
    simulated: Callable[[], MotionHistory]  # with the model's speeds, which no random torque is in
    learnt: Bools  # intervals that curves may be learnt on
    judged: Bools  # others, that they are judged by
    slot: float = 0.0  # [rad] of the encoder's disc; 0 where there is none

    @property
    def speeds(self) -> Floats:
        """[rad/s] simulated less measured mean speed."""
        return np.asarray(self.errors.increments / self.errors.duration)


def make_up_disc(rest: Rest, model: ErrorModel) -> Rest:
    """Make up what a disc leaves that is as irregular as a model's, and as eccentric as chance may have it at most."""
    errors, history = rest.errors, rest.history
    if rest.slot == 0.0:
        return replace(rest, errors=replace(errors, increments=np.zeros_like(errors.increments)))
    count = max(round(tau / rest.slot), 1)
    flanks = model.share * errors.unit * np.random.default_rng(0).standard_normal(count)
    ends = np.append(history.angle, history.angle[-1:])  # to half a segment
    wave = bound_chance_eccentricity(rest.slot, model.share) * errors.unit / rest.slot * np.sin(ends)
    error = flanks[np.rint(ends / rest.slot).astype(np.int64) % count] + wave
    return replace(rest, errors=replace(errors, increments=error[history.at_end] - error[history.at_start]))
