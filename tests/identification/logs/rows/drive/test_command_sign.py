"""A sign that is the voltage's is taken off a motion of one channel, and none that is the motor's own."""

from dataclasses import replace

import numpy as np
import pytest
from one_channel import EDGES, FINE, ROW, counted, drive, turn
from scipy.signal import lfilter

from motor_identification.logs.form import CsvForm, Kind
from motor_identification.logs.motion import read_motion
from motor_identification.logs.rows.drive import command_sign
from motor_identification.logs.rows.drive.command_sign import (
    AGAINST,
    AT_SPEED,
    BEHIND,
    FEWEST_TURNS,
    MOSTLY,
    take_off_commands_sign,
    take_off_commands_sign_of_speeds,
)
from motor_identification.logs.signals import Floats, Signals
from motor_model.sample import Info

VOLTS = drive(600)
SPEEDS = turn(VOLTS, 0.5)


def controlled(seed: int) -> tuple[Floats, Floats]:
    """Voltages [V] and speeds [rad/s] at every step of a small motor with friction under a PI controller, 12 levels."""
    kv, tau, ks, fine = 0.1935, 0.03, 0.6, ROW / FINE
    targets = np.random.default_rng(seed).uniform(-22.0, 22.0, 12).repeat(160)
    volts, speeds, speed, integral, mean = np.zeros(len(targets)), np.zeros(len(targets) * FINE), 0.0, 0.0, 0.0
    for row, target in enumerate(targets):
        integral += 40.0 * ROW * (target - mean)
        wanted = kv * (1.5 * (target - mean) + integral)
        volts[row] = np.clip(wanted, -6.0, 6.0)
        integral += (volts[row] - wanted) / kv
        for k in range(row * FINE, (row + 1) * FINE):
            if speed != 0.0 or abs(volts[row]) > ks:
                after = speed + ((volts[row] - ks * np.sign(speed or volts[row])) / kv - speed) * fine / tau
                speed = 0.0 if speed * after < 0.0 else after
            speeds[k] = speed
        mean = float(np.mean(speeds[row * FINE : (row + 1) * FINE]))
    return volts, speeds


def signed(volts: Floats, speeds: Floats) -> Signals:
    """Counts of one channel with the sign of the voltage before each row."""
    signals = counted(volts, speeds)
    way = np.append(0.0, np.sign(volts)[:-1])
    return replace(signals, motion=np.cumsum(way * np.diff(signals.motion, prepend=0.0)))


def as_speeds(signals: Signals) -> Signals:
    return replace(signals, motion=np.diff(signals.motion, prepend=0.0) * 2.0 * np.pi / EDGES / ROW)


def test_the_sign_of_the_command_is_taken_off() -> None:
    bare = take_off_commands_sign(signed(VOLTS, SPEEDS))
    assert bare is not None and np.array_equal(bare.motion, counted(VOLTS, SPEEDS).motion)
    speeds = take_off_commands_sign_of_speeds(as_speeds(signed(VOLTS, SPEEDS)))
    assert speeds is not None and np.array_equal(speeds.motion, np.abs(as_speeds(signed(VOLTS, SPEEDS)).motion))


def test_a_motors_own_sign_stays() -> None:
    own = counted(VOLTS, SPEEDS, both=True)
    assert take_off_commands_sign(own) is None and take_off_commands_sign_of_speeds(as_speeds(own)) is None
    assert take_off_commands_sign(counted(VOLTS, SPEEDS)) is None  # which has none


def test_a_motor_that_turns_round_within_a_row_has_a_sign_of_its_own() -> None:
    """It goes with the voltage, too, but is slow after each change."""
    quick = np.repeat(np.sign(VOLTS), FINE) * np.repeat(np.abs(VOLTS) / 0.05, FINE)
    assert take_off_commands_sign(counted(VOLTS, quick, both=True)) is None


@pytest.mark.parametrize("tau", [0.3, 0.5, 1.0])
@pytest.mark.parametrize("late", [0.0, 0.3])
@pytest.mark.parametrize("levels", [2, 40])
def test_a_motor_of_half_a_row_has_a_sign_of_its_own_under_a_voltage_that_changes_in_each(
    tau: float, late: float, levels: int
) -> None:
    """Its speeds are means over rows, of which a part is of the voltage before: once they were |speeds|, by mistake."""
    random = np.random.default_rng(4)
    volts = random.choice(np.linspace(-4.0, 4.0, levels), 100)
    fine, keep = np.repeat(volts, 100), np.exp(-0.01 / tau)
    fine = np.concatenate([np.zeros(round(100 * late)), fine])[: len(fine)]
    speeds = lfilter([1.0 - keep], [1.0, -keep], fine).reshape(-1, 100).mean(axis=1) / 0.05
    rounded = np.rint(np.append(0.0, speeds[:-1]) / 0.2) * 0.2
    signals = counted(volts, np.zeros(FINE * 100))
    assert take_off_commands_sign_of_speeds(replace(signals, motion=rounded)) is None


@pytest.mark.parametrize(("share", "told"), [(0.5 * AGAINST, True), (4.0 * AGAINST, False)])
def test_some_counts_may_go_against_the_voltage(share: float, told: bool) -> None:
    signals = signed(VOLTS, SPEEDS)
    steps = np.diff(signals.motion, prepend=0.0)
    against = np.arange(len(steps)) % round(1.0 / share) == 1
    turned = replace(signals, motion=np.cumsum(np.where(against, -steps, steps)))
    assert (take_off_commands_sign(turned) is not None) is told


