"""An irregular disc tells where on it every counted run was; a perfect one tells nothing, and is left alone."""

from dataclasses import replace

import numpy as np
import pytest
from plant import profiles, record

from motor_identification.estimation.direction_correction import correct_directions
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.whitened_fit import learn_encoders
from motor_identification.noise.angle_noise import whiten
from motor_identification.noise.encoder import Encoder
from motor_identification.noise.slots.alignment import FARTHEST, align_slots
from motor_identification.noise.slots.slot_table import SlotTable
from motor_identification.recording import check
from motor_model.parameters import PAPER_KA, PAPER_KV

TRUE = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.4}
THETA = np.array([np.log(PAPER_KV), np.log(PAPER_KA), 0.4])


def reversing(irregularity: float) -> tuple[Encoder, np.ndarray, np.ndarray]:
    """What is learned of an encoder in nine runs, its whitened residuals, and its table [rad]."""
    recording, _ = record(TRUE, *profiles.reversals(8.0, 9, 0.3), irregularity=irregularity, seed=4, disc_seed=4)
    task = make_problem([check(recording)], ("coulomb_friction",))
    (encoder,) = learn_encoders(Estimate(task, THETA))
    assert encoder.projection is not None
    white = whiten(encoder.whitening, task.increments(THETA)[0])
    return encoder, white, encoder.projection.best(white)


def slipped(encoder: Encoder, slips: list[int]) -> SlotTable:
    """The table as if every counted run had been placed so many slots too far."""
    assert encoder.projection is not None
    table = encoder.projection.table
    n = table.index.size // 2
    run = np.cumsum(table.whitening.fresh) - 1
    by = np.resize(slips, run[-1] + 1)[run]
    first, last = (np.where(e < 0, e, e // n * n + (e % n + by) % n) for e in (table.index.first, table.index.last))
    return replace(table, index=replace(table.index, first=first, last=last))


@pytest.mark.parametrize("slips", [[0], [0, 3], [0, -2, 5, 1], [0, 0, FARTHEST, FARTHEST]])
def test_every_run_is_put_where_its_slots_are(slips: list[int]) -> None:
    encoder, white, offsets = reversing(0.01)
    assert encoder.projection is not None
    truth = encoder.projection.table.index
    table = slipped(encoder, slips)
    found = align_slots(table, white, offsets)
    assert np.array_equal(found.first, truth.first) and np.array_equal(found.last, truth.last)
    assert (found is table.index) == (slips == [0])


def test_a_perfect_disc_has_nothing_to_tell() -> None:
    encoder, white, offsets = reversing(0.0)
    table = slipped(encoder, [0, 3])
    assert align_slots(table, white, offsets) is table.index


def swinging(irregularity: float) -> Estimate:
    """A fit that lacks a ripple, on which a motor without friction swings where it should stand."""
    values = {"kv": 0.06, "ka": 0.0059, "ripple_voltage": 0.3, "ripple_cycles": 11.626, "ripple_phase": 1.0}
    recording = check(record(values, *profiles.compact(12.0, 6), seed=6, irregularity=irregularity, disc_seed=9)[0])
    bare = fit_speeds(Estimate(make_problem([recording], ()), np.log([values["kv"], values["ka"]])))
    return fit_speeds(correct_directions(bare))


def test_slots_are_learned_through_swings_that_no_channel_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    estimate = swinging(0.01)
    (encoder,) = learn_encoders(estimate)
    assert 0.009 < encoder.irregularity < 0.011
    monkeypatch.setattr("motor_identification.noise.encoder.align_slots", lambda table, white, offsets: table.index)
    (blurred,) = learn_encoders(estimate)
    assert blurred.irregularity < 0.8 * encoder.irregularity  # it takes the rest for drift
    assert blurred.drift > encoder.drift
