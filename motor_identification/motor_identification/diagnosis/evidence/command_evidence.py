"""Evidence that a motion goes by its command: a model of the command alone explains some of its variation.

A random torque is learned from what a model leaves, however much that is. Where the columns of voltage and motion do
not belong together, or rows were lost, all of the motion is such a torque, and its gap at the floor.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from motor_identification.diagnosis.candidate_model import find_lasting_interval
from motor_identification.discrepancy.free_curves import BY_TIME
from motor_identification.discrepancy.structure import Structure
from motor_identification.measurement.command_swing import is_sweep
from motor_identification.validation.held_out import HeldOut

# Of the variance of what lasts in the speed that a model has to explain, if the command varies by as much of its
# largest value (RMS) and what is left is as much of the speed (RMS). Measured: 0.5 and more where a torque of 0.3 V
# shook a motor of 12 V; below 0 of a program that logged another signal as its command.
LEAST_EXPLAINED, VARIES, MATTERS = 0.25, 0.1, 0.1


@dataclass(frozen=True)
class Ignored:
    """A motion that hardly follows its command."""

    gap: float  # [rad/s] what the model leaves of what lasts
    variation: float  # [rad/s] standard deviation of the measured speeds that last


def find_ignored(held: HeldOut) -> Ignored | None:
    """Find whether what lasts in a motion has next to nothing to do with its command."""
    if not held.counted.any() or not _varies(held):
        return None
    lasting = held.joined(find_lasting_interval(held))
    if len(lasting.residuals) < 2:
        return None
    speed, weight = np.concatenate([data.speed for data in lasting.intervals]), lasting.weight
    mean = float(weight @ speed)
    variation = float(np.sqrt(weight @ (speed - mean) ** 2))
    explained = lasting.gap**2 < (1.0 - LEAST_EXPLAINED) * variation**2
    small = lasting.gap < MATTERS * float(np.hypot(mean, variation))
    return None if explained or small else Ignored(lasting.gap, variation)


def goes_with_sweep(structure: Sequence[Structure], held: HeldOut) -> bool:
    """Decide whether what is left goes with the time, most of all, under sweeps, in which that is the frequency too."""
    certain = [one for one in structure if one.certain]
    by_time = bool(certain) and certain[0].variable == BY_TIME and not certain[0].cause
    return by_time and bool(held.recordings) and all(map(is_sweep, held.recordings))


def _varies(held: HeldOut) -> bool:
    """Decide whether the command of any recording varies enough to move a motor otherwise than evenly."""
    return any(np.std(one.voltage) > VARIES * np.max(np.abs(one.voltage)) for one in held.recordings)
