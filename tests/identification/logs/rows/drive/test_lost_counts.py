"""A board that loses counts under its encoder's edges is told of, and no motor that becomes slower."""

from dataclasses import replace

import numpy as np
import pytest
from driven_rows import SPEED, logged

from motor_identification.logs.form import Kind
from motor_identification.logs.rows.drive.lost_counts import FALLEN, SLOWER, caution_lost_counts
from motor_identification.logs.signals import Signals

COUNTS = replace(SPEED, kind=Kind.COUNT)


def busy(slower: float, left: float, volts: float = 12.0) -> Signals:
    """A step, in whose middle rows become so much slower and counts so much fewer: 0.5 ms of 600 a second at first."""
    steps = np.concatenate((np.full(1000, 0.0005), np.full(1000, 0.0005 * slower)))
    rate = np.concatenate((np.linspace(100.0, 6000.0, 1000), np.full(1000, 6000.0 * left)))
    signals = logged(np.full(2000, volts), np.floor(np.cumsum(rate * steps)))
    return replace(signals, time=np.rint(np.cumsum(steps) * 1e9).astype(np.int64))


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_counts_that_become_fewer_as_rows_become_slower_were_lost(way: float) -> None:
    signals = busy(8.0, 0.2)
    (said,) = caution_lost_counts(replace(signals, motion=way * signals.motion), COUNTS)
    assert said.startswith("Caution: y goes on by less than half") and "rows come 8 times slower by then" in said


@pytest.mark.parametrize(
    ("slower", "left"), [(0.9 * SLOWER, 0.2), (8.0, 1.1 * FALLEN), (1.0, 0.2), (8.0, 1.0), (1.0, 1.0)]
)
def test_a_motor_that_becomes_slower_or_rows_that_do_are_no_sign(slower: float, left: float) -> None:
    assert caution_lost_counts(busy(slower, left), COUNTS) == []


def test_only_counts_under_one_voltage_are_looked_at() -> None:
    signals = busy(8.0, 0.2)
    assert caution_lost_counts(signals, SPEED) == []
    off = np.where(np.arange(2000) < 1000, 12.0, 0.0)
    assert caution_lost_counts(replace(signals, voltage=off), COUNTS) == []
    lower = np.where(np.arange(2000) < 1000, 12.0, 3.0)
    assert caution_lost_counts(replace(signals, voltage=lower), COUNTS) == []
    assert caution_lost_counts(signals.only(np.arange(2000) % 10 == 0), COUNTS) == [], "few rows"
