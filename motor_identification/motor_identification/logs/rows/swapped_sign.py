"""Turns round a motion that goes against its voltage all the time: two wires or two channels are exchanged."""

from dataclasses import replace

import numpy as np

from motor_identification.logs.correlation import correlate
from motor_identification.logs.rows.drive.braking_loop import brakes
from motor_identification.logs.signals import Signals

# Of the motion, weighted by voltage, as `measurement/sanity_checks.py` has it: braking and coasting leave more than
# half with the voltage, exchanged wires -0.9.
AGAINST = -0.5
FEWEST = 20  # rows that tell, or spans of them
# A standing motor's speeds are few: 0, or the last one that its sensor showed, or one count to either way. They are the
# same whatever the voltage is, which has a change of half of it and more.
MOST_STANDING, ANSWERS, HALF = 3, -0.2, 0.5


def turn_round(signals: Signals, is_speed: bool) -> tuple[Signals, list[str]]:
    """Turn round speeds, or positions, that go against the voltage, and a finding where they do."""
    if len(signals) < FEWEST or not _goes_against(signals, is_speed):
        return signals, []
    said = (
        "Caution: the motion goes against the voltage, as where two wires or the encoder's channels are exchanged: its "
        "sign is turned round."
    )
    return replace(signals, motion=-signals.motion), [said]


def _goes_against(signals: Signals, is_speed: bool) -> bool:
    """Decide whether a motion goes against the voltage: from row to row, or over as many as noise leaves to see."""
    rows, told, noisy = 1, *_compare(signals, is_speed, 1)
    if told < AGAINST or is_speed:
        return told < AGAINST and not (is_speed and (_stands(signals) or brakes(signals)))
    while noisy and 2 * rows * FEWEST <= len(signals):
        rows *= 2
        told, noisy = _compare(signals, is_speed, rows)
    if told >= AGAINST or noisy:
        return False
    return _compare(signals, is_speed, 2 * rows)[0] < AGAINST  # a loop that holds a load, or answers late, changes that


def _stands(signals: Signals) -> bool:
    """Whether speeds are those of a motor that stands: a few values, which do not answer the voltage."""
    volts = signals.voltage
    if np.ptp(volts) < HALF * np.max(np.abs(volts)) or len(np.unique(signals.motion)) > MOST_STANDING:
        return False
    return correlate(volts, signals.motion) > ANSWERS


def _compare(signals: Signals, is_speed: bool, rows: int) -> tuple[float, bool]:
    """Compare motion with voltage over spans of rows: the share that goes with it, -1 to 1, and whether it is noise.

    Of a converter's noise, which is more than what a position moves in a span, most steps are taken back by the next.
    Measured: a potentiometer that turned by a twelfth of its noise in a row had -0.08 by row, and -0.87 by 16 rows.
    """
    with_voltage = without_sign = follows = 0.0
    for run in signals.runs.values():
        motion = signals.motion[run]
        steps = motion if is_speed else np.diff(motion[::rows])
        spans = len(steps) * rows
        way = signals.voltage[run][:spans].reshape(-1, rows).mean(axis=1) * steps
        with_voltage += float(np.sum(way))
        without_sign += float(np.sum(np.abs(way)))
        follows += float(np.sum(steps[1:] * steps[:-1]))
    return with_voltage / without_sign if without_sign else 0.0, follows < 0.0
