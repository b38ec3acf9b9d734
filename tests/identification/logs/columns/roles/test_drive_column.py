"""Which column drives, and which is the supply."""

import numpy as np
import pytest
from log_columns import DRIVE, FOLLOWS, TIME, columns, table

from motor_identification.logs.columns.roles.roles import find_roles
from motor_identification.logs.columns.said import Pair, Said
from motor_model.errors import RecordingError


def test_a_voltage_beside_a_duty_may_be_the_supply() -> None:
    supplied = find_roles(table(t="t", pwm="u", voltage="b", speed="y"), Said())
    assert (supplied.pairs[0].voltage, supplied.supply) == ("pwm", "voltage")
    driven = find_roles(table(t="t", pwm="u", voltage="u", speed="y"), Said())
    assert (driven.pairs[0].voltage, driven.supply) == ("voltage", None)
    named = find_roles(table(t="t", pwm="u", battery="b", speed="y"), Said())
    assert (named.pairs[0].voltage, named.supply) == ("pwm", "battery")


def test_a_voltage_of_zeros_drives_nothing_beside_a_duty() -> None:
    """A test stand has a column for its meter, whether that is plugged in or not."""
    beside = find_roles(columns(t=TIME, pwm=DRIVE, voltage=0.0 * DRIVE, speed=FOLLOWS), Said())
    assert beside.pairs[0].voltage == "pwm"
    neither = find_roles(columns(t=TIME, pwm=0.0 * DRIVE, voltage=0.0 * DRIVE, speed=FOLLOWS), Said())
    assert neither.pairs[0].voltage == "voltage"
    strained = columns(t=TIME, pwm=DRIVE, **{"Left Load Cell (mV)": FOLLOWS, "speed": FOLLOWS})
    assert find_roles(strained, Said()).pairs[0].voltage == "pwm"


def test_what_is_called_a_supply_and_swings_drives() -> None:
    assert find_roles(table(t="t", Vin="u", speed="y"), Said()).pairs == (Pair("", "Vin", "speed"),)
    with pytest.raises(RecordingError, match="no column is the voltage or duty"):
        find_roles(table(t="t", Vin="b", speed="y"), Said())
    assert find_roles(table(t="t", Vin="b", pwm="u", speed="y"), Said()).supply == "Vin"


@pytest.mark.parametrize(("least", "battery"), [(22.0, True), (2.0, False)])
def test_a_voltage_that_stays_while_the_motor_turns_both_ways_drives_nothing(least: float, battery: bool) -> None:
    volts = np.where(np.arange(200) < 4, 0.0, np.linspace(25.0, least, 200))
    table = columns(t=TIME, VOLT=volts, vel=FOLLOWS)
    if battery:
        with pytest.raises(RecordingError, match="no column is the voltage or duty"):
            find_roles(table, Said())
        directed = columns(t=TIME, VOLT=volts, vel=FOLLOWS, dir=np.sign(DRIVE))  # a pin says which way
        assert find_roles(directed, Said()).pairs[0].voltage == "VOLT"
    else:
        assert find_roles(table, Said()).pairs[0].voltage == "VOLT"
    one_way = columns(t=TIME, VOLT=volts, vel=np.abs(FOLLOWS))
    assert find_roles(one_way, Said()).pairs[0].voltage == "VOLT"


@pytest.mark.parametrize("told", [True, False])
def test_a_battery_of_few_levels_drives_nothing_where_a_set_point_is_told(told: bool) -> None:
    volts = np.select([np.arange(200) < 4, np.arange(200) < 90], [0.0, 25.1], 24.9)
    table = columns(t=TIME, setpoint=np.sign(DRIVE) if told else np.ones(200), VOLT=volts, vel=FOLLOWS)
    if told:
        with pytest.raises(RecordingError, match="no column is the voltage or duty"):
            find_roles(table, Said())
    else:
        assert find_roles(table, Said()).pairs[0].voltage == "VOLT"


@pytest.mark.parametrize(
    ("standing", "off", "battery"),
    [(10, False, True), (9, False, False), (0, False, False), (40, True, False)],
)
def test_a_voltage_that_stays_while_a_motor_stands_again_is_a_battery(standing: int, off: bool, battery: bool) -> None:
    """As on a test stand, where the motor's controller gets pulses; a bridge that is switched off has 0 V then."""
    speed = np.concatenate((np.linspace(0.0, 90.0, 200 - standing), np.zeros(standing)))
    volts = np.linspace(16.7, 16.2, 200) * ~((speed == 0.0) & off)
    table = columns(t=TIME, Voltage=volts, speed=speed)
    if battery:
        with pytest.raises(RecordingError, match="no column is the voltage or duty"):
            find_roles(table, Said())
    else:
        assert find_roles(table, Said()).pairs[0].voltage == "Voltage"


@pytest.mark.parametrize(
    ("rows", "standing", "battery"), [(2, 0, False), (15, 0, False), (15, 140, False), (15, 150, True)]
)
def test_rows_between_the_counts_of_a_slow_motor_are_no_standstill(rows: int, standing: int, battery: bool) -> None:
    """The voltage of a step was taken for a battery's, for every other row had no count, and an import refused."""
    speed = np.where(np.arange(400) % rows == 0, 1.0, 0.0)
    speed[len(speed) - standing :] = 0.0
    stepped = columns(t=0.001 * np.arange(400), VOLT=np.where(np.arange(400) < 4, 0.0, 6.0), vel=speed)
    if battery:
        with pytest.raises(RecordingError, match="no column is the voltage or duty"):
            find_roles(stepped, Said())
    else:
        assert find_roles(stepped, Said()).pairs[0].voltage == "VOLT"


def test_what_stays_drives_nothing_where_something_else_changes() -> None:
    """A loop's delay, or a supply, beside what was put out; what is called a reference is asked about by its name."""
    stays, late = np.full(200, 16.0), 10.0 + np.sin(9.0 * TIME)
    for name in ("delay", "x"):
        log = columns(**{"Rig.ref": 20.0 * DRIVE + 100.0, "Rig.out": FOLLOWS, f"Rig.{name}": stays})
        with pytest.raises(RecordingError, match=r"is the voltage or duty\. .* say --voltage Rig\.ref\.$"):
            find_roles(log, Said())
        assert find_roles(log, Said(voltage="Rig.ref")).pairs == (Pair("", "Rig.ref", "Rig.out"),)
    with pytest.raises(RecordingError, match=r"say --voltage ref\.$"):
        find_roles(columns(t=TIME, ref=DRIVE, speed=FOLLOWS, dt=late), Said())
    with pytest.raises(RecordingError, match=r"which column is the voltage\? .* one of u, volts"):
        find_roles(columns(t=TIME, u=DRIVE, volts=stays, speed=FOLLOWS), Said())  # of one step, the one that stays
