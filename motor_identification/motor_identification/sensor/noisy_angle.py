"""Find angles whose noise is more than a count: of a potentiometer, a resolver, positions that were computed.

A count of edges goes on or stands; only where the motor turns does it step back. An angle with noise steps forward and
back wherever the motor is slow.
"""

import numpy as np

from motor_identification.recording import Recording
from motor_identification.sensor.white_noise import estimate_white_noise

ALTERNATING = 0.05  # share of steps that go back, from which on they are noise: an encoder of 50 nm has 0.0015
LEAST_NOISE = 0.6  # counts: twice what counting makes; a shaft that trembles on an edge has less
MOST_BACK = 10.0  # times the noise that a step against both its neighbours usually is: larger ones are a wrap's


def find_angle_noise(recording: Recording) -> float:
    """Find the standard deviation [counts] of the white noise of sampled angles; 0 where they are counts of edges."""
    steps = np.diff(recording.edge_count)
    steps = steps[steps != 0]
    ways = np.sign(steps)
    if len(ways) < 2 or np.mean(ways[1:] != ways[:-1]) < ALTERNATING:
        return 0.0
    noise = estimate_white_noise(recording.edge_count.astype(np.float64), recording.voltage)
    alone = np.abs(steps[1:-1][(ways[1:-1] != ways[:-2]) & (ways[1:-1] != ways[2:])])
    wraps = len(alone) > 0 and float(np.median(alone)) > MOST_BACK * noise
    return noise if noise > LEAST_NOISE and not wraps else 0.0
