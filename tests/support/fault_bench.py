"""Feed the checks for faults with rows of motion, without a loop around them."""

from math import inf, tau

from motor_control.controller.faults import detection
from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.motion import Motion, follow_motion
from motor_model.sample import Sample

LIMIT, SLOT = 12.0, tau / 96
ENCODER = Config(slot=SLOT)
KNOWN = Config(slot=SLOT, fastest=174.0, kv=0.066, time_constant=0.08, friction=0.5)
Row = tuple[float, float, float]  # speed [rad/s], voltage [V], edges a second


def feed(rows: list[Row], config: Config, reference: float = 100.0, period: float = 0.005) -> tuple[str, float]:
    """The first reason, and when [s]; edges come evenly."""
    state, motion, edges = detection.State(), Motion(), 0.0
    for k, (speed, voltage, rate) in enumerate(rows):
        edges += rate * period
        sample = Sample(round(k * period * 1e9), speed, voltage, int(edges), edge_period=1.0 / rate if rate else 0.0)
        motion = follow_motion(motion, sample, config.slot, period, LIMIT)
        seen = Seen(sample, speed, motion, reference, period, LIMIT)
        reason, state = detection.find_fault(config, state, seen)
        if reason:
            return reason, k * period
    return "", inf


def turning(speed: float, voltage: float) -> Row:
    return speed, voltage, abs(speed) / SLOT


LOST = [turning(100.0, 7.3)] * 200  # a steady motion, before a line is lost
