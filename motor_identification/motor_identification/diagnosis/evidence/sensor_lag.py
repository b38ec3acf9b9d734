"""Decide whether what makes a motion late may be of its sensor: speeds that were smoothed, or late, before the log.

A filter's lag is an inductance to the motion, and a speed that was kept for a row is a dead time. Counts of a row each
passed no filter, nor do times between edges; and what was said of a sensor is believed. Of other speeds nobody knows,
unless their noise told a filter, which may be another one than it seems; nor of steps that may be a converter's.
"""

from collections.abc import Sequence

from motor_identification.measurement.pulse_intervals import measure_slot
from motor_identification.recording import Recording
from motor_identification.sensor.speed_sensor import find_speed_sensor, may_be_converted
from motor_identification.timing.timing import is_open


def may_lag(logged: Sequence[Recording], read: Sequence[Recording]) -> bool:
    """Decide whether the sensor of recordings may lag: speeds of which nobody said how, and that are no counts.

    logged: as they are. read: as they were taken to be made, filters undone.
    """
    return any(is_open(one) and not _is_told(other) for one, other in zip(logged, read, strict=True))


def _is_told(recording: Recording) -> bool:
    """Whether speeds are counts of a row each, or slots over the times between edges."""
    counted = find_speed_sensor(recording).step > 0.0 and not may_be_converted(recording)
    return measure_slot(recording) > 0.0 or counted
