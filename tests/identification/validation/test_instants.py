"""Instants are parameters of a recording, and are tried at many times of it, one after the other."""

from dataclasses import replace

import numpy as np
from small import THETA, small_recording

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.problem import make_problem
from motor_identification.validation.instants import (
    list_first_motions,
    list_instant_columns,
    list_instants,
    needs_instant,
    try_instants,
)
from motor_model.effects import EFFECT_BY_NAME


def test_a_load_step_alone_begins_at_an_instant() -> None:
    """A warming-up takes a time that is the motor's, and the phases of a recording are no times."""
    assert [name for name in EFFECT_BY_NAME if needs_instant(name)] == ["load_step"]


def test_every_recording_has_an_instant_of_its_own() -> None:
    recordings = [small_recording(), small_recording()]
    problem = make_problem(recordings, ("coulomb_friction", "load_step"))
    columns = list_instant_columns(problem, problem.unknowns.effects)
    assert columns == [(4, recordings[0].duration), (5, recordings[1].duration)]
    assert list_instant_columns(problem, ["coulomb_friction"]) == []
    assert list_instants(Estimate(problem, np.array([*THETA, 0.5, 0.7, 1.1]))) == ([0.7], [1.1])
    assert list_instants(Estimate(problem.with_effects(("coulomb_friction",)), THETA)) == ([], [])


def test_nothing_is_told_before_a_motor_is_driven_or_moves() -> None:
    late = small_recording()
    first = float(late.time[len(late.time) // 2])
    voltage = np.where(late.time < first, 0.0, 6.0)
    voltage[3] = 0.01  # of what is left of a command, nobody is driven
    late = replace(late, voltage=voltage)
    problem = make_problem([late], ())
    (data,) = problem.intervals
    moved = replace(data, speed=np.where(data.time[data.first] < 0.5 * first, 0.0, 3.0))
    still = replace(data, speed=np.zeros_like(data.speed))
    assert list_first_motions(replace(problem, intervals=(still,))) == (first,)
    (begun,) = list_first_motions(replace(problem, intervals=(moved,)))
    assert 0.5 * first <= begun < 0.75 * first


def test_the_best_of_the_times_that_are_tried() -> None:
    begin = np.array([0.5, 9.5, 8.0])
    found, least = try_instants(lambda theta: abs(float(theta[1]) - 7.2), begin, 1, 10.0, 21)
    assert np.array_equal(found, [0.5, 7.0, 8.0]) and abs(least - 0.2) < 1e-12
    assert try_instants(lambda theta: 0.0, begin, 2, 10.0, 21)[0][2] == 0.0  # of equals the first
    assert np.array_equal(begin, [0.5, 9.5, 8.0])
