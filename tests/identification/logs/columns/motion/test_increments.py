"""Counts of one row, and counts that go on."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.columns.motion.increments import count_anew
from motor_identification.logs.columns.notes import Notes
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.csv.table import Table

RANDOM = np.random.default_rng(5)
DRIVE = np.repeat(RANDOM.integers(-9, 10, 25), 20)
FAST = np.rint(np.convolve(DRIVE, np.exp(-np.arange(20) / 3.0))[: len(DRIVE)]).astype(int)
RATE = np.rint(np.convolve(DRIVE, np.exp(-np.arange(60) / 9.0) / 3.0)[: len(DRIVE)]).astype(int)


@pytest.mark.parametrize(
    ("name", "values", "said", "anew"),
    [
        ("ticks", FAST, None, True),
        ("ticks", np.cumsum(RATE), None, False),
        ("delta_ticks", np.cumsum(RATE), None, True),
        ("enc_delta", RATE, None, True),
        ("ticks_per_sample", RATE, None, True),
        ("counts_per_loop", RATE, None, True),
        ("dticks", RATE, None, True),
        ("d_enc", RATE, None, True),
        ("d_enc", np.cumsum(RATE), None, False),  # one letter is believed where the numbers say so, too
        ("velL", np.cumsum(RATE), None, True),
        ("velL", RATE, False, False),
        ("ticks", RATE, False, False),
        ("ticks", np.cumsum(RATE), True, True),
        ("ticks", 0 * RATE, None, False),
    ],
)
def test_which_counts_begin_anew(name: str, values: np.ndarray, said: bool | None, anew: bool) -> None:
    cells = {"u": DRIVE.astype(np.str_), name: values.astype(np.str_)}
    table, notes = Table(Path("log.csv"), np.arange(len(DRIVE)), cells), Notes([], [])
    assert count_anew(table, Pair("", "u", name), Said(increments=said), notes) is anew
    assert len(notes.findings) == (anew and said is None)
    assert not notes.questions


def test_counts_of_a_slow_motor_are_asked_about() -> None:
    """Its speed is not far from an integral of the drive."""
    drive = DRIVE[::5]
    rate = np.rint(np.convolve(drive, 3.0 * np.exp(-np.arange(60) / 9.0))[: len(drive)]).astype(int)
    cells = {"u": drive.astype(np.str_), "ticks": rate.astype(np.str_)}
    table, notes = Table(Path("log.csv"), np.arange(len(drive)), cells), Notes([], [])
    assert not count_anew(table, Pair("", "u", "ticks"), Said(), notes)
    assert [column for column, _ in notes.questions] == ["ticks"]


@pytest.mark.parametrize(
    ("gain", "fast", "quick"), [(0.1, 0.1, 0.03), (0.1, 0.1, 0.2), (0.25, 0.1, 0.08), (0.8, 0.4, 0.03)]
)
def test_a_position_that_a_loop_holds_goes_on(gain: float, fast: float, quick: float) -> None:
    """The drive falls as the counts rise: u = Kp (1000 - y), cut off at ±255."""
    counts, drives, speed, angle = [], [], 0.0, 0.0
    for _ in range(400):
        counts.append(np.floor(angle))
        drives.append(float(np.rint(np.clip(gain * (1000.0 - counts[-1]), -255.0, 255.0))))
        speed += (fast * drives[-1] - speed) * quick
        angle += speed
    table = Table(Path("log.csv"), np.arange(400), {"u": np.array(drives), "ticks": np.array(counts)})
    notes = Notes([], [])
    assert not count_anew(table, Pair("", "u", "ticks"), Said(), notes)
    assert not notes.findings and not notes.questions


@pytest.mark.parametrize("signed", [True, False])
@pytest.mark.parametrize("waits", [0, 200])
def test_a_position_that_stays_in_the_dead_band_goes_on(waits: int, signed: bool) -> None:
    """U = Kp (135 - y), with or without its sign, until friction holds the motor at 121; as it was measured."""
    rises = [0, 3, 7, 15, 24, 34, 45, 57, 67, 79, 90, 102, 114, 124, 133, 139, 145, 148, 148, 147, 144, 141, 136, 132]
    moves = [0] * waits + [*rises, 127, 123, 118, 115, 115, 117, 118, 120, 120, *[121] * 170]
    counts = np.array(moves, np.float64)
    drive = np.clip(15.0 * (135.0 - counts), -255.0, 255.0)
    drive[:waits] = 0.0
    cells = {"u": drive if signed else np.abs(drive), "ticks": counts}
    table, notes = Table(Path("log.csv"), np.arange(len(counts)), cells), Notes([], [])
    assert not count_anew(table, Pair("", "u", "ticks"), Said(), notes)
    assert not notes.findings and not notes.questions


def test_counts_of_one_row_from_a_sensor_the_other_way_round() -> None:
    table, notes = Table(Path("log.csv"), np.arange(len(DRIVE)), {"u": DRIVE, "ticks": -FAST}), Notes([], [])
    assert count_anew(table, Pair("", "u", "ticks"), Said(), notes)


@pytest.mark.parametrize(("edges", "said"), [(4096, None), (1000, 1000)])
def test_an_angle_that_wraps_goes_on(edges: int, said: int | None) -> None:
    """The angle within a turn may follow the drive as speeds do."""
    way, volts = [0.0], [4]
    for _ in range(499):
        way.append(way[-1] + volts[-1] * edges / 400.0)
        volts.append(9 if way[-1] % edges > edges / 2 else 4)
    drive, angle = np.array(volts), np.rint(way).astype(int) % edges
    cells = {"u": drive.astype(np.str_), "ticks": angle.astype(np.str_)}
    table, notes = Table(Path("log.csv"), np.arange(500), cells), Notes([], [])
    assert not count_anew(table, Pair("", "u", "ticks"), Said(edges_per_revolution=said), notes)
    assert not notes.questions
