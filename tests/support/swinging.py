"""A motor under a random voltage as logs of speeds: by counts, or with white noise."""

from dataclasses import replace

import numpy as np
from plant import Truth, profiles, record
from recorded import as_speed, without_count

from motor_identification.recording import Recording
from motor_model.parameters import PAPER_KA, PAPER_KV

RUBBING = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.5}


def recorded(seed: int = 0, edges: int = 960, sample_rate: float = 50.0) -> Recording:
    """Stamped edges of two channels, 20 s."""
    return _record(seed, edges, sample_rate)[0]


def noisy(sigma: float, seed: int = 0, digits: int = 9) -> Recording:
    """Speeds, means over the sample period, that are exact but for white noise, printed with so many digits."""
    recording, truth = _record(seed, 6, 50.0)
    logged = as_speed(recording)
    exact = np.diff(truth.angle, prepend=0.0) / logged.info.speed_window
    speed = exact + sigma * np.random.default_rng(seed).standard_normal(len(exact))
    return without_count(replace(logged, speed=np.round(speed, digits)))


def _record(seed: int, edges: int, sample_rate: float) -> tuple[Recording, Truth]:
    drive = profiles.random(6.0, 20.0, seed=seed)
    return record(RUBBING, *drive, seed=seed, edges=edges, sample_rate=sample_rate, single_channel=False)
