"""Steady states, a voltage and the speed it leads to in every row, as the staircase that would have shown them.

A static curve has no time, but it says what no dynamic recording says as well: how friction and gain share the voltage.
Each row becomes a stair so long that any motor has settled, and its speed the mean over the stair's end. How the motor
got there is not compared with anything.
"""

from dataclasses import dataclass, replace
from math import tau

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.count_size import MOST_EDGES
from motor_identification.logs.form import CsvForm
from motor_identification.recording import STEADY_HOLD
from motor_model.errors import RecordingError
from motor_model.sample import Info, Measurement, Sample

Floats = NDArray[np.float64]

HOLD = STEADY_HOLD  # [s] so short that drag is still quick to simulate
LONGEST = 0.25 * HOLD  # [s] that a speed may be the mean over
WINDOW = 1.0  # [s] that it is taken to be


@dataclass(frozen=True)
class Steady:
    """The samples of every run, with the info that says how to read them."""

    samples: tuple[tuple[Sample, ...], ...]
    info: Info
    findings: tuple[str, ...]


def read_steady(form: CsvForm, info: Info, voltage: Floats, speed: Floats, runs: list[slice]) -> Steady:
    """What rows of `voltage` [V] and `speed` (in the form's unit), each of shape (K,), say.

    Raises:
        RecordingError: the speeds are means over more time than a state is held for.
    """
    window = form.speed_window or WINDOW
    if window > LONGEST:
        raise RecordingError(f"A steady speed may be the mean over {LONGEST:g} s at most: reduce --speed-window.")
    unit = form.unit_size or 1.0
    info = replace(
        info,
        measurement=Measurement.SPEED,
        sample_period=HOLD,
        speed_window=window,
        speed_lag=0.5 * window,
        edges_per_revolution=form.edges_per_revolution or _edges(form, window * unit),
    )
    assumed = "" if form.speed_window else " (assumed; otherwise: --speed-window)"
    findings = (
        f"Each row becomes a stair of {HOLD:g} s; its speed is the mean over the last {window:g} s{assumed}.",
        "Steady states separate friction from gain, but do not show inertia or delay: fit them together with a "
        "recording of the same motor in motion.",
    )
    return Steady(tuple(_stairs(voltage[run], speed[run] * unit) for run in runs), info, findings)


def _edges(form: CsvForm, turn: float) -> int:
    edges = round(min(tau / (form.count_quantum * turn), 2.0 * MOST_EDGES)) if form.count_quantum else 0
    if edges > MOST_EDGES:
        raise RecordingError("The counts of a turn come to more than any encoder has: check --count-quantum.")
    return edges


def _stairs(voltage: Floats, speed: Floats) -> tuple[Sample, ...]:
    """A sample at every step: the mean speed of the voltage before, and the voltage that comes now."""
    period = round(HOLD * 1e9)
    reported = np.concatenate([[0.0], speed])
    applied = np.append(voltage, voltage[-1])
    rows = zip(reported.tolist(), applied.tolist(), strict=True)
    return tuple(Sample(period * k, omega, volts) for k, (omega, volts) in enumerate(rows))
