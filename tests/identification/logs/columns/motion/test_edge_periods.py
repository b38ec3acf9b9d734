"""Times between edges are speeds, where they are all the motion that a log has, and no times of rows."""

from typing import Any

import numpy as np
import pytest
from log_columns import DRIVE, TIME, columns

from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.columns.motion.edge_periods import CHANGES, GOES_WITH, is_edge_period, read_edge_periods
from motor_identification.logs.columns.said import Said
from motor_identification.logs.form import Kind

SPEED = 40.0 + 20.0 * np.convolve(np.abs(DRIVE), np.exp(-np.arange(60) / 8.0) / 8.0)[:200]  # [1/s]
PERIOD = np.rint(1e6 / SPEED)  # [us]
WAY = (DRIVE > 0.0).astype(float)
MADE = "1 / period_us (count/s)"
COUNTED = "edges of rows (count)"
UNSAID = Said()


def read(said: Said = UNSAID, **cells: Any) -> tuple[np.ndarray[Any, Any] | None, Said, tuple[str, ...]]:
    table, said = read_edge_periods(columns(**cells), said)
    return table.numbers(MADE) if MADE in table.names else None, said, table.notes


@pytest.mark.parametrize(
    ("name", "is_one"),
    [
        ("period_us", True),
        ("edge_interval_ms", True),
        ("pulsePeriod_us", True),
        ("Period (us)", True),
        ("enc_period_ns", True),
        ("period", False),  # in no unit
        ("loop_period_us", False),
        ("sample_period_ms", False),
        ("pwm_period_us", False),
        ("pulse_us", False),  # a servo's
        ("t_edge_us", False),  # when it came
    ],
)
def test_which_names_are_those_of_times_between_edges(name: str, is_one: bool) -> None:
    assert is_edge_period(read_heading(name)) is is_one


def test_a_time_between_edges_is_a_speed() -> None:
    period = np.where(TIME < 0.05, 0.0, PERIOD)
    speed, _, notes = read(t=TIME, pwm=np.abs(DRIVE), period_us=period)
    assert speed is not None
    np.testing.assert_allclose(speed[5:], 1e6 / PERIOD[5:], rtol=1e-12)
    assert not speed[:5].any() and "period_us is the time between two edges" in notes[-1]
    assert read_heading(MADE).unit == "count/s"


@pytest.mark.parametrize("drive", [DRIVE, -DRIVE])
@pytest.mark.parametrize("way", [WAY, 2.0 * WAY - 1.0, np.where(TIME < 0.05, 0.0, 2.0 * WAY - 1.0)])
def test_a_direction_beside_it_gives_the_sign_that_goes_with_the_drive(
    drive: np.ndarray[Any, Any], way: np.ndarray[Any, Any]
) -> None:
    """Of 1 and 0, of 1 and -1, and with 0 where the motor stands."""
    period = np.where(way == 0.0, 0.0, PERIOD) if len(np.unique(way)) == 3 else PERIOD
    cells = {"t": TIME.astype(str), "u": drive.astype(str), "period_us": period.astype(str)}
    speed, _, notes = read(**cells, dir=way.astype(int).astype(str))
    assert speed is not None
    moving = period > 0.0
    np.testing.assert_array_equal(np.sign(speed[moving]), np.sign(drive[moving]))
    assert "with the sign of dir" in notes[-1]


@pytest.mark.parametrize("beside", [{"temp_C": TIME}, {"y": 0.0 * TIME}])
def test_what_is_no_motion_beside_it_does_not_hide_it(beside: dict[str, np.ndarray[Any, Any]]) -> None:
    assert read(t=TIME, u=DRIVE, period_us=PERIOD, **beside)[0] is not None
    assert read(t=TIME, u=DRIVE, period_us=0.0 * TIME + 50.0, **beside)[0] is None  # that of a PWM


def test_signs_of_its_own_are_kept() -> None:
    speed, _, notes = read(t=TIME, u=DRIVE, period_us=-np.sign(DRIVE) * PERIOD, dir=WAY.astype(int).astype(str))
    assert speed is not None and "with the sign" not in notes[-1]
    np.testing.assert_array_equal(np.sign(speed), -np.sign(DRIVE))


@pytest.mark.parametrize(
    ("cells", "said"),
    [
        ({"rpm": SPEED}, Said()),  # beside a motion that was logged as one
        ({"y": SPEED}, Said()),  # or may be one
        ({}, Said(motion="u")),
        ({"edge_period_us": 2.0 * PERIOD}, Said()),  # of two motors
        ({}, Said(kind=Kind.POSITION, motion="period_us")),
        ({}, Said(kind=Kind.SPEED, motion="period_us", unit="rpm")),
    ],
)
def test_it_is_not_read_where_something_else_is_the_motion(cells: dict[str, np.ndarray[Any, Any]], said: Said) -> None:
    assert read(said, t=TIME, u=DRIVE, period_us=PERIOD, **cells)[:2] == (None, said)


def test_who_says_that_it_is_the_speed_has_it_read_so() -> None:
    said = Said(kind=Kind.SPEED, motion="period_us")
    speed, read_as, _ = read(said, t=TIME, u=DRIVE, period_us=PERIOD, rpm=SPEED)
    assert speed is not None and read_as.motion == MADE


