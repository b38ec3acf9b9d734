"""A line over the angle: of a load, which the motor answers, or of a sensor that errs with the angle."""

from dataclasses import replace

import numpy as np
import pytest
from swinging import RUBBING, noisy

from motor_identification.diagnose import diagnose
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.problem import make_problem
from motor_identification.periodic.periodic_fit import measure_angles
from motor_identification.periodic.sensor_line import measure_sensor_lead
from motor_identification.recording import Recording, check

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
    return measure_sensor_lead(fit, measure_angles(fit, problem.unknowns.effects), cycles)


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
