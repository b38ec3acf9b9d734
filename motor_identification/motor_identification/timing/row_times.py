"""Read when a log's rows were made, otherwise than their stamps say, where the motion goes on with it.

A board's rows that a computer stamped when they came are late on their own (`sensor/row_clock.py`). A program that
divides counts by the period its loop should have makes speeds of rows that took longer too high. Both show in the
motion, but not in speeds that were smoothed on their way: a filter runs row by row, and has to be undone first.
"""

from dataclasses import dataclass, replace

import numpy as np

from motor_identification.recording import Floats, Recording
from motor_identification.sensor.row_clock import RUN_AWAY, lay_clocks, measure_period
from motor_identification.sensor.speed_sensor import find_speed_sensor

LEAST_ROWS = 50
IRREGULAR = 0.01  # of a row: standard deviation of the rows' lengths that matters
LONGEST = 5.0  # rows: what is longer is a gap, in which nothing may have been counted


LATE = (
    "The rows are put on a clock of {:.4g} ms, which their stamps are off by {:.2g} ms: the motion goes on with that, "
    "not with these."
)
NOMINAL = (
    "The speeds were computed as if every row took {:.4g} ms: they are divided by the rows' own lengths, which the "
    "motion follows (otherwise: import_log --no-nominal-period)."
)


@dataclass(frozen=True)
class RowTimes:
    """How the times of rows are read."""

    run_away: float | None = None  # share of what stamps say that their clock runs away; None: stamps are on it
    nominal: bool = False  # whether speeds were divided by one period for all rows

    def set_on(self, recording: Recording) -> Recording:
        """Read a recording of speeds by the clock of its rows, which is its sample period's, and by their lengths."""
        if self.run_away is not None:
            recording = _lay_clock(recording, self.run_away)
        if self.nominal and not recording.info.rows_said:
            lengths = _measure_lengths(recording)
            recording = replace(recording, speed=recording.speed * (measure_period(lengths) / lengths))
        return recording

    def describe(self, recording: Recording, timed: Recording) -> list[str]:
        """Say how a recording is read otherwise than it says."""
        notes, row = [], 1e3 * timed.info.sample_period
        if timed.sample_time is not recording.sample_time:
            notes.append(LATE.format(row, 1e-6 * float(np.std(recording.sample_time - timed.sample_time))))
        if self.nominal and not recording.info.rows_said:
            notes.append(NOMINAL.format(row))
        return notes


AS_STAMPED = RowTimes()


def list_row_times(recording: Recording) -> list[RowTimes]:
    """List how the times of a recording's rows may be read otherwise than they say.

    None of counts that were divided by lengths which stamps hide: summed up, they are even by any rows.
    """
    if find_speed_sensor(recording).blurred:
        return []
    shares = [clock.run_away for clock in lay_clocks(recording.time)]
    clocks = [None, *(share for share in (0.0, *RUN_AWAY) if share in shares)]
    return [
        times
        for share in clocks
        for nominal in (False, True)
        if (times := RowTimes(share, nominal)) != AS_STAMPED and not (nominal and _says_lengths(recording, share))
    ]


def _measure_lengths(recording: Recording) -> Floats:
    """Measure how long rows are [s], shape (K,): a usual one where a row is lacking before, and the first."""
    rows = np.diff(recording.time)
    usual = float(np.median(rows))
    return np.asarray(np.append(usual, np.where(rows < LONGEST * usual, rows, usual)))


def _says_lengths(recording: Recording, share: float | None) -> bool:
    """Decide whether nobody has to ask by which lengths speeds were divided: it was said, or rows are of one."""
    return recording.info.rows_said or _is_even(recording, share)


def _is_even(recording: Recording, share: float | None) -> bool:
    """Decide whether rows are of one length."""
    lengths = _measure_lengths(recording if share is None else _lay_clock(recording, share))
    return len(lengths) < LEAST_ROWS or not np.std(lengths) > IRREGULAR * np.median(lengths)


def _lay_clock(recording: Recording, run_away: float) -> Recording:
    """Put rows onto the clock that runs away so much; as they are where there is none."""
    clock = next((one.time for one in lay_clocks(recording.time) if one.run_away == run_away), None)
    if clock is None:
        return recording
    time = recording.sample_time[0] + np.round(clock * 1e9).astype(np.int64)
    info = replace(recording.info, sample_period=float(np.median(np.diff(clock))))
    return replace(recording, sample_time=time, info=info)
