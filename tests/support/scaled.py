"""The same physics in other units: a recording as it would have been in other volts, seconds and radians."""

from dataclasses import dataclass, replace

import numpy as np

from motor_identification.recording import Recording
from motor_model.effects import SPEC_BY_NAME


@dataclass(frozen=True)
class Units:
    """How many new units an old one has; a turn is cut into as many slots fewer as its angle is larger."""

    voltage: float = 1.0
    time: float = 1.0
    speed: float = 1.0

    @property
    def angle(self) -> float:
        """How many times as far everything turns."""
        return self.speed * self.time

    def scale(self, recording: Recording) -> Recording:
        """The recording in these units."""
        info = recording.info
        edges = info.edges_per_revolution / self.angle
        assert abs(edges - round(edges)) < 1e-9, "a disc has whole slots"
        start = recording.sample_time[0]

        def nanoseconds(stamps: np.ndarray) -> np.ndarray:
            return start + np.round((stamps - start) * self.time).astype(np.int64)

        return replace(
            recording,
            info=replace(
                info,
                edges_per_revolution=round(edges),
                edge_resolution=info.edge_resolution * self.time,
                sample_period=info.sample_period * self.time,
                max_voltage=info.max_voltage * self.voltage,
            ),
            sample_time=nanoseconds(recording.sample_time),
            edge_time=np.where(recording.edge_time == 0, 0, nanoseconds(recording.edge_time)),
            edge_period=recording.edge_period * self.time,
            voltage=recording.voltage * self.voltage,
            speed=recording.speed * self.speed,
        )

    def value(self, name: str, value: float) -> float:
        """A parameter, known in old units, in these."""
        factor = {
            "V": self.voltage,
            "V·s/rad": self.voltage / self.speed,
            "V·s²/rad": self.voltage * self.time / self.speed,
            "V·s²/rad²": self.voltage / self.speed**2,
            "rad/s": self.speed,
            "s": self.time,
            "rad": 1.0 if name.endswith("_phase") else self.angle,
            "1/rev": 1.0 / self.angle,
            "–": 1.0,
        }
        return value * factor[SPEC_BY_NAME[name].unit]
