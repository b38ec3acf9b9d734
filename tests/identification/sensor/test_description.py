"""What was found of a sensor is said beside every result, once."""

import numpy as np
from handmade import turning
from recorded import as_speed, without_count
from swinging import noisy, recorded

from motor_identification.sensor.description import describe_speed_sensor, note_sensors
from motor_identification.sensor.speed_sensor import SpeedSensor, find_speed_sensor


def sensor(frame: float = 0.0, step: float = 0.0, sigma: float = 0.0) -> SpeedSensor:
    return SpeedSensor(np.arange(3), np.arange(3.0), 0.02, 0.01, frame, step, sigma, 2800 if step else 0)


def test_every_kind_of_sensor_has_its_sentence() -> None:
    assert describe_speed_sensor(sensor(step=0.1121997), known=False) == (
        "Every speed is a multiple of 0.1122 rad/s (6.429 deg/s): 2,800 counts a turn over 20 ms are assumed."
    )
    assert describe_speed_sensor(sensor(sigma=0.123), known=False) == (
        "The speeds lie on no lattice of counts: white noise of 0.12 rad/s, as between neighbours, is assumed."
    )
    assert describe_speed_sensor(sensor(frame=0.02), known=True) == (
        "The sensor gives a new speed every 20 ms; what repeats it in between is left out."
    )
    assert describe_speed_sensor(sensor(step=0.1), known=True) == ""


def test_notes_are_added_once_and_only_where_something_was_found() -> None:
    found = without_count(as_speed(recorded()))
    (once,) = note_sensors([found])
    assert once.notes == (describe_speed_sensor(find_speed_sensor(found), known=False),)
    assert "960 counts a turn over 20 ms" in once.notes[0]
    assert note_sensors([once]) == (once,)
    assert "white noise of" in note_sensors([noisy(0.5)])[0].notes[0]
    said, stamped = as_speed(recorded()), turning(lambda time: 100.0 * time, 1.0)
    assert note_sensors([said, stamped]) == (said, stamped)
