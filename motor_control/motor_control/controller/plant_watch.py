"""Watch who speaks on motor/speed: one plant, one that has been restarted, or two at once.

A plant's clock only goes on, by whole sample periods. One step back is a restart; samples that keep coming out of step
are those of two plants. A board that was reset counts its edges from 0 again, while its driver's clock goes on: where
there had been an edge and now there never was one, an angle that was asked for is somewhere else.

A plant that is started again may sample more often than the one before, and says so at about the time of its first
samples: until then only steps back are those of two.
"""

from dataclasses import dataclass, replace

from motor_model.sample import Sample

OUT_OF_STEP = 0.7  # of a sample period: what comes sooner after the last sample is another plant's
MEMORY = 0.5  # [s] in which a second step out of order tells two plants from a restart
ANEW = 2.0  # [s] after a restart in which a plant has said how often it samples


@dataclass(frozen=True, slots=True)
class PlantWatch:
    """What is known of the plant so far."""

    sample_time: int  # [ns]
    edge_count: int
    edge_time: int = 0  # [ns] of the latest edge; 0: there was none yet
    out_of_step: float | None = None  # [s] when a sample last came out of step, on the clock of `now`
    restarted: bool = False  # with this sample
    since: float | None = None  # [s] when it was last restarted, on the clock of `now`; None: it was not
    two: bool = False  # two plants speak


def watch_plant(before: PlantWatch | None, sample: Sample, now: float, sample_period: float) -> PlantWatch:
    """Look at one more sample; sample_period [s], 0: not known."""
    if before is None:
        return PlantWatch(sample.sample_time, sample.edge_count, sample.edge_time)
    step = (sample.sample_time - before.sample_time) * 1e-9
    restarted = step < 0.0 or sample.edge_time == 0 < before.edge_time
    since = now if restarted else before.since
    after = PlantWatch(
        sample.sample_time, sample.edge_count, sample.edge_time, before.out_of_step, restarted, since=since
    )
    anew = since is not None and now - since <= ANEW
    if step > 0.0 and (anew or step >= OUT_OF_STEP * sample_period):
        return after
    again = before.out_of_step is not None and now - before.out_of_step <= MEMORY
    return replace(after, out_of_step=now, two=again)