@pytest.mark.parametrize(("share", "is_speed"), [(0.85, False), (0.75, True)])
def test_times_from_row_to_row_are_no_motion(share: float, is_speed: bool) -> None:
    steps = 0.01 + 0.002 * np.random.default_rng(1).random(200)
    time = np.concatenate([[0.0], np.cumsum(steps[1:])])
    period = np.where(np.arange(200) < share * 200, 1e6 * steps, PERIOD)
    assert (read(t_s=time, u=DRIVE, period_us=period)[0] is not None) is is_speed
    before = np.append(period[1:], 1e4)  # each of the row to come
    assert (read(t_s=time, u=DRIVE, period_us=before)[0] is not None) is is_speed
    assert read(u=DRIVE, period_us=PERIOD)[0] is None  # nothing else says when the rows were
    assert read(Said(sample_period=0.01), u=DRIVE, period_us=PERIOD)[0] is not None


@pytest.mark.parametrize(
    ("name", "said", "is_speed"),
    [
        ("edge_interval_us", Said(), True),
        ("pulse_period_us", Said(), True),
        ("period_us", Said(motion="period_us", kind=Kind.SPEED), True),
        ("period_us", Said(edges_per_revolution=245), True),
        ("period_us", Said(), False),  # a program's loop may be as long
        ("tick_period_us", Said(), False),
        ("loop_period_us", Said(edges_per_revolution=245), False),
    ],
)
@pytest.mark.parametrize("before", [False, True])
def test_of_a_row_an_edge_the_times_between_rows_are_those_between_edges(
    name: str, said: Said, is_speed: bool, before: bool
) -> None:
    """Where a name or the user says that they are: each row is an edge, and they are counted."""
    period = 1e-6 * np.rint(1e6 / SPEED)
    time = np.cumsum(np.append(0.0, period[1:]))
    logged = np.append(period[1:], period[-1]) if before else period
    table, read_as = read_edge_periods(columns(t_s=time, u=np.abs(DRIVE), **{name: np.rint(1e6 * logged)}), said)
    assert (COUNTED in table.names) is is_speed
    if is_speed:
        assert np.array_equal(table.numbers(COUNTED), np.arange(200)) and read_heading(COUNTED).unit == "count"
        assert read_as.motion == (COUNTED if said.motion else None) and read_as.kind is None


def of_rows(rows: np.ndarray[Any, Any], said: Said = UNSAID, **drive: np.ndarray[Any, Any]) -> bool:
    """Whether times [s] from row to row, by the name of an encoder's, are read as those of edges."""
    time = np.cumsum(np.append(0.0, rows[1:]))
    table, _ = read_edge_periods(columns(t_s=time, enc_period_us=1e6 * rows, **drive), said)
    return COUNTED in table.names


@pytest.mark.parametrize(("part", "moves"), [(0.5 * GOES_WITH, False), (2.0 * GOES_WITH, True)])
def test_a_loops_period_does_not_go_with_the_drive_whatever_its_name(part: float, moves: bool) -> None:
    """It was said to be a speed, of the time between two readings of an encoder."""
    drive = np.abs(DRIVE) - np.mean(np.abs(DRIVE))
    noise = np.random.default_rng(2).standard_normal(200)
    noise -= np.mean(noise) + drive * (drive @ noise) / (drive @ drive)
    mixed = part * drive / np.std(drive) + np.sqrt(1.0 - part**2) * noise / np.std(noise)
    assert of_rows(1.0 / (100.0 + mixed), u=DRIVE) is moves
    assert of_rows(1.0 / (100.0 + mixed), Said(edges_per_revolution=96), u=DRIVE) is moves
    assert of_rows(1.0 / (100.0 + mixed), Said(motion="enc_period_us", kind=Kind.SPEED), u=DRIVE)  # as the user says


@pytest.mark.parametrize(("most", "moves"), [(CHANGES * 1.1, True), (CHANGES * 0.95, False)])
def test_under_one_voltage_a_motors_edges_come_sooner_and_sooner(most: float, moves: bool) -> None:
    speed = np.repeat([100.0, 100.0 * most], 100)
    assert of_rows(1.0 / speed, u=np.full(200, 6.0)) is moves and of_rows(1.0 / speed) is moves


@pytest.mark.parametrize(("share", "is_count"), [(0.995, True), (0.98, False)])
def test_edges_are_counted_where_nearly_every_row_is_one(share: float, is_count: bool) -> None:
    """Else 1 / period is the speed, of which a row may have several."""
    period = 1e-6 * np.rint(1e6 / SPEED)
    time = np.cumsum(np.append(0.0, period[1:]))
    logged = np.where(np.arange(200) >= share * 200, 2.0, 1.0) * period
    table, _ = read_edge_periods(columns(t_s=time, u=np.abs(DRIVE), edge_period_us=np.rint(1e6 * logged)), Said())
    assert (COUNTED in table.names) is is_count and ("1 / edge_period_us (count/s)" in table.names) is not is_count


@pytest.mark.parametrize("own", [False, True])
def test_counted_edges_have_the_sign_of_a_direction_or_of_their_times(own: bool) -> None:
    period = 1e-6 * np.rint(1e6 / SPEED)
    time, signs = np.cumsum(np.append(0.0, period[1:])), np.where(DRIVE > 0.0, 1.0, -1.0)
    cells = {"t_s": time.astype(str), "u": DRIVE.astype(str)}
    if own:
        table, _ = read_edge_periods(columns(**cells, edge_period_us=(signs * 1e6 * period).astype(str)), Said())
    else:
        turned = {"edge_period_us": (1e6 * period).astype(str), "dir": WAY.astype(int).astype(str)}
        table, _ = read_edge_periods(columns(**cells, **turned), Said())
    np.testing.assert_array_equal(np.diff(table.numbers(COUNTED)), signs[1:])
    assert ("with the sign of dir" in table.notes[-1]) is not own


def test_without_another_clock_nothing_says_when_the_rows_were_whoever_names_the_times() -> None:
    said = Said(motion="period_us", kind=Kind.SPEED)
    assert read(said, u=DRIVE, period_us=PERIOD)[0] is None
