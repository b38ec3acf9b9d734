"""What belongs to another recording is estimated there: an initial speed, an instant, a phase; not the motor."""

import numpy as np
import pytest
from plant import profiles, record
from small import THETA, TRUE

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.problem import make_problem
from motor_identification.measurement.time_blocks import TimeBlocks
from motor_identification.recording import Recording, check
from motor_identification.validation.nuisance_fit import fit_nuisance_parameters

EVERY_OTHER = TimeBlocks(2)
DRIVE = profiles.random(9.0, 4.0)
MOTOR = {"kv": TRUE["kv"], "ka": TRUE["ka"], "ks": TRUE["ks"]}


def made(extra: dict[str, float], seed: int = 1) -> Recording:
    return check(record(TRUE | extra, *DRIVE, seed=seed, irregularity=0.003)[0])


def applied(recording: Recording, effects: tuple[str, ...], theta: list[float], start: float | None = None) -> Estimate:
    """A motor fitted to another recording, whose own values of what is the recording's are far off, on this one."""
    fitted = Estimate(make_problem([made({}, 9)], ("coulomb_friction", *effects)), np.array([*THETA, *theta]))
    problem = make_problem([recording], ())
    return fit_nuisance_parameters(problem, fitted, tuple(~EVERY_OTHER.mark(data, 0.005) for data in problem.intervals))


def test_without_any_there_is_nothing_to_fit() -> None:
    found = applied(made({}), (), [])
    assert np.array_equal(found.theta, THETA)


@pytest.mark.parametrize("instant", [0.7, 2.9])
def test_the_instant_of_a_load_step(instant: float) -> None:
    recording = made({"step_voltage": 0.8, "step_time": instant})
    found = applied(recording, ("load_step",), [0.8, 0.1])
    assert found.parameters.value("step_time") == pytest.approx(instant, abs=0.01)
    for name, value in (MOTOR | {"step_voltage": 0.8}).items():
        assert found.parameters.value(name) == pytest.approx(value, rel=1e-12)


def test_the_speed_at_the_beginning() -> None:
    recording = check(made({}).between(0.53, 4.0))
    found = applied(recording, (), [])
    start = float(found.problem.unknowns.decode(found.theta[None])[1][0, 0])
    if found.problem.unknowns.turning[0]:
        assert abs(start - recording.speed[0]) < 0.1 * abs(recording.speed[0]) + 1.0
    assert np.array_equal(found.theta[:3], THETA)
    assert found.cost < 0.1 and found.problem.recordings == (recording,)


@pytest.mark.parametrize("phase", [2.0, -1.5])
def test_the_phase_of_a_ripple(phase: float) -> None:
    ripple = {"ripple_voltage": 0.4, "ripple_cycles": 5.3}
    recording = made(ripple | {"ripple_phase": phase})
    found = applied(recording, ("torque_ripple",), [0.4, 5.3, 0.0])
    assert abs(np.angle(np.exp(1j * (found.parameters.value("ripple_phase") - phase)))) < 0.2
    for name, value in (MOTOR | ripple).items():
        assert found.parameters.value(name) == pytest.approx(value, rel=1e-12)
