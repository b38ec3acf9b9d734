"""What was logged after a motor had lost its supply is left out, and no standstill that is its friction's."""

from dataclasses import replace

import numpy as np
import pytest
from driven_rows import LEVELS, SPEED, logged

from motor_identification.logs.form import Kind
from motor_identification.logs.rows.drive.constant_voltage import CONSTANT
from motor_identification.logs.rows.drive.unpowered_end import FEWEST, drop_unpowered_end
from motor_identification.logs.rows.drive.unpowered_start import FEWEST_CHANGES, ROWS
from motor_identification.logs.signals import Floats, Signals


def tripped(ran: int, volts: Floats) -> Signals:
    """A motor that follows its voltage up to a row."""
    return logged(volts, np.where(np.arange(len(volts)) < ran, 10.0 * volts, 0.0))


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("kind", [Kind.SPEED, Kind.COUNT])
def test_rows_after_the_supply_was_off_are_left_out(kind: Kind, sign: float) -> None:
    signals = tripped(900, sign * np.repeat(LEVELS, 10))
    motion = signals.motion if kind is Kind.SPEED else np.floor(np.cumsum(signals.motion) / 25.0)
    found, said = drop_unpowered_end(replace(signals, motion=motion), replace(SPEED, kind=kind))
    assert 900 <= len(found) <= 901 and found.voltage[0] == signals.voltage[0]
    assert "rows, in which y stands at up to 5 V and before which it ran at 2.5 V and less" in said[0]


def test_every_run_has_its_own_end() -> None:
    signals = tripped(900, np.repeat(LEVELS, 10))
    both = replace(signals, runs={"a": slice(0, 600), "b": slice(600, 1200)})
    found, said = drop_unpowered_end(both, SPEED)
    assert found.runs["a"] == slice(0, 600) and 900 <= found.runs["b"].stop <= 901 and len(said) == 1


@pytest.mark.parametrize(
    ("ran", "volts"),
    [
        (1200 - 10 * FEWEST_CHANGES, np.repeat(LEVELS, 10)),  # it stands for two changes
        (1000, np.repeat(np.where(np.arange(120) < 100, LEVELS, 0.0), 10)),  # nothing drives it
        (1000, np.linspace(5.0, 0.0, 1200)),  # a ramp down, which it follows until its friction holds it
        (1000, np.repeat(np.where(np.arange(120) < 100, 2.0 + LEVELS, 0.3 * LEVELS), 10)),  # at more voltage before
        (240 - ROWS + 1, np.repeat(LEVELS, 2)),
    ],
)
def test_an_early_rest_is_the_motors(ran: int, volts: Floats) -> None:
    signals = tripped(ran, volts)
    found, said = drop_unpowered_end(signals, SPEED)
    assert len(found) == len(signals) and said == []


def test_a_motor_that_stood_at_little_voltage_before_has_friction() -> None:
    volts = np.repeat(LEVELS, 10)
    speed = np.where((np.arange(1200) > 900) | (volts < 3.0), 0.0, 10.0 * volts)
    assert drop_unpowered_end(logged(volts, speed), SPEED)[1] == []
    assert drop_unpowered_end(logged(volts, np.zeros(1200)), SPEED)[1] == [], "one that never runs"


@pytest.mark.parametrize("kind", [Kind.SPEED, Kind.COUNT])
@pytest.mark.parametrize(("left", "found"), [(0.02, 640), (0.9, 440)])
def test_a_servo_that_runs_out_at_little_voltage_has_a_supply(kind: Kind, left: float, found: int) -> None:
    """It comes to its place at little voltage, and its friction holds it at more. A motor that ran on has none later.

    left: what is left of the speed at the end of 40 rows at little voltage.
    """
    volts = np.concatenate((np.full(200, 5.0), [-1.0], np.full(199, 5.0), np.linspace(1.2, 0.9, 40)))
    speed = np.concatenate((np.full(400, 50.0), 50.0 * left ** np.linspace(0.0, 1.0, 40), np.zeros(200)))
    volts = np.concatenate((volts, np.linspace(3.0, 2.6, 200)))  # as its integral goes down
    signals = logged(volts, speed if kind is Kind.SPEED else np.floor(np.cumsum(speed)))
    assert len(drop_unpowered_end(signals, replace(SPEED, kind=kind))[0]) in (found, found + 1)


