"""The plant in a closed loop: at every sample a law sees what the board reports and answers with a voltage.

A voltage is latched at the sample after the one it answers, as messages have it. The motor is moved from sample to
sample, and a motor without memory needs no more than its speed for that; what remembers more (a delay, a current, a
play, heat) is refused. The recording is then that of an open-loop run under the voltages that were latched.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from motor_identification.recording import Recording
from motor_model.errors import ModelError
from motor_model.sample import Sample

from .board import STANDSTILL, SignOfOneChannel
from .encoder import Disc, edges_of
from .motor import move_plant
from .parameters import Values, record_of
from .recording import RECORDED_STEP, Truth, record

Floats = NDArray[np.float64]
Law = Callable[[Sample], float]  # remembers what it needs; [V]
START = 1_000_000_000  # [ns] on the board's clock at the first sample
TICK = 4e-6  # [s] of its timer
WITHOUT_MEMORY = {
    *("kv", "ka", "ks", "breakaway_voltage", "stribeck_speed", "drag", "bias_voltage", "dead_zone_voltage"),
    *("limit_voltage", "reverse_gain", "coast_share", "sag", "max_voltage"),
}


@dataclass
class _Board:
    """One channel's counter, stamps and claimed speed, edge by edge; see `board.report`, which does it all at once."""

    slot: float  # [rad]
    rule: SignOfOneChannel
    count: int = 0
    stamp: int = 0  # [ns]
    period: float = 0.0  # [s]

    def edge(self, time: float) -> None:
        """An edge at `time` [s] on the board's clock."""
        stamp = round(np.floor(time / TICK + 1e-9) * TICK * 1e9)
        period = (stamp - self.stamp) * 1e-9 if self.count else 0.0
        self.rule.edge(period, self.count == 0 or stamp - self.stamp > STANDSTILL)
        self.count, self.stamp, self.period = self.count + 1, stamp, period

    def sample(self, now: int, voltage: float) -> Sample:
        """The report at `now` [ns], where this voltage is latched."""
        since = now - self.stamp
        moving = self.count > 1 and since <= STANDSTILL and self.period > 0.0
        speed = self.rule.sign * self.slot / max(self.period, since * 1e-9) if moving else 0.0
        self.rule.voltage(voltage)
        return Sample(now, speed, voltage, self.count, self.stamp, self.period if self.count > 1 else 0.0)


def close_loop(
    parameters: Values,
    law: Law,
    duration: float,
    *,
    sample_rate: float = 200.0,
    edges: int = 96,
    irregularity: float = 0.0,
    disc_seed: int = 0,
    start_angle: float = 0.0,
    name: str = "loop",
) -> tuple[Recording, Truth]:
    """Run the plant under a law and record it; arguments as those of `record`.

    Raises:
        ModelError: a parameter that makes the motor remember more than its speed.
    """
    disc = Disc.cut(edges, irregularity, disc_seed)
    latched = answered(parameters, law, duration, disc, start_angle, sample_rate)
    times = np.arange(len(latched)) * round(1e9 / sample_rate) * 1e-9
    return record(
        parameters,
        times,
        latched,
        sample_rate=sample_rate,
        edges=edges,
        irregularity=irregularity,
        disc_seed=disc_seed,
        start_angle=start_angle,
        name=name,
    )


def answered(
    parameters: Values, law: Law, duration: float, disc: Disc, start_angle: float, sample_rate: float = 200.0
) -> Floats:
    """[V] latched at every sample of a plant under a law, from rest; the disc stands at `start_angle` [rad].

    Raises:
        ModelError: a parameter that makes the motor remember more than its speed.
    """
    remembering = sorted(set(parameters) - WITHOUT_MEMORY)
    if remembering:
        raise ModelError(f"The closed loop cannot have {', '.join(remembering)}: leave it out.")
    p = record_of(parameters)
    period, limit = round(1e9 / sample_rate), float(p["max_voltage"])
    both = np.array([0.0, period * 1e-9])
    board = _Board(2.0 * np.pi / len(disc.begin), SignOfOneChannel())
    speed, angle, answer = 0.0, start_angle, 0.0
    latched = []
    for k in range(round(duration * sample_rate) + 1):
        volts = min(max(answer, -limit), limit)
        latched.append(volts)
        answer = law(board.sample(START + k * period, volts))
        motion = move_plant(p, both, np.array([volts, volts]), speed, RECORDED_STEP)
        for time in edges_of(motion, disc, start_angle=angle).time:
            board.edge(START * 1e-9 + (k * period * 1e-9 + float(time)))
        speed, angle = float(motion.speed[-1]), angle + float(motion.angle[-1])
    return np.array(latched)
