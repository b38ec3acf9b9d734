"""Turns round a motion that goes against its voltage all the time: two wires or two channels are exchanged."""

from dataclasses import replace

import numpy as np

from motor_identification.logs.signals import Signals

# Of the motion, weighted by voltage, as `measurement/sanity_checks.py` has it: braking and coasting leave more than
# half with the voltage, exchanged wires -0.9.
AGAINST = -0.5
FEWEST = 20  # rows that tell


def turn_round(signals: Signals, is_speed: bool) -> tuple[Signals, list[str]]:
    """Turn round speeds, or positions, that go against the voltage, and a finding where they do."""
    with_voltage = without_sign = 0.0
    for run in signals.runs.values():
        voltage, motion = signals.voltage[run], signals.motion[run]
        way = voltage * motion if is_speed else voltage[:-1] * np.diff(motion)
        with_voltage += float(np.sum(way))
        without_sign += float(np.sum(np.abs(way)))
    if with_voltage >= AGAINST * without_sign or len(signals) < FEWEST:
        return signals, []
    said = (
        "Caution: the motion goes against the voltage, as where two wires or the encoder's channels are exchanged: its "
        "sign is turned round."
    )
    return replace(signals, motion=-signals.motion), [said]
