"""What a log's motion can show, before anything is fitted."""

import numpy as np
import pytest

from motor_identification.logs.excitation import describe_excitation, measure_excitation
from motor_identification.logs.log import Log
from motor_identification.logs.run import Run
from motor_model.sample import Info, Measurement, Sample


def log(voltage: object, speed: object, **info: object) -> Log:
    rows = zip(np.asarray(voltage, float).tolist(), np.asarray(speed, float).tolist(), strict=True)
    samples = tuple(Sample(10_000_000 * k, omega, volts) for k, (volts, omega) in enumerate(rows))
    about = Info(measurement=Measurement.SPEED, max_voltage=6.0, sample_period=0.01)
    return Log(Info(**{**{name: getattr(about, name) for name in about.__slots__}, **info}), (Run("", samples),), ())  # type: ignore[arg-type]


def test_both_ways_at_three_levels() -> None:
    volts = np.repeat([0.0, 3.0, -3.0, 6.0], 25)
    found = measure_excitation(log(volts, 20.0 * volts))
    assert (found.low, found.high, found.levels) == (-3.0, 6.0, 3)
    assert (found.forward, found.backward, found.standing, found.full) == (0.5, 0.25, 0.25, 0.25)
    about, can = describe_excitation(log(volts, 20.0 * volts))
    assert about == (
        "Excitation: -3 to 6 V in 3 levels, both ways; the motor stands in 25 % of the rows, full voltage in 25 %."
    )
    assert can == "kv, ka and friction can be identified."


def test_what_a_log_does_not_show() -> None:
    one_way = " ".join(describe_excitation(log(np.repeat([2.0, 4.0], 50), np.repeat([9.0, 30.0], 50))))
    assert "one way only" in one_way and "look alike (it runs one way only)" in one_way and "separated" not in one_way
    step = " ".join(describe_excitation(log(np.repeat([0.0, 4.0], 50), np.repeat([0.0, 30.0], 50))))
    assert (
        "Excitation: 0 to 4 V in a single level beside 0, one way only" in step
        and "kv and friction cannot be separated (one voltage only)" in step
    )
    still = describe_excitation(log(np.repeat([0.0, 4.0], 50), np.zeros(100)))
    assert still[-1] == "The motor hardly moves: nothing can be identified from this."
    slow = " ".join(
        describe_excitation(log(np.repeat([-2.0, 4.0], 50), np.repeat([-9.0, 30.0], 50), sample_period=20.0))
    )
    assert "ka and delays cannot be seen (steady states)" in slow


@pytest.mark.parametrize(
    ("first", "said"),
    [
        (0.0, "0 to 4 V in a single level beside 0"),
        (0.039, "0.039 to 4 V in a single level beside 0"),
        (0.041, "0.041 to 4 V in a single level but for a few rows"),
        (3.0, "3 to 4 V in a single level but for a few rows"),
    ],
)
def test_a_single_level_is_beside_0_where_0_is_there(first: float, said: str) -> None:
    """A log that begins with a row of what was before has no 0 in it."""
    volts = np.full(100, 4.0)
    volts[0] = first
    assert said in describe_excitation(log(volts, 5.0 * volts))[0]


@pytest.mark.parametrize(("backward", "ways"), [(2, "one way only"), (3, "both ways")])
def test_a_fiftieth_of_the_rows_is_a_way(backward: int, ways: str) -> None:
    speed = np.full(100, 5.0)
    speed[:backward] = -5.0
    assert ways in describe_excitation(log(np.repeat([2.0, 4.0], 50), speed))[0]


@pytest.mark.parametrize(("standing", "said"), [(50, False), (51, True)])
def test_a_motor_that_mostly_stands(standing: int, said: bool) -> None:
    speed = np.full(100, 5.0)
    speed[:standing] = 0.0
    text = " ".join(describe_excitation(log(np.repeat([2.0, 4.0], 50), speed)))
    assert ("of the time, which says little" in text) == said


@pytest.mark.parametrize(("last", "stands"), [(0.13, True), (0.14, False)])
def test_one_speed_under_any_voltage_is_the_last_that_a_sensor_showed(last: float, stands: bool) -> None:
    found = describe_excitation(log(np.repeat([0.0, -1.0], 50), np.append(np.full(99, 0.13), last)))
    assert any("The motor hardly moves" in line for line in found) is stands


def test_one_voltage_all_the_time() -> None:
    found = describe_excitation(log(np.full(100, 1.88), np.full(100, 5.0)))[0]
    assert found.startswith("Excitation: 1.88 V all the time, one way only;")


def test_a_voltage_without_its_sign_promises_nothing() -> None:
    volts, speed = np.repeat([0.0, 3.0, 3.0, 6.0], 25), np.repeat([0.0, 60.0, -60.0, 120.0], 25)
    said = describe_excitation(log(volts, speed))
    assert said[1].startswith("Caution: the voltage has no sign, and the motor runs both ways") and len(said) == 2


def test_a_ramp_has_many_levels() -> None:
    ramp = np.concatenate([np.zeros(100), np.linspace(0.0, 5.0, 200), np.zeros(50)])
    found = measure_excitation(log(ramp, 20.0 * ramp))
    assert found.levels == 20
    lines = describe_excitation(log(ramp, 20.0 * ramp))
    assert "0 to 5 V in 20 levels and more" in lines[0] and not any("one voltage only" in line for line in lines)
    steps = np.concatenate([np.zeros(100), np.linspace(0.0, 5.0, 20), np.full(230, 5.0)])  # on the way to one voltage
    assert measure_excitation(log(steps, 20.0 * steps)).levels == 1


def test_a_measured_voltage_that_varies_a_little_is_one_level() -> None:
    """5.20, 5.24 and 5.28 V: whichever borders levels have, these are one."""
    volts = np.concatenate(([0.0], np.resize([5.2, 5.24, 5.24, 5.28], 199)))
    about, cannot = describe_excitation(log(volts, np.minimum(np.arange(200.0), 26.0), max_voltage=5.28))
    assert "in a single level beside 0" in about and "kv and friction cannot be separated" in cannot


def test_a_speed_that_was_taken_for_a_position_runs_both_ways() -> None:
    speed = np.resize([20.0, -20.0], 100)
    way = describe_excitation(log(np.full(100, 3.0), speed, measurement=Measurement.COUNTS))
    assert "or a speed was taken for a position (--speed)." in way[1]
    assert "taken for" not in describe_excitation(log(np.full(100, 3.0), speed))[1]
