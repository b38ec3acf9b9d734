"""Find standstills: times without an edge are evidence that the motor moved less than a slot."""

from math import sqrt

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from motor_identification.measurement.edges import Edges
from motor_identification.measurement.sampled_counts import Changes
from motor_identification.recording import Bools, Floats, Recording

LEAST_STANDSTILL = 20.0  # sample periods without an edge before the lack of edges is evidence
# Standard deviations of noise: how far apart the angles of so many rows at rest are, and of the means of their halves.
REST_RANGE, REST_DRIFT = 7.0, 4.0
REST_SWING = 4.0  # of such means, as far as they are apart in a rest. Measured: 2.6 in 100,000 rows of noise, 5.4 of ±2
REST_ROWS = 3.0  # times as many rows at rest: a slow motion is as calm in fewer now and then


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


def find_standstills_of_noisy_angles(time: Floats, angle: Floats, noise: float) -> tuple[Floats, Floats]:
    """Find start and end [s] of times in which angles, shape (K,), differ by noise alone; noise: in the same unit."""
    rows = round(LEAST_STANDSTILL)
    if len(angle) <= rows:
        return np.zeros(0), np.zeros(0)
    half = rows // 2
    window = sliding_window_view(angle, rows)
    least = REST_DRIFT * noise * sqrt(2.0 / half)
    calm = np.abs(window[:, half:].mean(axis=1) - window[:, :half].mean(axis=1)) < least
    calm &= np.ptp(window, axis=1) < REST_RANGE * noise
    rests = np.convolve(calm, np.ones(rows)) > 0.0  # rows of any such window
    edges = np.diff(np.concatenate([[0], rests.astype(np.int8), [0]]))
    begin, end = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    long = end - begin >= REST_ROWS * rows
    # What moves by a part of the noise may be among the first rows and the last.
    begin = np.where(begin > 0, begin + half, begin)[long]
    end = np.where(end < len(angle), end - half, end)[long]
    spans = [slice(int(i), int(j)) for i, j in zip(begin, end, strict=True)]
    stays = np.array([_stays(angle[span], half, noise) for span in spans], dtype=bool)
    return time[begin[stays]], time[end[stays] - 1]


def _stays(angle: Floats, half: int, noise: float) -> bool:
    """Decide whether a shaft stays where it is: at its end where it began, and nowhere else between."""
    means = np.convolve(angle, np.full(half, 1.0 / half), mode="valid")
    ends = abs(float(means[-1] - means[0])) < REST_DRIFT * noise * sqrt(2.0 / half)
    return ends and float(np.ptp(means)) < REST_SWING * noise
