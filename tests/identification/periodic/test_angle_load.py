"""An arm that hangs on the shaft is found together with the motor that it is on, and nothing where none hangs."""

import numpy as np
import pytest
from plant import profiles, record
from recorded import as_counts

from motor_identification.diagnose import diagnose
from motor_identification.diagnosis.result import Verdict
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.problem import Problem, make_problem
from motor_identification.measurement.measured_angle import Track
from motor_identification.periodic.angle_load import AngleLoad, find_angle_load
from motor_identification.periodic.periodic_fit import measure_angles
from motor_identification.periodic.ripple_spectrum import USUAL_RIPPLE
from motor_identification.recording import Recording, check
from motor_model.parameters import PAPER_KA, PAPER_KV

SLOW = {"kv": 6.0 * PAPER_KV, "ka": 30.0 * PAPER_KA, "ks": 0.2}
LARGEST = 12.0  # V
WEIGHTS = (5.0, 15.0)  # V: the motor turns the first one over, and only swings the second


def recorded(weight: float, phase: float = 0.5, seed: int = 1) -> Recording:
    """Counts of two channels, 100 a second, of a motor with a load once a turn."""
    load = {"ripple_voltage": weight, "ripple_cycles": 1.0, "ripple_phase": phase}
    drive = profiles.rich(LARGEST, seed=3)
    one = record(SLOW | load, *drive, seed=seed, edges=1024, sample_rate=100.0, single_channel=False)[0]
    return check(as_counts(one))


def measured(*recordings: Recording) -> tuple[Problem, tuple[Track, ...]]:
    """A problem of a motor alone, and angles as an ordinary one bridges their gaps."""
    problem = make_problem(recordings, ())
    bare = Estimate(problem, np.log([SLOW["kv"], SLOW["ka"]]), 0)
    return problem, measure_angles(bare, ("torque_ripple",))


def found(weight: float, *phases: float) -> AngleLoad | None:
    problem, tracks = measured(*(recorded(weight, phase, seed) for seed, phase in enumerate(phases)))
    return find_angle_load(problem, tracks, USUAL_RIPPLE * LARGEST)


@pytest.mark.parametrize("weight", WEIGHTS)
def test_an_arm_and_its_motor_are_found_at_once(weight: float) -> None:
    phases = (0.5, -2.0)
    load = found(weight, *phases)
    assert load is not None
    assert load.amplitude == pytest.approx(weight, rel=0.05)
    assert load.kv == pytest.approx(SLOW["kv"], rel=0.1) and load.ka == pytest.approx(SLOW["ka"], rel=0.05)
    assert load.phases == pytest.approx(phases, abs=0.1) and load.share > 0.9


@pytest.mark.parametrize(("weight", "there"), [(0.0, False), (0.8 * USUAL_RIPPLE * LARGEST, False), (5.0, True)])
def test_what_a_ripple_may_be_is_left_to_the_spectrum(weight: float, there: bool) -> None:
    assert (found(weight, 0.5) is not None) is there


def test_too_few_rows_tell_of_no_load() -> None:
    problem, tracks = measured(recorded(WEIGHTS[0]))
    few = problem.without(tuple(data.time[data.first] > 0.05 for data in problem.intervals))
    assert sum(len(data.first) for data in few.intervals) < 10
    assert find_angle_load(few, tracks, 0.0) is None


@pytest.mark.slow
@pytest.mark.parametrize("weight", WEIGHTS)
def test_an_arm_is_named_with_its_weight(weight: float) -> None:
    diagnosis = diagnose([recorded(weight)])
    first = diagnosis.findings[0]
    assert diagnosis.verdict is Verdict.EXPLAINED and first.effect == "torque_ripple"
    assert first.parameters["ripple_voltage"][0] == pytest.approx(weight, rel=0.02)
    assert first.parameters["ripple_cycles"][0] == pytest.approx(1.0, abs=0.02)
