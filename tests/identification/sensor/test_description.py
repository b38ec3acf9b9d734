"""What was found of a sensor is said beside every result, once."""

from dataclasses import replace

import numpy as np
from handmade import turning
from recorded import as_speed, without_count
from servo import record_servo
from swinging import noisy, recorded

from motor_identification.sensor.description import (
    ANGLE,
    describe_speed_sensors,
    note_sensors,
    tells_of_speeds,
)
from motor_identification.sensor.speed_sensor import SpeedSensor, find_speed_sensor


def sensor(frame: float = 0.0, step: float = 0.0, sigma: float = 0.0, rows: int = 100) -> SpeedSensor:
    return SpeedSensor(np.arange(rows), np.arange(float(rows)), 0.02, 0.01, frame, step, sigma, 2800 if step else 0)


def said(*sensors: SpeedSensor, known: bool = False) -> str:
    return describe_speed_sensors([(one, known) for one in sensors])


def test_every_kind_of_sensor_has_its_sentence() -> None:
    assert said(sensor(step=0.1121997)) == (
        "Every speed is a multiple of 0.1122 rad/s (6.429 deg/s): 2,800 counts a turn over 20 ms are assumed."
    )
    assert said(sensor(sigma=0.123)) == (
        "The speeds lie on no lattice of counts: white noise of 0.12 rad/s, as between neighbours, is assumed."
    )
    assert said(sensor(sigma=0.123, rows=14)) == (
        "There are too few speeds to tell their noise: 0.12 rad/s is assumed."
    )
    assert said(sensor(frame=0.02), known=True) == (
        "The sensor gives a new speed every 20 ms; what repeats it in between is left out."
    )
    assert said(sensor(step=0.1), known=True) == said() == ""


def test_wrong_speeds_are_counted_over_all_recordings() -> None:
    few = replace(sensor(step=0.1), wrong=2)
    assert said(few, replace(few, wrong=1), known=True) == (
        "3 of 203 speeds were left out: far beside their neighbours, with no voltage to make them so, or 0 "
        "while the motor moved."
    )


def test_several_recordings_share_a_sentence() -> None:
    assert "white noise of 0.05 to 0.19 rad/s" in said(sensor(sigma=0.1), sensor(sigma=0.05), sensor(sigma=0.19))
    mixed = said(sensor(step=0.1121997, frame=0.02), sensor(sigma=0.1))
    assert "every 20 ms" in mixed and "2,800 counts" in mixed and "white noise of 0.1 rad/s" in mixed


def test_notes_are_added_once_and_only_where_something_was_found() -> None:
    found = without_count(as_speed(recorded()))
    once, other = note_sensors([found, found])
    assert once.notes == (said(find_speed_sensor(found)),) and other.notes == ()
    assert "960 counts a turn over 20 ms" in once.notes[0]
    assert note_sensors([once]) == (once,)
    assert "white noise of" in note_sensors([noisy(0.5)])[0].notes[0]
    known, stamped = as_speed(recorded()), turning(lambda time: 100.0 * time, 1.0)
    assert note_sensors([known, stamped]) == (known, stamped) and note_sensors([]) == ()


def test_a_noisy_angle_is_said() -> None:
    noisy_angle, exact = (record_servo(duration=5.0, noise=noise)[0] for noise in (1e-6, 0.0))
    assert note_sensors([noisy_angle])[0].notes == (
        "The angle has white noise of 1e-06 rad, more than a count: it is taken from sample to sample.",
    )
    assert note_sensors([exact]) == (exact,)


def test_multiples_that_the_few_alone_are_near_are_not_said_of_every_speed() -> None:
    """Of 2,000 speeds 1,133 were different, each said to be a multiple: counts by lengths that no stamp showed."""
    few = said(replace(sensor(step=0.1121997), blurred=True))
    assert few.startswith(
        "Speeds of a few counts are near multiples of 0.1122 rad/s (6.429 deg/s): 2,800 counts a turn"
    )
    assert tells_of_speeds(few) and "very" not in few


def test_what_tells_how_speeds_were_made_is_known_by_its_words() -> None:
    for one in (sensor(step=0.1), sensor(sigma=0.1), sensor(sigma=0.1, rows=14), sensor(frame=0.02)):
        assert tells_of_speeds(said(one))
    assert not tells_of_speeds(ANGLE) and not tells_of_speeds("Something else.")


def test_one_lattice_is_told_once_where_only_some_recordings_have_uneven_rows() -> None:
    """Two bags of one log, of which one was even: the sentence came twice."""
    even, by_rows = sensor(step=0.1121997), replace(sensor(step=0.1121997), lengths=np.ones(100))
    once = said(even, by_rows)
    assert once == (
        "Every speed, in some recordings by the length of its row beside the usual one, is a multiple of 0.1122 rad/s "
        "(6.429 deg/s): 2,800 counts a turn over 20 ms are assumed."
    )
    assert tells_of_speeds(once)
    assert said(even, replace(by_rows, step=0.2)).count("Every speed") == 2
