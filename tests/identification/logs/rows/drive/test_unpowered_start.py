"""What was logged before the supply was switched on is left out, and no late start of a motor that has friction."""

from dataclasses import replace

import numpy as np
import pytest
from driven_rows import LEVELS, SPEED, logged

from motor_identification.logs.form import Kind
from motor_identification.logs.rows.drive.unpowered_start import FEWEST_CHANGES, ROWS, drop_unpowered_start
from motor_identification.logs.signals import Floats, Signals


def late(still: int, volts: Floats) -> Signals:
    """A motor that follows its voltage from a row on."""
    return logged(volts, np.where(np.arange(len(volts)) < still, 0.0, 10.0 * volts))


@pytest.mark.parametrize("kind", [Kind.SPEED, Kind.COUNT])
def test_rows_before_the_supply_was_on_are_left_out(kind: Kind) -> None:
    signals = late(200, np.repeat(LEVELS, 10))
    motion = signals.motion if kind is Kind.SPEED else np.floor(np.cumsum(signals.motion) / 25.0)
    found, said = drop_unpowered_start(replace(signals, motion=motion), replace(SPEED, kind=kind))
    assert 1000 <= len(found) <= 1001 and found.voltage[-1] == signals.voltage[-1]
    assert "rows, in which y stands at up to 5 V and behind which it runs at 2.5 V and less" in said[0]


@pytest.mark.parametrize(
    ("still", "volts"),
    [
        (10 * FEWEST_CHANGES, np.repeat(LEVELS, 10)),  # a dead time of two changes
        (200, np.repeat(np.where(np.arange(120) < 20, 0.0, LEVELS), 10)),  # nothing drives it
        (200, np.linspace(0.0, 5.0, 1200)),  # a ramp, which it follows from its breakaway on
        (200, np.repeat(np.where(np.arange(120) < 20, 0.3 * LEVELS, 2.0 + LEVELS), 10)),  # at more voltage later
        (ROWS - 1, np.repeat(LEVELS, 2)),
    ],
)
def test_a_late_start_is_the_motors(still: int, volts: Floats) -> None:
    signals = late(still, volts)
    found, said = drop_unpowered_start(signals, SPEED)
    assert len(found) == len(signals) and said == []


def test_a_motor_that_stands_at_little_voltage_later_has_friction() -> None:
    volts = np.repeat(LEVELS, 10)
    speed = np.where((np.arange(1200) < 200) | (volts < 3.0), 0.0, 10.0 * volts)
    assert drop_unpowered_start(logged(volts, speed), SPEED)[1] == []
    assert drop_unpowered_start(logged(volts, np.zeros(1200)), SPEED)[1] == [], "one that never runs"


@pytest.mark.parametrize("kind", [Kind.SPEED, Kind.COUNT])
@pytest.mark.parametrize(("dead_time", "told"), [(0, True), (20, True), (60, False), (90, False)])
def test_a_motor_that_is_as_late_all_along_had_its_supply(kind: Kind, dead_time: int, told: bool) -> None:
    """A chirp changes in every row, in a dead time too: 60 rows of one are no switch, of 20 most of them are."""
    k = np.arange(1500)
    volts = 5.0 * np.sin(2.0 * np.pi * (k / 400.0 + k**2 / 1e6))
    behind = np.concatenate((np.zeros(dead_time), volts))[: len(k)]
    speed = np.where(k < 100, 0.0, 10.0 * behind)
    motion = speed if kind is Kind.SPEED else np.floor(np.cumsum(speed) / 2.0)
    found, said = drop_unpowered_start(logged(volts, motion), replace(SPEED, kind=kind))
    assert (said != []) is told and (len(found) < len(k)) is told


@pytest.mark.parametrize(("still", "told"), [(55, False), (100, True)])
def test_a_chirp_whose_motor_starts_at_the_most_voltage_until_then_had_its_supply(still: int, told: bool) -> None:
    """It breaks away while the voltage rises, and runs on through the zeros; behind the top it would have started."""
    k = np.arange(1500)
    volts = 5.0 * np.sin(2.0 * np.pi * (k / 400.0 + k**2 / 1e6))
    found, said = drop_unpowered_start(late(still, volts), SPEED)
    assert (said != []) is told and (len(found) < len(k)) is told


@pytest.mark.parametrize(("level", "told"), [(4.0, False), (2.0, True)])
def test_stairs_at_whose_highest_step_yet_a_motor_starts(level: float, told: bool) -> None:
    """A few rows behind the step: 1, 2, 3 V and 4 V, and down again; or at 2 V, behind 3 V at which it stood."""
    volts = np.repeat([1.0, 2.0, 3.0, level, 1.4, 1.0, 2.0], 100)
    found, said = drop_unpowered_start(late(305, volts), SPEED)
    assert (said != []) is told and (len(found) < len(volts)) is told


@pytest.mark.parametrize(("rising", "told"), [(True, False), (False, True)])
def test_a_controller_that_takes_its_voltage_away_at_the_first_count_had_its_supply(rising: bool, told: bool) -> None:
    """It winds up against friction until its motor breaks away; one that stood at its limit for long had no supply."""
    volts = np.concatenate([np.linspace(0.0, 3.0, 100), np.linspace(3.0, 3.3, 20), np.full(400, 1.4)])
    if not rising:
        volts[20:100] = 3.4
    volts[100] = 0.2
    found, said = drop_unpowered_start(late(100, volts), SPEED)
    assert (said != []) is told and (len(found) < len(volts)) is told


@pytest.mark.parametrize("kind", [Kind.SPEED, Kind.COUNT])
@pytest.mark.parametrize(("way", "told"), [(1.0, True), (0.0, False)])
def test_a_sine_whose_motor_starts_just_before_its_top_had_no_supply(kind: Kind, way: float, told: bool) -> None:
    """A motor that friction held up to the most voltage there is would not turn round at none; one way, it may run on.

    way: whether it goes back, too.
    """
    k = np.arange(1500)
    volts = 5.0 * np.sin(2.0 * np.pi * k / 400.0)
    volts = volts if way else np.abs(volts)
    signals = late(98, volts)
    motion = signals.motion if kind is Kind.SPEED else np.floor(np.cumsum(signals.motion) / 2.0)
    found, said = drop_unpowered_start(replace(signals, motion=motion), replace(SPEED, kind=kind))
    assert (said != []) is told and (len(found) < len(k)) is told
