"""Find standstills: times without an edge are evidence that the motor moved less than a slot."""

import numpy as np

from motor_identification.measurement.edges import Edges
from motor_identification.measurement.sampled_counts import Changes
from motor_identification.recording import Bools, Floats, Recording

LEAST_STANDSTILL = 20.0  # sample periods without an edge before the lack of edges is evidence


def find_standstills_at_edges(recording: Recording, edges: Edges, open_ones: Bools) -> tuple[Floats, Floats]:
    """Find start and end [s] of times before the first and after the last edge, and from edge to edge at a turn.

    `open_ones`, shape (E − 1,), marks the intervals between edges that say nothing of speed.
    """
    bounds = np.concatenate([[0.0], edges.time, [recording.time[-1]]])
    start, end = bounds[:-1], bounds[1:].copy()
    end[0] = min(end[0], _until_the_first(recording))  # several edges may pass before the first one that is reported
    next_one = np.abs(np.diff(edges.count)) <= 1
    told = np.concatenate([[True], open_ones & next_one, [True]]) if len(edges.time) else np.array([True])
    long = told & (end - start > LEAST_STANDSTILL * recording.sample_period)
    return start[long], end[long]


def _until_the_first(recording: Recording) -> float:
    """[s] of the last sample before any edge."""
    counted = np.flatnonzero(recording.edge_count != recording.edge_count[0])
    return float(recording.time[counted[0] - 1] if len(counted) else recording.time[-1])


def find_standstills_at_reversals(recording: Recording, changes: Changes) -> tuple[Floats, Floats]:
    """Find start and end [s] of the times around a turn in which the count does not change."""
    turned = np.flatnonzero(np.diff(changes.run) != 0)
    start, end = recording.time[changes.sample[turned]], recording.time[changes.sample[turned + 1] - 1]
    long = end - start > LEAST_STANDSTILL * recording.sample_period
    return start[long], end[long]
