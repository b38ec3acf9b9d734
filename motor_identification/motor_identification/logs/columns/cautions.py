"""What a user is told to check: duties beyond the full one, a set-point, a mark that drives nothing, no means."""

import numpy as np

from motor_identification.logs.columns.drive import find_same_levels
from motor_identification.logs.columns.notes import Notes
from motor_identification.logs.columns.said import Pair
from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import Kind
from motor_identification.measurement.sanity_checks import count_undriven_rows

ROUNDED = 0.01  # of full duty, by which rounding may go beyond it
NO_MEAN = 1e-9  # of the RMS: means that were subtracted leave 1e-16, and those that were measured are larger
ONE_SIDED = 1e-3  # of its range, by which a drive goes further one way: one that is the same both ways has no mean


def caution_beyond_full(table: Table, pair: Pair, full: float | None, notes: Notes) -> None:
    """Tell of duties beyond the full one that was said: another scale, or a code of a program's own."""
    values = np.abs(table.numbers(pair.voltage))
    beyond = values > full * (1.0 + ROUNDED) if full else np.zeros(0, bool)
    if beyond.any():
        notes.findings.append(
            f"Caution: {pair.voltage} goes up to {np.max(values):g}, beyond the full duty of {full:g}, in "
            f"{np.count_nonzero(beyond)} rows: no bridge gives more than its supply. Check --full-duty, or leave out "
            "rows whose number is a code."
        )


def caution_set_point(table: Table, pair: Pair, kind: Kind, notes: Notes) -> None:
    """Tell of a drive whose numbers are those of the motion: what it should be, or has been."""
    levels = find_same_levels(table.numbers(pair.voltage), table.numbers(pair.motion))
    if levels:
        notes.findings.append(
            f"Caution: at {levels} levels {pair.motion} comes to the numbers of {pair.voltage} themselves, as a "
            f"{kind.value} comes to its set-point: neither may be what drives the motor. Check them, and say --voltage "
            f"and --{kind.value}."
        )


def caution_running_without_drive(table: Table, pair: Pair, notes: Notes) -> None:
    """Tell of a motor that keeps its speed in the first rows, in which its drive is 0: a mark, or a change of it."""
    drive, speed = table.numbers(pair.voltage), table.numbers(pair.motion)
    rows = count_undriven_rows(drive, speed)
    if rows:
        speed_before = float(np.mean(speed[:rows]))
        notes.findings.append(
            f"Caution: {pair.motion} is {speed_before:.3g} in the first {rows} rows, where {pair.voltage} is 0: "
            "nothing drives a motor at 0 V. It may be a mark, or the change of a voltage: log that voltage itself."
        )


def caution_no_means(table: Table, pair: Pair, notes: Notes) -> None:
    """Tell of a drive and a motion whose means were taken out, as `detrend` does: what stands at 0 V then moves."""
    drive, motion = table.numbers(pair.voltage), table.numbers(pair.motion)
    with np.errstate(over="ignore", invalid="ignore"):  # a damaged cell may be any number
        one_sided = abs(float(np.max(drive) + np.min(drive))) > ONE_SIDED * float(np.ptp(drive))
        without = [abs(float(np.mean(one))) < NO_MEAN * float(np.sqrt(np.mean(one**2))) for one in (drive, motion)]
    if one_sided and all(without):
        notes.findings.append(
            f"Caution: {pair.voltage} and {pair.motion} both have a mean of 0, as where a trend was taken out: "
            "friction, a dead zone and a constant load are not seen without those means. Import what was measured."
        )
