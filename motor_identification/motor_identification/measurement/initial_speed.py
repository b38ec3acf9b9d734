"""Estimate the initial speed of a recording: whether the motor turned already, by what its first edges say.

A motor that stood needs a voltage and time to gain speed, so that its first edges, followed back along a parabola to
the moment when a voltage first could act, come from no speed. A motor that turned came from one. The reported speed of
the first sample does not tell: a board that was just switched on has seen no edge yet, and reports none.
"""

import numpy as np

from motor_identification.measurement.edges import extract_edges, read_directions
from motor_identification.measurement.sampled_counts import extract_count_changes, locate_fixes
from motor_identification.recording import Floats, Recording
from motor_identification.sensor.white_noise import estimate_white_noise
from motor_model.sample import Measurement

HEAD_SAMPLES = 400  # samples in which the beginning shows
PARABOLA_EDGES = 6  # edges that are followed back
LEAST_SPEED_SHARE = 0.5  # of their mean speed, left at the beginning: from rest it is none, or a quarter after one τ
MOST_SLOTS_OFF = 0.75  # slots that the parabola may lead beside the middle of the slot in which the disc was
SURE = 4.0  # standard deviations of noise, which a speed at rest does not reach
PARABOLA_ROWS = (6, 12, 24, 48)  # rows of logged speeds that a parabola is laid through
MOST_LEFT = 1.5  # times the noise: what a parabola leaves that fits
MOST_SHARE_OFF = 0.05  # of the slots up to the last of those edges: as much beside, since no motion is a parabola


def estimate_initial_speed(recording: Recording) -> float:
    """Estimate the speed [rad/s] of a motor that turned at the first sample; 0 for one that stood, or may have."""
    info, reported = recording.info, float(recording.speed[0])
    if info.measurement is Measurement.SPEED:
        return reported if _exceeds_noise(recording) else 0.0
    if reported != 0.0 and not (info.source == "import" and info.measurement is Measurement.COUNTS):
        return reported
    head = recording.between(0.0, float(recording.time[min(HEAD_SAMPLES, len(recording) - 1)]))
    time, place = _passed(head)
    speed = _followed_back(time, place, _first_voltage(head)) if len(time) > 3 else 0.0
    return speed * _way(head) * info.edge_angle


def _exceeds_noise(recording: Recording) -> bool:
    """Whether the first of logged speeds, or a parabola through the first few, is beyond what noise makes of none.

    A parabola that does not fit is that of a motor that starts.
    """
    values, voltage = recording.speed[:HEAD_SAMPLES], recording.voltage[:HEAD_SAMPLES]
    noise = estimate_white_noise(values, voltage)
    if values[0] == 0.0 or abs(values[0]) > SURE * noise:
        return bool(values[0] != 0.0)
    for rows in PARABOLA_ROWS:
        basis = np.vander(np.arange(min(rows, len(values))), 3, increasing=True)
        covariance = np.linalg.inv(basis.T @ basis)
        parabola = covariance @ basis.T @ values[: len(basis)]
        left = float(np.sqrt(np.mean((values[: len(basis)] - basis @ parabola) ** 2)))
        if abs(parabola[0]) > SURE * noise * np.sqrt(covariance[0, 0]) and left < MOST_LEFT * noise:
            return True
    return False


def _passed(recording: Recording) -> tuple[Floats, Floats]:
    """When [s] the disc was where [slots], at the first edges or changes of the count."""
    if recording.info.measurement is Measurement.EDGES:
        edges = extract_edges(recording)
        time, place = edges.time, np.abs(edges.count).astype(np.float64)
    else:
        fixes = locate_fixes(recording, extract_count_changes(recording))
        time, place = fixes.time[fixes.time > 0.0], fixes.place[fixes.time > 0.0]
    return time[:PARABOLA_EDGES], place[:PARABOLA_EDGES]


def _followed_back(time: Floats, place: Floats, begin: float) -> float:
    """[slots/s] at the beginning, where a parabola through the first edges says that there was speed; else 0.

    Edges before `begin` [s], the first voltage, need no parabola. It must also lead back to the slot in which the disc
    was: a motor that stood and has long gained its speed shows its edges later than one that had it already.
    """
    if np.count_nonzero(time <= begin) >= 2:
        free = time <= begin
        return float((place[free][-1] - place[free][0]) / (time[free][-1] - time[free][0]))
    mean = (place[-1] - place[0]) / (time[-1] - time[0])
    _, slope, was = np.polyfit(time - begin, place, 2)
    near = abs(was - 0.5) <= max(MOST_SLOTS_OFF, MOST_SHARE_OFF * place[-1])
    return float(slope) if slope > LEAST_SPEED_SHARE * mean and near else 0.0


def _first_voltage(recording: Recording) -> float:
    """[s] when there was one; the end of the recording where there was none."""
    driven = np.flatnonzero(recording.voltage)
    return float(recording.time[driven[0]] if len(driven) else recording.time[-1])


def _way(recording: Recording) -> int:
    """Which way the disc first turned."""
    if not recording.info.single_channel:
        steps = np.diff(recording.edge_count)
        return int(np.sign(steps[np.flatnonzero(steps)[0]])) if np.any(steps) else 0
    signs = read_directions(recording.speed)
    return int(signs[np.flatnonzero(signs)[0]]) if np.any(signs) else 0
