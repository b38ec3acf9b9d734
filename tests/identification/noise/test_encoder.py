"""What encoder and disc leave is learned from the increments of the true motor."""

from dataclasses import replace

import numpy as np
import pytest
from plant import profiles, record
from small import THETA, TRUE

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.problem import make_problem
from motor_identification.noise.encoder import Encoder, learn_encoder
from motor_identification.recording import check


def learned(irregularity: float, slots: bool = True) -> tuple[Encoder, np.ndarray]:
    """The encoder of a staircase, and the increments that the true motor leaves."""
    drive = profiles.staircase(10.0, 3, 0.25)
    recording = check(record(TRUE, *drive, seed=1, irregularity=irregularity, disc_seed=2)[0])
    estimate = Estimate(make_problem([recording], ("coulomb_friction",)), THETA)
    (data,), (increments,), (angle,) = estimate.problem.intervals, estimate.increments, estimate.angles
    data = data if slots else replace(data, slot=0.0)
    return learn_encoder(data, increments, angle, first_harmonic=True), increments


@pytest.mark.parametrize("irregularity", [0.003, 0.02])
def test_the_disc_is_learned_and_the_rest_is_white(irregularity: float) -> None:
    encoder, increments = learned(irregularity)
    assert encoder.irregularity == pytest.approx(irregularity, rel=0.2) and encoder.drift < 1e-9
    assert encoder.slot_sigma == pytest.approx(irregularity * encoder.slot, rel=0.2)
    white = encoder.white(increments)
    assert 0.8 < np.sqrt(np.mean(white**2)) < 1.1


def test_without_slots_there_is_no_table() -> None:
    encoder, increments = learned(0.01, slots=False)
    assert encoder.projection is None and encoder.slot == 0.0 and np.isnan(encoder.irregularity)
    assert np.array_equal(encoder.white(increments).shape, increments.shape)


def test_the_pull_is_the_transpose() -> None:
    """Of what is left beside a table whose own prior is not counted."""
    encoder, increments = learned(0.008)
    bare = replace(encoder, projection=None)
    x, z = np.random.default_rng(0).standard_normal((2, len(increments)))
    assert z @ bare.white(x) == pytest.approx(bare.pull(z) @ x, rel=1e-9)
