"""What was logged before anything came of its voltage is left out, and no dead time and no friction is."""

from dataclasses import replace

import numpy as np
import pytest
from driven_rows import SPEED, logged

from motor_identification.logs.form import Kind
from motor_identification.logs.rows.drive.late_start import COUNTS, FEWEST_STEPS, LATER, drop_late_start
from motor_identification.logs.rows.drive.unpowered_start import ROWS
from motor_identification.logs.signals import Floats, Signals

STAIRS = np.repeat([3.0, 6.0, 9.0, 12.0], 300)


def late(still: int, volts: Floats = STAIRS, dead_time: int = 4) -> Signals:
    """A motor of a time constant of 8 rows, that stands in the first rows and is so late later."""
    behind = np.concatenate((np.full(dead_time, volts[0]), volts))[: len(volts)]
    speed, speeds = 0.0, []
    for k, voltage in enumerate(behind):
        speed = 0.0 if k < still else speed + (10.0 * voltage - speed) / 8.0
        speeds.append(np.round(speed))
    return logged(volts, np.array(speeds))


@pytest.mark.parametrize("kind", [Kind.SPEED, Kind.COUNT])
@pytest.mark.parametrize("way", [1.0, -1.0])
def test_a_first_step_that_is_answered_much_later_than_others_had_nobody_to_answer_it(kind: Kind, way: float) -> None:
    signals = late(120)
    motion = way * (signals.motion if kind is Kind.SPEED else np.cumsum(signals.motion))
    signals = replace(signals, voltage=way * signals.voltage, motion=motion)
    found, said = drop_late_start(signals, replace(SPEED, kind=kind))
    assert len(signals) - 120 <= len(found) <= len(signals) - 118 and found.motion[0] == 0.0
    assert said[0].startswith("Left out: the first 119 rows, in which y stands at") and "within 5 rows" in said[0]


@pytest.mark.parametrize(
    ("still", "volts", "dead_time"),
    [
        (ROWS - 1, STAIRS, 0),
        (120, STAIRS, round(120 / LATER) + 2),  # about as late as later
        (120, np.repeat([0.0, 6.0, 9.0, 12.0], 300), 4),  # nothing drives it
        (120, np.repeat([3.0, 6.0], [300, 600])[: 300 * FEWEST_STEPS], 4),  # one step more, which may be chance
        (310, np.repeat([3.0, 6.0, 9.0, 12.0, 3.0], 300), 4),  # friction held it at 3 V
        (120, np.repeat([3.0, 6.0, 9.0, 12.0], [300, 30, 30, 30]), 4),  # others last too short
    ],
)
def test_a_late_start_that_may_be_the_motors_is_kept(still: int, volts: Floats, dead_time: int) -> None:
    signals = late(still, volts, dead_time)
    found, said = drop_late_start(signals, SPEED)
    assert len(found) == len(signals) and said == []


def test_a_slow_motors_first_count_may_be_late() -> None:
    signals = late(120)
    counts = np.floor(np.cumsum(signals.motion * (0.9 * COUNTS / 120 / 30.0)))
    found, said = drop_late_start(replace(signals, motion=counts), replace(SPEED, kind=Kind.COUNT))
    assert len(found) == len(signals) and said == []


def test_every_run_begins_for_itself() -> None:
    signals = late(120)
    joined = logged(np.tile(STAIRS, 2), np.concatenate((late(0).motion, signals.motion)))
    joined = replace(joined, runs={"a": slice(0, 1200), "b": slice(1200, 2400)})
    found, said = drop_late_start(joined, SPEED)
    assert found.runs["a"] == slice(0, 1200) and found.runs["b"].stop == len(found) < 2400 and len(said) == 1
