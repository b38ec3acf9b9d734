"""Counts of one channel, or of both, of a simulated motor of known direction."""

from pathlib import Path

import numpy as np

from motor_identification.logs.signals import Floats, Signals

ROW, TAU, KV = 0.01, 0.06, 0.05  # s, s, V·s/rad
EDGES = 96
FINE = 20  # steps of the simulation in a row


def drive(rows: int, low: float = -4.0, high: float = 4.0) -> Floats:
    """Voltages [V] of two levels, each for a time of its own."""
    return np.where(np.random.default_rng(3).random(rows // 12 + 1) < 0.5, low, high).repeat(12)[:rows]


def turn(volts: Floats, ks: float = 0.0, load: float = 0.0) -> Floats:
    """Speeds [rad/s] at every step of a motor with friction and a constant load [V], from a standstill."""
    speeds, speed = np.empty(len(volts) * FINE), 0.0
    for k in range(len(speeds)):
        driven = volts[k // FINE] - load
        held = speed == 0.0 and abs(driven) <= ks
        after = speed if held else speed + ((driven - ks * np.sign(speed or driven)) / KV - speed) * ROW / FINE / TAU
        speed = 0.0 if ks and speed * after < 0.0 else after
        speeds[k] = speed
    return speeds


def counted(volts: Floats, speeds: Floats, both: bool = False) -> Signals:
    """The rows of a log: counts of one channel, or of both, at the instant at which each voltage begins."""
    way = np.cumsum(speeds if both else np.abs(speeds)) * ROW / FINE
    rows, unknown = len(volts), np.full(len(volts), np.nan)
    counts = np.floor(np.concatenate(([0.0], way[FINE - 1 :: FINE][:-1])) * EDGES / (2.0 * np.pi))
    time = np.arange(rows) * round(ROW * 1e9)
    return Signals(Path("l"), np.arange(rows), time, volts, counts, unknown, unknown, {"": slice(0, rows)})