@pytest.mark.parametrize(("rows", "told"), [(0, True), (BEHIND, False)])
def test_few_rows_in_a_long_log_that_turn_on_against_the_voltage_are_a_motors_own_sign(rows: int, told: bool) -> None:
    """Four changes of the voltage in 1200 rows: all that goes on against it is less than a share of the counts."""
    volts = np.repeat([4.0, -4.0, 4.0, -4.0, 4.0], 240)
    way = np.sign(volts)
    for turn_at in range(240, 1200, 240):
        way[turn_at + 1 : turn_at + 1 + rows] *= -1.0
    bare = counted(volts, turn(volts, 0.5))
    signals = replace(bare, motion=np.cumsum(np.append(0.0, way[:-1]) * np.diff(bare.motion, prepend=0.0)))
    steps, sign = np.diff(signals.motion), np.append(0.0, np.sign(volts))[1:-1]
    assert np.sum(np.abs(steps[steps * sign < 0.0])) < AGAINST * np.sum(np.abs(steps))
    assert (take_off_commands_sign(signals) is not None) is told


@pytest.mark.parametrize(("turns", "told"), [(FEWEST_TURNS - 1, False), (FEWEST_TURNS + 2, True)])
def test_a_few_turns_tell_nothing(turns: int, told: bool) -> None:
    volts = np.where(np.arange(600) * (turns + 1) // 600 % 2, -4.0, 4.0)
    assert (take_off_commands_sign(signed(volts, turn(volts, 0.5))) is not None) is told


def braked(turns: int, brakes: int, late: int = 0, halts: bool = False) -> Signals:
    """One channel with the command's sign, a row late at the first `late` turns, braked for a row now and then.

    A brake is two changes of the voltage at speed, or one where the motor halts for a row behind it.
    """
    rows = 2400
    volts = np.where(np.arange(rows) * (turns + 1) // rows % 2, -4.0, 4.0)
    bare = counted(volts, turn(volts, 0.5))
    way = np.append(0.0, np.sign(volts)[:-1])
    for back in np.flatnonzero(way[2:] * way[1:-1] < 0.0)[:late] + 2:
        way[back] *= -1.0
    steps = way * np.diff(bare.motion, prepend=0.0)
    driven = volts.copy()
    at = np.arange(1, brakes + 1) * rows // (turns + 1) - 90
    driven[at] *= -1.0
    if halts:
        steps[at + 2] = 0.0
    return replace(bare, voltage=driven, motion=np.cumsum(steps))


@pytest.mark.parametrize(("brakes", "told"), [(2, True), (3, False)])
def test_the_counts_go_back_at_most_of_the_turns(brakes: int, told: bool) -> None:
    """Behind six turns and two brakes they do at 6 of 10 changes, behind three at 6 of 12."""
    assert 6 / (6 + 2 * 3) <= MOSTLY < 6 / (6 + 2 * 2)
    assert (take_off_commands_sign(braked(6, brakes)) is not None) is told


@pytest.mark.parametrize(("turns", "told"), [(FEWEST_TURNS - 1, False), (FEWEST_TURNS, True)])
def test_few_turns_at_which_the_counts_go_back_tell_nothing(turns: int, told: bool) -> None:
    """One brake more makes three changes of the voltage's sign of two."""
    assert (take_off_commands_sign(braked(turns, 1, halts=True)) is not None) is told


@pytest.mark.parametrize("late", [0, 3])
def test_counts_may_go_back_a_row_behind_the_voltage(late: int) -> None:
    """As they do where edges came between the sign and the row; the turns are the same."""
    assert take_off_commands_sign(braked(6, 0, late)) is not None


@pytest.mark.parametrize(("share", "told"), [(AT_SPEED, True), (0.8, True), (1.0, False)])
def test_turns_of_a_motor_that_is_slow_by_then_tell_nothing(
    monkeypatch: pytest.MonkeyPatch, share: float, told: bool
) -> None:
    """A tachogenerator was said to be one channel: coasted down to 5 % of its speed, it went the other way at once."""
    monkeypatch.setattr(command_sign, "AT_SPEED", share)
    assert (take_off_commands_sign(signed(VOLTS, SPEEDS)) is not None) is told


@pytest.mark.parametrize("kind", [Kind.COUNT, Kind.SPEED])
def test_an_import_says_so_and_gives_the_motor_its_way(kind: Kind) -> None:
    signals = signed(VOLTS, SPEEDS)
    signals = as_speeds(signals) if kind is Kind.SPEED else signals
    form = CsvForm("t", "u", "y", kind, "rad/s" if kind is Kind.SPEED else "count", edges_per_revolution=EDGES)
    motion = read_motion(form, Info(sample_period=ROW), signals)
    assert any(line.startswith("Caution: y goes the way of the voltage's sign, at once") for line in motion.findings)
    true = np.diff(counted(VOLTS, SPEEDS, both=True).motion, prepend=0.0) * 2.0 * np.pi / EDGES / ROW
    fast = np.abs(true) > 0.3 * np.max(np.abs(true))
    assert np.mean(np.sign(motion.speed[fast]) == np.sign(true[fast])) > 0.97
    kept = read_motion(replace(form, signs_as_they_are=True), Info(sample_period=ROW), signals)
    assert not any("one channel" in line for line in kept.findings)


@pytest.mark.parametrize("seed", [1, 3, 4])
def test_a_controlled_motor_that_is_braked_for_some_rows_has_a_sign_of_its_own(seed: int) -> None:
    """Less than 1 % of its counts go against the voltage, whose changes passed for turns of the motor at its speed.

    One channel of the same motor, with the sign of the command, is told.
    """
    volts, speeds = controlled(seed)
    own = counted(volts, speeds, both=True)
    assert take_off_commands_sign(own) is None and take_off_commands_sign_of_speeds(as_speeds(own)) is None
    assert take_off_commands_sign(signed(volts, speeds)) is not None
    assert take_off_commands_sign_of_speeds(as_speeds(signed(volts, speeds))) is not None
