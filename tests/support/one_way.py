"""A motor that turns one way, on levels of the voltage, as noisy speeds: a friction and a drag hide each other."""

from dataclasses import replace
from functools import cache

import numpy as np
from plant import profiles, record
from recorded import as_speed, without_count

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.problem import make_problem
from motor_identification.recording import Recording, check
from motor_model.parameters import PAPER_KA, PAPER_KV

HIDING = {"ks": 0.5, "drag": 7e-5}  # beside a wrong kv nothing is left of either: their mean is that of a gain


def noisy_levels(seed: int, sigma: float = 1.0, **hidden: float) -> Recording:
    """Speeds, means over the sample period, with white noise [rad/s]: 24 levels of 3 to 12 V, 14 s."""
    volts = np.random.default_rng(5).permutation(np.linspace(3.0, 12.0, 24))
    drive = profiles.pieces(volts, 0.6)
    motor = {"kv": PAPER_KV, "ka": PAPER_KA} | hidden
    recording, truth = record(motor, *drive, seed=seed, edges=6, sample_rate=50.0, single_channel=False)
    log = as_speed(recording)
    exact = np.diff(truth.angle, prepend=0.0) / log.info.speed_window
    noise = sigma * np.random.default_rng(seed).standard_normal(len(exact))
    return check(without_count(replace(log, speed=exact + noise)))


@cache
def fit_levels(seed: int, **hidden: float) -> Estimate:
    """The two-coefficient motor, fitted to that."""
    problem = make_problem([noisy_levels(seed, **hidden)], ())
    return fit_speeds(Estimate(problem, np.log([PAPER_KV, PAPER_KA])))
