"""Tell the mains' hum by the rhythm of its edges: evenly, and at the rate of the mains.

A line that nobody holds picks up 50 or 60 Hz, or twice that from a rectifier. Its edges are as regular as those of a
motor at a steady speed, and more: the slots of a disc are irregular, by 1 % and more where they are few, and a motor's
speed changes with its load and its voltage. What is left are motors on a very even disc that happen to turn at such a
rate; so a rhythm alone is no fault, but with what else is known of the motor it may be one.
"""

from dataclasses import dataclass

from motor_model.sample import Sample

MAINS = (50.0, 60.0, 100.0, 120.0)  # [Hz] and what a rectifier makes of it
WITHIN = 0.015  # the mains are off by 1 %, a board's resonator by 0.5 %
EDGES = 10.0  # over which the rhythm is averaged, and that it takes
# RMS scatter of periods, share of their mean. Hum whose crossings tremble by 0.3 % of a period has 0.42 %; of a disc
# that is irregular by 1 % it is 1 % and more.
EVEN = 0.006
ANEW = 0.05  # share by which a period is another rhythm's
LATE = 2.0  # periods without an edge after which the rhythm is over


def is_mains(rate: float) -> bool:
    """Tell whether a rate [1/s] is one of the mains."""
    return any(abs(rate / mains - 1.0) < WITHIN for mains in MAINS)


@dataclass(frozen=True, slots=True)
class Rhythm:
    """The latest edges; times in ns are the plant's."""

    sample_time: int = 0  # [ns]
    count: int = 0
    edge_time: int = 0  # [ns] 0: no edge yet
    period: float = 0.0  # [s] mean; 0: not known
    scatter: float = 0.0  # mean square of what a period differs by, share of the mean
    edges: int = 0  # in this rhythm
    at_rest: float = 0.0  # [s] of hum under 0 V

    @property
    def even(self) -> bool:
        """Whether the edges come more evenly than those of most discs."""
        return self.edges >= EDGES and self.scatter <= EVEN**2

    @property
    def hums(self) -> bool:
        """Whether these are the edges of the mains' hum, or of a motor that happens to turn like it."""
        return self.even and is_mains(1.0 / self.period)


def follow_rhythm(before: Rhythm, sample: Sample) -> Rhythm:
    """Follow one more sample of a plant that stamps edges."""
    after = _follow_edges(before, sample)
    if not after.hums or sample.voltage != 0.0:
        return after
    dt = max(sample.sample_time - before.sample_time, 0) * 1e-9
    return Rhythm(
        *(after.sample_time, after.count, after.edge_time, after.period, after.scatter, after.edges), after.at_rest + dt
    )


def _follow_edges(before: Rhythm, sample: Sample) -> Rhythm:
    """Follow the edges since the sample before."""
    now, count, edge = sample.sample_time, sample.edge_count, sample.edge_time
    passed, span = abs(count - before.count), (edge - before.edge_time) * 1e-9
    if edge == before.edge_time:
        over = (now - edge) * 1e-9 > LATE * before.period
        rest = (0.0, 0.0, 0, 0.0) if over else (before.period, before.scatter, before.edges, before.at_rest)
        return Rhythm(now, count, edge, *rest)
    if not before.edge_time or not passed or span <= 0.0:
        return Rhythm(now, count, edge)
    period = span / passed
    off = period / before.period - 1.0 if before.period else 1.0
    if abs(off) > ANEW:
        return Rhythm(now, count, edge, period)
    share = 1.0 - (1.0 - 1.0 / EDGES) ** passed
    mean = before.period + share * (period - before.period)
    scatter = before.scatter + share * (off**2 - before.scatter)
    return Rhythm(now, count, edge, mean, scatter, before.edges + passed, before.at_rest)
