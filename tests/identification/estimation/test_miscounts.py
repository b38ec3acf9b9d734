"""Missed edges are recognised as whole slots and left out; where none are missed, none are found."""

import numpy as np
import pytest
from plant import profiles, record

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.miscounts import find_miscounts
from motor_identification.estimation.problem import make_problem
from motor_identification.identify import Request, SearchConfig, identify
from motor_identification.recording import Bools, check
from motor_model.parameters import PAPER_KA, PAPER_KV

TRUE = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.4}
THETA = np.array([np.log(PAPER_KV), np.log(PAPER_KA), 0.4])


def marked(motor: dict[str, float]) -> tuple[Bools, Bools]:
    """Intervals that are marked in a recording of this motor, and those that are miscounted."""
    recording, truth = record(TRUE | motor, *profiles.staircase(), irregularity=0.01, seed=3)
    problem = make_problem([check(recording)], ("coulomb_friction",))
    (data,) = problem.intervals
    (marks,) = find_miscounts(Estimate(problem, THETA))
    start, end = data.time[data.first], data.time[data.last]
    missed = np.searchsorted(truth.missed_time, end) - np.searchsorted(truth.missed_time, start)
    missed[data.slack > 0.0] = 0
    return marks, missed > 0


@pytest.mark.parametrize("miss_rate", [0.0, 0.003, 0.02])
def test_every_miscounted_interval_is_marked_and_no_other(miss_rate: float) -> None:
    marks, missed = marked({"miss_rate": miss_rate})
    assert np.array_equal(marks, missed)
    assert (marks.sum() > 5) == (miss_rate > 0.0)


@pytest.mark.parametrize(("torque", "least"), [(0.03, 1.0), (0.1, 0.97), (0.3, 0.9)])
def test_a_torque_that_moves_the_shaft_by_more_than_slots_hides_few_of_them(torque: float, least: float) -> None:
    """0.3 V over 50 ms are a fifth of a slot in 5 ms: 4 σ are more than half, but neighbours are off by as much."""
    marks, missed = marked({"miss_rate": 0.003, "random_torque": torque, "random_torque_time": 0.05})
    assert missed.sum() > 20
    assert np.mean(marks[missed]) >= least
    assert np.sum(marks & ~missed) <= 2


@pytest.mark.parametrize("miss_rate", [0.003, 0.02])
def test_the_motor_is_found_all_the_same_and_the_loss_is_said(miss_rate: float) -> None:
    recording, _ = record(TRUE | {"miss_rate": miss_rate}, *profiles.staircase(), irregularity=0.01, seed=4)
    fit = identify([check(recording)], Request(("coulomb_friction",), SearchConfig(particles=20)))
    for name, true in TRUE.items():
        assert fit.parameters.value(name) == pytest.approx(true, rel=2e-5)
    assert 0.008 < fit.slot_irregularity[0] < 0.012
    assert any("off by whole slots" in note for note in fit.notes)
    assert 0.9 < fit.residual_rms / fit.noise_floor < 1.1


def test_so_many_that_they_pull_the_first_fit_with_them() -> None:
    """3 % of the edges: every tenth interval is false, and a plain fit is off by 5 %."""
    recording, _ = record(TRUE | {"miss_rate": 0.03}, *profiles.staircase(12.0, 4, 0.25), irregularity=0.005, seed=0)
    fit = identify([check(recording)], Request(("coulomb_friction",), SearchConfig(particles=20)))
    for name, true in TRUE.items():
        assert fit.parameters.value(name) == pytest.approx(true, rel=3e-4)
    assert 0.9 < fit.residual_rms / fit.noise_floor < 1.15


def test_nothing_is_left_out_of_a_clean_recording() -> None:
    recording, _ = record(TRUE, *profiles.staircase(), irregularity=0.01, seed=5)
    fit = identify([check(recording)], Request(("coulomb_friction",), SearchConfig(particles=20)))
    assert fit.notes == ()
