"""A linear servo axis: a scale of 50 nm read 1,000 times a second; friction, an offset and a small random force."""

from dataclasses import replace
from math import tau

import numpy as np
from plant import Truth, profiles, record

from motor_identification.recording import Recording, check
from motor_model.sample import Measurement

SCALE = 5e-8  # [m], as if a metre were a radian
AXIS = {"kv": 20.0, "ka": 2.0, "ks": 1.0, "bias_voltage": 0.3}
FORCE = {"random_torque": 0.02, "random_torque_time": 0.05}


def record_servo(
    seed: int = 0, duration: float = 20.0, noise: float = 0.0, scale: float = SCALE
) -> tuple[Recording, Truth]:
    """Positions of the axis as counts of its scale, with white noise [m] if wanted, and the truth."""
    drive = profiles.random(5.0, duration, seed=seed)
    motor = AXIS | FORCE | {"random_torque_seed": float(seed)}
    recording, truth = record(motor, *drive, seed=seed, edges=6, sample_rate=1000.0, single_channel=False)
    angle = truth.angle + noise * np.random.default_rng(seed).standard_normal(len(truth.angle))
    count = np.floor(angle / scale).astype(np.int64)
    info = replace(
        recording.info,
        source="import",
        measurement=Measurement.COUNTS,
        edges_per_revolution=round(tau / scale),
        edge_resolution=0.0,
    )
    speed = np.diff(count, prepend=count[0]) * scale * 1000.0
    unstamped = np.zeros_like(count)
    counted = replace(recording, info=info, edge_count=count, speed=speed, edge_time=unstamped)
    return check(replace(counted, edge_period=np.zeros(len(count)))), truth
