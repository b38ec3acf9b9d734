"""List what a fitted motor leaves in recordings, each with its motion: what free curves are learnt on and judged by."""

from collections.abc import Sequence
from functools import partial

import numpy as np

from motor_identification.discrepancy.motion_history import make_history
from motor_identification.discrepancy.rest import Rest
from motor_identification.estimation.estimate import Estimate
from motor_identification.measurement.intervals import Intervals
from motor_identification.measurement.time_blocks import TimeBlocks
from motor_identification.noise.error_data import make_error_data
from motor_identification.recording import Bools, Floats, Recording
from motor_identification.validation.held_out import HeldOut
from motor_model.parameters import Parameters

CURVE_BLOCKS = TimeBlocks(4)  # that curves are judged by where nothing is held out


def list_training_rests(estimate: Estimate) -> list[Rest]:
    """List what an estimate leaves in its training data, none of it to be judged by."""
    problem = estimate.problem
    nothing = [np.zeros(len(data.first), dtype=bool) for data in problem.intervals]
    rows = zip(problem.recordings, problem.intervals, estimate.angles, estimate.increments, nothing, strict=True)
    return [_make_rest(estimate.parameters, *row) for row in rows]


def list_held_rests(estimate: Estimate, held: HeldOut) -> list[Rest]:
    """List what an estimate leaves in held-out data; of what a fit has seen, curves are learnt on the other part."""
    judged: Sequence[Bools] = held.scored
    if held.seen:  # by the fit, not by a curve
        blocks = CURVE_BLOCKS.mark_each(held.intervals, estimate.problem.sample_period)
        judged = [block & scored for block, scored in zip(blocks, held.scored, strict=True)]
    rows = zip(held.recordings, held.intervals, held.angles, held.increments, judged, strict=True)
    return [_make_rest(estimate.parameters, *row) for row in rows]


def list_other_rests(estimate: Estimate, held: HeldOut) -> list[Rest]:
    """List what an estimate leaves in the recordings that it was fitted to alone; none where parts are held out."""
    recordings = estimate.problem.recordings
    same = all(a is b for a, b in zip(held.recordings, recordings, strict=False))
    return [] if same else list_training_rests(estimate)


def _make_rest(
    motor: Parameters, recording: Recording, data: Intervals, angle: Floats, increments: Floats, judged: Bools
) -> Rest:
    """Make the rest of one recording; angle: [rad] simulated, increments: (I,) [rad] that are left."""
    moved = motor.value("kv"), motor.values.get("delay", 0.0)
    speeds = data.speed + increments / data.duration  # of the model
    return Rest(
        errors=make_error_data(data, increments),
        history=make_history(recording, data, angle, *moved),
        simulated=partial(make_history, recording, data, angle, *moved, speeds),
        learnt=~judged,
        judged=judged,
        slot=data.slot * data.gear if data.tells_of_disc else 0.0,
    )
