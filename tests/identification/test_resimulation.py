"""A diagnosed model, simulated by the independent plant, leaves the gap that was reported, by its definition."""

import numpy as np
import pytest
from plant import profiles, record
from plant.motor import move
from plant.score import score

from motor_identification.diagnose import diagnose
from motor_identification.recording import check
from motor_model.parameters import PAPER_KA, PAPER_KV

BASE = {"kv": 1.1 * PAPER_KV, "ka": 0.9 * PAPER_KA}
DISC = {"irregularity": 0.006, "disc_seed": 5}


@pytest.mark.slow
def test_the_plant_reproduces_the_reported_gap() -> None:
    hidden = {"dead_zone_voltage": 0.5}
    train, _ = record(BASE | hidden, *profiles.compact(), seed=1, **DISC)  # type: ignore[arg-type]
    kept, truth = record(BASE | hidden, *profiles.random(12.0, 10.0, 7), seed=2, **DISC)  # type: ignore[arg-type]
    found = diagnose([check(train)], [check(kept)])
    assert len(found.findings) == 1
    again = score(kept, move(found.model.parameters.values, kept.time, kept.voltage))
    assert again.gap() / found.gap_after == pytest.approx(1.0, abs=0.01)
    assert score(kept, truth.motion).gap() / found.gap_after == pytest.approx(1.0, abs=0.01)
    assert again.floor(DISC["irregularity"]) / found.noise_floor == pytest.approx(1.0, abs=0.15)
    assert 0.8 < again.gap() / again.floor(DISC["irregularity"]) < 1.25
    before = score(kept, move(found.baseline.parameters.values, kept.time, kept.voltage))
    assert before.gap() / found.gap_before == pytest.approx(1.0, abs=0.2)  # where it turns is then not known so well
    assert before.gap() > 5.0 * again.gap()


def test_the_score_is_the_definition() -> None:
    """A motor that is 2 % too fast is 2 % of the speed off, and a true one is as far off as its timer and slots are."""
    varied, truth = record(BASE, *profiles.random(12.0, 6.0, 3), seed=3)
    exact = score(varied, truth.motion)
    assert 0.85 < exact.gap() / exact.floor(0.0) < 1.15 and exact.gap() < 0.2
    kept, _ = record(BASE, *profiles.step(8.0, 3.0), seed=3)
    fast = {"kv": BASE["kv"] / 1.02, "ka": BASE["ka"] / 1.02}
    faster = score(kept, move(fast, kept.time, kept.voltage))
    assert faster.gap(faster.start > 0.5) == pytest.approx(0.02 * 8.0 / BASE["kv"], rel=0.01)
    still = {"kv": BASE["kv"], "ka": BASE["ka"], "ks": 11.0}  # holds at 8 V: every edge is one too many
    stuck = score(kept, move(still, kept.time, kept.voltage))
    assert stuck.residual[stuck.start > 0.5].mean() == pytest.approx(-8.0 / BASE["kv"], rel=0.02)
    idle, _ = record(BASE | {"ks": 0.5}, np.array([0.0, 3.0]), np.array([0.4, 0.4]), seed=4)
    slow = score(idle, move(BASE, idle.time, idle.voltage))  # no edge came, where the model turns
    assert slow.slots.sum() == 0.0 and not slow.counts.any()  # it begins in a block that does not count
    travel = 0.4 / BASE["kv"] * (3.0 - BASE["ka"] / BASE["kv"])
    assert slow.residual == pytest.approx((travel - 2.0 * np.pi / 96) / 3.0, rel=1e-3)
