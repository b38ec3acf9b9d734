"""Follow edges that are counted to and fro within one slot, and lead nowhere.

Of two channels one may be lost: its wire is off, or its sensor dead. The other still shows every flank, but not which
way it was passed, so that each is taken back by the next one, and the motor seems to stand. A shaft that does stand,
and trembles over a flank, shows the same, but moves on under a voltage that turns any motor, or is blocked.
"""

from dataclasses import dataclass

from motor_model.sample import Sample

MANY = 10  # samples with a new edge within one slot: a slow motor has one, and a second where it turns back


@dataclass(frozen=True, slots=True)
class ToAndFro:
    """Samples whose counts are within one slot of each other."""

    low: int = 0
    high: int = 0
    edge_time: int = 0  # [ns] of the latest edge
    edges: int = 0  # samples with a new one
    since: int = 0  # [ns]

    def see(self, sample: Sample, anew: bool = False) -> "ToAndFro":
        """See the next sample; anew: what was before does not count."""
        low, high = min(self.low, sample.edge_count), max(self.high, sample.edge_count)
        if anew or high - low > 1:
            return ToAndFro(sample.edge_count, sample.edge_count, sample.edge_time, 0, sample.sample_time)
        return ToAndFro(low, high, sample.edge_time, self.edges + (sample.edge_time != self.edge_time), self.since)

    def lasts(self, now: int, patience: float) -> bool:
        """Tell whether edges have led nowhere for so long [s] at `now` [ns]."""
        return self.edges >= MANY and self.passed(now, patience)

    def passed(self, now: int, patience: float) -> bool:
        """Tell whether so long [s] has passed at `now` [ns] since the count left the slot before."""
        return now - self.since >= patience * 1e9
