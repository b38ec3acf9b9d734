"""Describe the sensor that was found in the values of a recording, as a note beside every result."""

from collections.abc import Sequence
from dataclasses import replace
from math import degrees

from motor_identification.recording import Recording
from motor_identification.sensor.speed_sensor import SpeedSensor, find_speed_sensor
from motor_model.sample import Measurement


def note_sensors(recordings: Sequence[Recording]) -> tuple[Recording, ...]:
    """Add to every recording's notes what its values say of a sensor that nobody described."""
    return tuple(_note_sensor(recording) for recording in recordings)


def _note_sensor(recording: Recording) -> Recording:
    if recording.info.measurement is not Measurement.SPEED:
        return recording
    note = describe_speed_sensor(find_speed_sensor(recording), bool(recording.info.edges_per_revolution))
    return replace(recording, notes=(*recording.notes, note)) if note and note not in recording.notes else recording


def describe_speed_sensor(sensor: SpeedSensor, known: bool) -> str:
    """Say what was found of a speed sensor; empty where all was `known` before."""
    parts = []
    if sensor.frame > 0.0:
        parts.append(
            f"The sensor gives a new speed every {sensor.frame * 1e3:.3g} ms; what repeats it in between is left out."
        )
    if not known and sensor.step > 0.0:
        parts.append(
            f"Every speed is a multiple of {sensor.step:.4g} rad/s ({degrees(sensor.step):.4g} deg/s): "
            f"{sensor.edges_per_revolution:,} counts a turn over {sensor.window * 1e3:.4g} ms are assumed."
        )
    elif not known and sensor.sigma > 0.0:
        parts.append(
            f"The speeds lie on no lattice of counts: white noise of {sensor.sigma:.2g} rad/s, as between neighbours, "
            "is assumed."
        )
    return " ".join(parts)
