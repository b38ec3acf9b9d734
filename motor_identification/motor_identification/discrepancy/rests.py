"""List what a fitted motor leaves in recordings, each with its motion: what free curves are learnt on and judged by."""

from collections.abc import Sequence
from functools import partial

import numpy as np

from motor_identification.discrepancy.motion_history import make_history
from motor_identification.discrepancy.rest import Rest
from motor_identification.estimation.estimate import Estimate
from motor_identification.measurement.intervals import Intervals
from motor_identification.measurement.time_blocks import TimeBlocks
from motor_identification.noise.error_data import ErrorData
from motor_identification.recording import Bools, Floats, Recording
from motor_identification.validation.held_out import HeldOut
from motor_model.parameters import Parameters

CURVE_BLOCKS = TimeBlocks(4)  # that curves are judged by where nothing is held out


def list_training_rests(estimate: Estimate, errors: Sequence[ErrorData]) -> list[Rest]:
    """List what an estimate leaves in its training data (`errors` of each), none of it to be judged by."""
    problem = estimate.problem
    nothing = [np.zeros(len(data.first), dtype=bool) for data in problem.intervals]
    moved = problem.recordings, problem.intervals, estimate.angles, estimate.increments
    return [_make_rest(estimate.parameters, *row) for row in zip(*moved, errors, nothing, strict=True)]


def list_held_rests(estimate: Estimate, held: HeldOut, errors: Sequence[ErrorData]) -> list[Rest]:
    """List what an estimate leaves in held-out data; of what a fit has seen, curves are learnt on the other part."""
    judged: Sequence[Bools] = held.scored
    if held.seen:  # by the fit, not by a curve
        blocks = CURVE_BLOCKS.mark_each(held.intervals, estimate.problem.sample_period)
        judged = [block & scored for block, scored in zip(blocks, held.scored, strict=True)]
    moved = held.recordings, held.intervals, held.angles, held.increments
    return [_make_rest(estimate.parameters, *row) for row in zip(*moved, errors, judged, strict=True)]


def are_parts_held_out(estimate: Estimate, held: HeldOut) -> bool:
    """Decide whether what is held out is of the recordings that an estimate was fitted to."""
    return all(a is b for a, b in zip(held.recordings, estimate.problem.recordings, strict=False))


def _make_rest(
    motor: Parameters,
    recording: Recording,
    data: Intervals,
    angle: Floats,
    increments: Floats,
    errors: ErrorData,
    judged: Bools,
) -> Rest:
    """Make the rest of one recording; angle: [rad] simulated, increments: (I,) [rad] that the motor leaves.

    errors: what of that is to be predicted.
    """
    moved = motor.value("kv"), motor.values.get("delay", 0.0)
    speeds = data.speed + increments / data.duration  # of the model
    return Rest(
        errors=errors,
        history=make_history(recording, data, angle, *moved),
        simulated=partial(make_history, recording, data, angle, *moved, speeds),
        learnt=~judged,
        judged=judged,
        slot=data.slot * data.gear if data.tells_of_disc else 0.0,
    )
