"""Gives speeds without a sign that of the motion: counted on one channel, beside a voltage that goes both ways.

A motor whose voltage changes its sign slows down first, and turns the other way from where it was slowest, if it speeds
up again under the new sign. One that is only braked does not speed up again.
"""

from dataclasses import replace

import numpy as np

from motor_identification.logs.signals import Floats, Signals

FASTER = 0.15  # of the largest speed, by which a motor speeds up again under the other sign of the voltage
NOISE = 0.02  # of the largest speed, or voltage, by which one without a sign may seem to be negative
AROUND = 5  # rows whose middle is looked at: a single low value is noise
STARTS = 0.2  # of the largest speed, up to which a run may begin at rest


def give_signs(signals: Signals) -> tuple[Signals, list[str]]:
    """Give speeds their signs where they have none, and the voltage has both; and a finding where they got them."""
    top = float(np.max(np.abs(signals.motion), initial=0.0))
    most = float(np.max(np.abs(signals.voltage), initial=0.0))
    both = np.any(signals.voltage < -NOISE * most) and np.any(signals.motion != 0.0)
    if not both or np.min(signals.motion) < -NOISE * top:
        return signals, []
    sign = np.ones(len(signals))
    for run in signals.runs.values():
        sign[run] = find_signs(signals.motion[run], signals.voltage[run], top)
    if not np.any(sign < 0.0):
        return signals, []
    said = (
        "Caution: speeds have no sign, and the voltage has: the motor is taken to turn over where it is slowest after "
        "the voltage did (assumed; log a sign, or a count)."
    )
    return replace(signals, motion=sign * signals.motion), [said]


def find_signs(speed: Floats, voltage: Floats, top: float) -> Floats:
    """The sign of a motion, 1 or -1, shape (K,), by speeds without one and the voltage [V], of the same shape.

    Args:
        speed: in any unit.
        voltage: what drives.
        top: the largest speed of all runs.
    """
    half = AROUND // 2
    smooth = np.median(np.lib.stride_tricks.sliding_window_view(np.pad(speed, half, mode="edge"), AROUND), axis=1)
    way = np.sign(voltage)
    driven = np.flatnonzero(way)
    if not len(driven):
        return np.ones(len(speed))
    way = way[driven[np.maximum(np.searchsorted(driven, np.arange(len(way)), side="right") - 1, 0)]]
    begins = np.concatenate([[0], np.flatnonzero(np.diff(way)) + 1, [len(way)]])
    sign = np.empty(len(speed))
    now = way[0] if smooth[0] <= STARTS * top else 1.0
    for begin, end in zip(begins[:-1], begins[1:], strict=True):
        sign[begin:end] = now
        risen = smooth[begin:end] - np.minimum.accumulate(smooth[begin:end]) > FASTER * top
        if way[begin] != now and risen.any():
            now = way[begin]
            slowest = begin + int(np.argmin(smooth[begin : begin + int(np.argmax(risen))]))
            sign[slowest:end] = now
    return sign
