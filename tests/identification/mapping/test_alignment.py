"""Fields with times of their own as rows of one log."""

import numpy as np
import pytest

from motor_identification.bag.fields import Series, parse_path
from motor_identification.mapping.alignment import align, stamps_of
from motor_model.errors import RecordingError

MS = 10**6


def series(field: str, received: object, values: object, stamp: object = None, garbled: int = 0) -> Series:
    arrived = np.asarray(received, np.int64)
    stamps = arrived if stamp is None else np.asarray(stamp, np.int64)
    return Series(parse_path(field), arrived, stamps, np.asarray(values, float), stamp is not None, garbled)


def test_commands_are_held_and_averaged_from_row_to_row() -> None:
    motion = series("/m:x", np.arange(6) * 10 * MS, np.arange(6))
    command = series("/c:x", [0, 15 * MS, 20 * MS, 38 * MS], [1.0, 3.0, 5.0, 7.0])
    rows = align(command, motion, None)
    assert rows.voltage == pytest.approx([1.0, 2.0, 5.0, (8 * 5 + 2 * 7) / 10, 7.0, 7.0])
    assert rows.motion.tolist() == list(range(6)) and np.isnan(rows.current).all()


def test_rows_before_the_first_command_are_left_out() -> None:
    motion = series("/m:x", np.arange(6) * 10 * MS, np.arange(6))
    rows = align(series("/c:x", [25 * MS, 47 * MS], [2.0, 4.0]), motion, series("/i:x", [35 * MS], [0.5]))
    assert rows.time.tolist() == [30 * MS, 40 * MS, 50 * MS]
    assert rows.voltage == pytest.approx([2.0, (7 * 2 + 3 * 4) / 10, 4.0])
    assert np.isnan(rows.current[0]) and rows.current[1:].tolist() == [0.5, 0.5]
    assert "3 messages on /m before the first command are left out." in rows.notes
    with pytest.raises(
        RecordingError, match="/m:x has no messages after the first on /c:x: their times do not overlap"
    ):
        align(series("/c:x", [45 * MS], [2.0]), motion, None)


def test_what_is_to_be_known_of_a_topic_is_said_once_for_all_its_fields() -> None:
    received = np.arange(6) * 10 * MS
    speed, volts, current = (series(f"/m:{field}", received, np.arange(6)) for field in ("speed", "volts", "current"))
    assert len(align(volts, speed, current).notes) == 1
    assert len(align(series("/c:volts", received, np.arange(6)), speed, current).notes) == 2


def test_times_of_arrival_with_their_jitter() -> None:
    received = np.arange(100) * 20 * MS + np.tile([0, 2 * MS], 50)
    times, said = stamps_of(series("/c:x", received, np.zeros(100), garbled=3))
    assert np.array_equal(times, received)
    assert "has no stamps: times are those of arrival, every 2" in said and "give or take" in said
    assert "3 messages on it cannot be decoded" in said


@pytest.mark.parametrize(("away", "moved"), [(990 * MS, False), (1010 * MS, True)])
def test_a_header_of_another_clock_is_moved_by_the_soonest_message(away: int, moved: bool) -> None:
    stamp = np.arange(100) * 10 * MS
    late = np.tile([1 * MS, 3 * MS], 50)
    times, said = stamps_of(series("/m:x", stamp + away + late, np.zeros(100), stamp))
    if moved:
        assert np.array_equal(times, stamp + away + MS) and "is stamped by another clock, 1.012 s away" in said
    else:
        assert np.array_equal(times, stamp) and "messages arrive 9.9e+02 ms later, ± 1.000 ms." in said
