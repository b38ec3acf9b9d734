"""A problem that is solved in milliseconds: half a second of a motor with known parameters."""

from functools import cache

import numpy as np
from plant import profiles, record

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.problem import Problem, make_problem
from motor_identification.recording import Floats, Recording, check
from motor_model.parameters import PAPER_KA, PAPER_KV

TRUE = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.4}
THETA = np.array([np.log(PAPER_KV), np.log(PAPER_KA), 0.4])


@cache
def small_recording(seed: int = 0, irregularity: float = 0.005) -> Recording:
    """Two levels of voltage either way."""
    drive = profiles.pieces([9.0, 4.0, -9.0], 0.25)
    return check(record(TRUE, *drive, seed=seed, irregularity=irregularity, name=f"small {seed}")[0])


def small_problem(seed: int = 0, effects: tuple[str, ...] = ("coulomb_friction",)) -> Problem:
    return make_problem([small_recording(seed)], effects)


def small_estimate(theta: Floats = THETA, seed: int = 0) -> Estimate:
    """At the truth, unless told otherwise; nothing is fitted."""
    return Estimate(small_problem(seed), theta)
