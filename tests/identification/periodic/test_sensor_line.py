"""A line over the angle: of a load, which the motor answers, or of a sensor that errs with the angle."""

from dataclasses import replace

import numpy as np
import pytest
from plant import profiles, record
from recorded import as_speed, without_count
from swinging import RUBBING, noisy

from motor_identification.diagnose import diagnose
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.problem import make_problem
from motor_identification.periodic.periodic_fit import measure_angles
from motor_identification.periodic.sensor_line import explain_line
from motor_identification.recording import Recording, check

MEANS = {"seed": 0, "edges": 960, "sample_rate": 50.0, "single_channel": False}
RIPPLE = {"ripple_voltage": 0.4, "ripple_cycles": 1.3, "ripple_phase": 0.5}


def erring(share: float, cycles: float, instant: bool = True) -> Recording:
    """Speeds that are too high and too low by a share in turns, at instants or as the means of such an angle."""
    recording = noisy(0.3, instant=instant)
    period = recording.info.sample_period
    angle = np.cumsum(recording.speed) * period
    if instant:
        return replace(recording, speed=recording.speed * (1.0 + share * np.sin(cycles * angle + 0.3)))
    error = share / cycles * np.sin(cycles * angle + 0.3)
    return replace(recording, speed=recording.speed + np.diff(error, prepend=0.0) / period)


def lead(recording: Recording, cycles: float) -> float:
    problem = make_problem([check(recording)], ("coulomb_friction",))
    begin = np.zeros(len(problem.unknowns.low))  # an initial speed beside these
    begin[:3] = np.log(RUBBING["kv"]), np.log(RUBBING["ka"]), RUBBING["ks"]
    fit = fit_speeds(Estimate(problem, begin))
    load, sensor = explain_line(fit, measure_angles(fit, problem.unknowns.effects), cycles)
    assert load >= 0.0 and sensor >= 0.0
    return sensor - load


@pytest.mark.parametrize("instant", [True, False])
def test_errors_that_are_a_share_of_the_speed_are_the_sensors(instant: bool) -> None:
    assert 20.0 < lead(erring(0.03, 1.0, instant), 1.0) < 2000.0


@pytest.mark.parametrize("instant", [True, False])
def test_what_the_motor_answers_is_a_load(instant: bool) -> None:
    assert -2000.0 < lead(noisy(0.3, instant=instant, **RIPPLE), 1.3) < -20.0


def test_of_a_line_that_was_found_beside_a_whole_number_of_cycles_the_whole_one_is_tried() -> None:
    sensor = erring(0.03, 2.0)
    assert lead(sensor, 2.002) == pytest.approx(lead(sensor, 2.0), abs=0.5)
    assert lead(sensor, 2.7) < lead(sensor, 2.0) - 20.0


@pytest.mark.parametrize("instant", [True, False])
def test_a_sensor_that_errs_with_the_angle_is_no_ripple_of_the_torque(instant: bool) -> None:
    found = diagnose([check(erring(0.03, 2.0, instant))])
    assert [one.effect for one in found.findings] == ["coulomb_friction"]


@pytest.mark.parametrize(("cycles", "volts"), [(1.0, 0.4), (2.0, 0.15)])
def test_a_load_is_a_ripple_where_a_motor_has_one_speed_to_and_fro(cycles: float, volts: float) -> None:
    """The first fit there has taken up much of it, and errors of a sensor would explain more of the rest."""
    ripple = {"ripple_voltage": volts, "ripple_cycles": cycles, "ripple_phase": 0.5}
    recording, _ = record(RUBBING | ripple, *profiles.pieces([3.0, -3.0] * 3, 2.0), **MEANS)  # type: ignore[arg-type]
    logged = without_count(as_speed(recording))
    noise = 0.3 * np.random.default_rng(0).standard_normal(len(logged.speed))
    found = diagnose([check(replace(logged, speed=np.round(logged.speed + noise, 9)))])
    assert {one.effect for one in found.findings} == {"coulomb_friction", "torque_ripple"}
