"""Watch who speaks on motor/speed: one plant, one that has been restarted, or two at once.

A plant's clock only goes on, by whole sample periods. One step back is a restart; samples that keep coming out of step
are those of two plants.
"""

from dataclasses import dataclass, replace

OUT_OF_STEP = 0.7  # of a sample period: what comes sooner after the last sample is another plant's
MEMORY = 0.5  # [s] in which a second step out of order tells two plants from a restart


@dataclass(frozen=True, slots=True)
class PlantWatch:
    """What is known of the plant so far."""

    sample_time: int  # [ns]
    edge_count: int
    out_of_step: float | None = None  # [s] when a sample last came out of step, on the clock of `now`
    restarted: bool = False  # with this sample
    two: bool = False  # two plants speak


def watch_plant(
    before: PlantWatch | None, sample_time: int, edge_count: int, now: float, sample_period: float
) -> PlantWatch:
    """Look at one more sample's time [ns] and count; sample_period [s], 0: not known."""
    if before is None:
        return PlantWatch(sample_time, edge_count)
    step = (sample_time - before.sample_time) * 1e-9
    after = replace(before, sample_time=sample_time, edge_count=edge_count, restarted=step < 0.0, two=False)
    if step > 0.0 and step >= OUT_OF_STEP * sample_period:
        return after
    again = before.out_of_step is not None and now - before.out_of_step <= MEMORY
    return replace(after, out_of_step=now, two=again)