@pytest.mark.parametrize("kind", [Kind.SPEED, Kind.COUNT])
@pytest.mark.parametrize(
    ("ends_at", "tau", "found"),
    [(0.0, 60.0, 600), (0.2, 12.0, 480), (0.0, np.inf, 600)],  # it coasts; it comes to a lower speed; friction alone
)
def test_a_motor_that_coasts_down_does_not_run_at_little_voltage(
    kind: Kind, ends_at: float, tau: float, found: int
) -> None:
    """Behind a bridge that coasts; its drive, a loop's, is 0 in a row now and then. Then its friction holds it."""
    rows = np.arange(80.0)
    left = ends_at + (1.0 - ends_at) * np.exp(-rows / tau) if np.isfinite(tau) else 1.0 - rows / 80.0
    volts = np.concatenate((np.full(400, 5.0), np.where(rows % 15.0 == 14.0, 0.0, 0.3), np.resize([0.9, 1.2], 120)))
    speed = np.concatenate((np.full(400, 50.0), 50.0 * left, np.zeros(120)))
    signals = logged(volts, speed if kind is Kind.SPEED else np.floor(np.cumsum(speed)))
    kept, said = drop_unpowered_end(signals, replace(SPEED, kind=kind))
    assert len(kept) in (found, found + 1) and bool(said) == (found < 600)


def stopped(level: float, rest: int, kind: Kind) -> Signals:
    """A staircase to a level, at which the motor comes to a stop of its own over five rows, and rests."""
    volts = np.repeat([1.0, 2.0, 3.0, level], 40)
    volts = np.concatenate((volts, np.full(5 + rest, level)))
    speed = 10.0 * volts
    speed[160:165] *= [0.7, 0.5, 0.3, 0.2, 0.1]
    speed[165:] = 0.0
    return logged(volts, speed if kind is Kind.SPEED else np.floor(np.cumsum(speed) / 4.0))


@pytest.mark.parametrize("kind", [Kind.SPEED, Kind.COUNT])
def test_a_stop_under_the_same_voltage_is_left_out_with_its_run_down(kind: Kind) -> None:
    found, said = drop_unpowered_end(stopped(4.0, FEWEST, kind), replace(SPEED, kind=kind))
    assert len(found) == 160 and "which y stands at up to 4 V and before which it ran at 2 V and less" in said[0]
    for level, rest in ((4.0, FEWEST - 1 if kind is Kind.SPEED else FEWEST - 2), (1.5, 15)):
        signals = stopped(level, rest, kind)
        assert drop_unpowered_end(signals, replace(SPEED, kind=kind))[1] == [], "too short; it hardly ran at less"


@pytest.mark.parametrize(("voltage", "kept"), [(CONSTANT, 300), ("u", 500)])
def test_a_log_of_one_step_ends_where_the_motor_comes_to_rest(voltage: str, kept: int) -> None:
    """A program switches the motor off and logs on; the voltage that was said is in no row. What was logged is kept."""
    speed = np.concatenate((np.full(300, 90.0), np.linspace(60.0, 0.0, 50), np.zeros(150)))
    found, said = drop_unpowered_end(logged(np.full(500, 6.0), speed), replace(SPEED, voltage=voltage))
    assert len(found) == kept and bool(said) == (kept < 500)
    assert not said or said[0].startswith("Left out: the last 200 rows, in which y comes to rest under the 6 V")


def test_most_of_such_a_log_may_be_its_run_down() -> None:
    speed = np.concatenate((np.full(100, 90.0), np.linspace(90.0, 0.0, 300), np.zeros(150)))
    found, said = drop_unpowered_end(logged(np.full(550, 6.0), speed), replace(SPEED, voltage=CONSTANT))
    assert 100 <= len(found) <= 100 + 300 // 4 + 1 and said  # down to three quarters of its speed


def test_a_slow_encoder_that_gives_no_count_for_some_rows_runs_on() -> None:
    volts = np.repeat([1.0, 2.0, 3.0, 4.0], 40)
    counts = np.floor(np.cumsum(0.05 * volts))
    counts[-8:] = counts[-9]  # in which 1.6 counts were due
    assert drop_unpowered_end(logged(volts, counts), replace(SPEED, kind=Kind.COUNT))[1] == []


@pytest.mark.parametrize("kind", [Kind.SPEED, Kind.COUNT])
@pytest.mark.parametrize(("rest", "kept"), [(60, 100), (5, 360)])
def test_a_motor_that_was_switched_on_again_ends_before(kind: Kind, rest: int, kept: int) -> None:
    """On, off, on: of a voltage that was said nobody knows when it came back. Values that were not read are no rest."""
    speed = np.concatenate((np.full(100, 90.0), np.linspace(60.0, 1.0, 20), np.zeros(rest), np.full(240 - rest, 90.0)))
    motion = speed if kind is Kind.SPEED else np.floor(np.cumsum(speed) / 9.0)
    form = replace(SPEED, kind=kind, voltage=CONSTANT)
    found, said = drop_unpowered_end(logged(np.full(len(speed), 6.0), motion), form)
    assert len(found) in (kept, kept + 1) and bool(said) == (kept < 360)
    assert not said or said[0].endswith("It runs again later: to have all of it, log the voltage, too.")
    assert drop_unpowered_end(logged(np.full(len(speed), 6.0), motion), replace(form, voltage="u"))[1] == []
