"""Count missed edges: intervals that a complete model sees short by whole slots.

Where as many are long, or off by anything, it is the simulated motion that left the true one now and then. Where many
edges come in a row, they tell it themselves: `sensor/pulses/missed_edges.py`.
"""

from dataclasses import dataclass
from math import sqrt

import numpy as np

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model


@dataclass(frozen=True)
class MissedEdges:
    """Edges that held-out intervals lack."""

    short: float  # edges that are missing
    counted: float  # edges that are not
    odd: int  # intervals that are far off otherwise

    @property
    def rate(self) -> float:
        """Share of all edges that was missed."""
        return self.short / (self.counted + self.short)

    @property
    def rate_error(self) -> float:
        """Standard error of that share: edges are missed one by one."""
        return sqrt(self.short) / (self.counted + self.short)

    @property
    def certain(self) -> bool:
        """Whether edges are missing, rather than a few stamps wrong or a motion astray."""
        return self.short >= thresholds.LEAST_MISSED_EDGES and self.odd <= thresholds.MOST_ODD * self.short


def count_missed_edges(model: Model) -> MissedEdges | None:
    """Count the edges that held-out intervals are short of under a model; None where angles have no slots."""
    held = model.held
    short = counted = 0.0
    odd = 0
    for data, increments, scatter in zip(held.intervals, held.increments, model.scatter_of_travel(), strict=True):
        if data.slot == 0.0:
            return None
        edges = (data.slack == 0.0) & (data.edge[:, 0] >= 0)
        surprising = np.abs(increments) > thresholds.MISSED_EDGE_SIGMA * scatter  # no random torque did it
        size = np.abs(increments) / data.slot
        slots = np.round(size) * np.sign(increments * data.speed)
        near = np.abs(size - np.round(size)) < np.clip(2.0 * scatter / data.slot, *thresholds.WHOLE_SLOT)
        short += float(np.sum(slots[edges & surprising & (slots > 0.0)]))
        odd += int(np.count_nonzero(edges & surprising & ~(near & (slots > 0.0))))
        counted += float(np.sum(np.abs(data.edge[edges, 1] - data.edge[edges, 0])))
    return MissedEdges(short, counted, odd)
