"""Recordings written down by hand: a disc that turns as a formula says, seen exactly."""

from collections.abc import Callable
from math import tau

import numpy as np

from motor_identification.recording import Floats, Recording
from motor_model.sample import Info, Measurement

PERIOD = 0.005  # [s] of the samples
SLOTS = 96


def turning(
    slots: Callable[[Floats], Floats],
    duration: float,
    measurement: Measurement = Measurement.EDGES,
    voltage: float = 6.0,
    period: float = PERIOD,
) -> Recording:
    """A disc that has turned slots(t) slots, growing, at t [s]: two channels, a timer without a tick.

    The flanks lie at whole numbers of slots, and the first sample is just after one.
    """
    time = period * np.arange(round(duration / period) + 1)
    fine = np.linspace(0.0, float(time[-1]), 200_001)
    turned = slots(fine)
    count = np.floor(slots(time) + 1e-9).astype(np.int64)
    stamps = np.interp(np.arange(count[-1] + 1), turned, fine)
    stamped = np.round(stamps * 1e9).astype(np.int64)
    seen = count > 0
    two = count > 1
    rate = np.gradient(turned, fine)
    speed = np.interp(time, fine, rate) * tau / SLOTS
    before = np.where(two, stamped[count] - stamped[np.maximum(count - 1, 0)], 0)
    return Recording(
        uri="by hand",
        info=Info(
            measurement=measurement, edges_per_revolution=SLOTS, single_channel=False, edge_resolution=0.0,
            sample_period=period,
        ),
        sample_time=np.round(time * 1e9).astype(np.int64),
        voltage=np.full(len(time), voltage),
        speed=speed,
        edge_count=count,
        edge_time=np.where(seen, stamped[count], 0),
        edge_period=before * 1e-9,
        supply_voltage=np.full(len(time), np.nan),
        current=np.full(len(time), np.nan),
    )  # fmt: skip
