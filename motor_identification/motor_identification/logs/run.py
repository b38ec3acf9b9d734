"""One recording of a log: its samples and its name."""

from dataclasses import dataclass

from motor_model.sample import Sample


@dataclass(frozen=True)
class Run:
    """One recording; `label` is what tells it from others made fit for a file name, empty without others."""

    label: str
    samples: tuple[Sample, ...]

    @property
    def duration(self) -> float:
        """[s] from the first sample to the last."""
        return (self.samples[-1].sample_time - self.samples[0].sample_time) * 1e-9
