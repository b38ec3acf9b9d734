"""A motor under a random voltage as logs of speeds: by counts, or with white noise."""

from dataclasses import replace
from functools import cache

import numpy as np
from plant import Truth, profiles, record
from recorded import as_speed, without_count

from motor_identification.recording import Recording
from motor_model.parameters import PAPER_KA, PAPER_KV

RUBBING = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.5}


def recorded(seed: int = 0, edges: int = 960, sample_rate: float = 50.0) -> Recording:
    """Stamped edges of two channels, 20 s."""
    return _record(seed, edges, sample_rate)[0]


def noisy(sigma: float, seed: int = 0, digits: int = 9, instant: bool = False, **motor: float) -> Recording:
    """Speeds, means over the sample period or of its end, that are exact but for white noise, with so many digits."""
    recording, truth = _record(seed, 6, 50.0, **motor)
    logged = as_speed(recording)
    exact = truth.speed if instant else np.diff(truth.angle, prepend=0.0) / logged.info.speed_window
    speed = exact + sigma * np.random.default_rng(seed).standard_normal(len(exact))
    return without_count(replace(logged, speed=np.round(speed, digits)))


@cache
def _record(seed: int, edges: int, sample_rate: float, **motor: float) -> tuple[Recording, Truth]:
    drive = profiles.random(6.0, 20.0, seed=seed)
    return record(RUBBING | motor, *drive, seed=seed, edges=edges, sample_rate=sample_rate, single_channel=False)


def held_late(recording: Recording, rows: int, late: int) -> Recording:
    """A log with so many rows for each of the recording's, which repeat what was measured so many rows before."""
    period = round(recording.info.sample_period * 1e9) // rows
    count = rows * (len(recording) - 1) + 1
    row = np.arange(count)
    log = recording.at_rows(row // rows)
    seen = np.maximum(row // rows * rows - late, 0) / rows
    measured = np.interp(seen, np.arange(len(recording)), recording.speed)
    seconds = period * 1e-9
    info = replace(recording.info, sample_period=seconds, speed_window=seconds, speed_lag=0.5 * seconds)
    stamps = recording.sample_time[0] + period * row
    return replace(log, info=info, sample_time=stamps.astype(np.int64), speed=measured)
