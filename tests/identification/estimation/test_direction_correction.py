"""Directions that a single channel does not report: the fitted motion knows them where the reported sign is late."""

import numpy as np
import pytest
from plant import profiles, record

from motor_identification.estimation.direction_correction import choose_directions, correct_directions
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.problem import make_problem
from motor_identification.identify import Request, SearchConfig, identify
from motor_identification.recording import check
from motor_model.excitation import PROFILES
from motor_model.parameters import PAPER_KA, PAPER_KV

TIME = np.arange(0.0, 4.0, 0.005)
CASES = {
    "a slow bridge": ({"ks": 0.3, "delay": 0.02}, ("coulomb_friction", "transport_delay")),
    "a load that drives": ({"ks": 0.3, "bias_voltage": 0.8}, ("coulomb_friction", "load_bias")),
}


def test_the_simulated_sign_counts_where_it_is_sure() -> None:
    reported = np.array([1, 1, -1, 0, 0, -1])
    simulated = np.array([9.0, -9.0, -1.0, 5.0, 1.0, 1.0])
    assert choose_directions(reported, simulated, 2.0).tolist() == [1, -1, -1, 1, 0, 0]


@pytest.mark.parametrize("case", CASES)
def test_no_wrong_direction_is_kept_and_the_motor_is_found(case: str) -> None:
    extra, effects = CASES[case]
    values = {"kv": PAPER_KV, "ka": PAPER_KA} | extra
    recording, truth = record(values, TIME, PROFILES["chirp"].voltage(TIME, 10.0), irregularity=0.01, seed=1)
    whole = make_problem([check(recording)], effects)
    theta = np.array([np.log(PAPER_KV), np.log(PAPER_KA), *extra.values()])
    kept = {}
    for name, problem in (("reported", whole), ("judged", correct_directions(Estimate(whole, theta)).problem)):
        (data,) = problem.intervals
        moving = data.edge[:, 0] >= 0
        ends = data.time[np.column_stack([data.first, data.last])][moving]
        true = truth.edge_direction[np.searchsorted(truth.edge_time, ends - 1e-5)]
        wrong = np.sign(data.speed[moving])[:, None] != true
        kept[name] = (len(ends), int(wrong.any(axis=1).sum()))
    assert kept["judged"][1] == 0
    assert kept["judged"][0] > 0.9 * kept["reported"][0]
    assert case != "a slow bridge" or kept["reported"][1] > 20  # what the sign alone would have let in

    fit = identify([check(recording)], Request(effects, SearchConfig(particles=30)))
    assert not any("whole slots" in note for note in fit.notes)
    for name, true in values.items():
        assert fit.parameters.value(name) == pytest.approx(true, rel=5e-4)


def test_a_long_stretch_read_the_wrong_way_is_read_again_and_not_left_out() -> None:
    """Without friction the shaft swings through its stops: for 1.5 s the reported sign is the other one here."""
    values = {"kv": 0.0789817, "ka": 0.00463544}
    recording, truth = record(values, *profiles.random(12.0, 14.0, 500), seed=77, irregularity=0.006, disc_seed=640)
    whole = make_problem([check(recording)], ())
    estimate = Estimate(whole, np.log([values["kv"], values["ka"]]))
    assert np.sqrt(estimate.cost) > 20.0  # [rad/s]
    again = correct_directions(estimate)
    (data,) = again.problem.intervals
    reversals = np.count_nonzero((truth.reversal_time > 0.0) & (truth.reversal_time < 14.0))
    assert 0 < data.left_out < 3 * reversals
    assert 0.1 < np.sqrt(again.cost) < 0.4  # the disc
