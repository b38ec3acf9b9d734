"""Read the motor that is watched out of what was just heard: our own plant's, or another robot's by a mapping."""

from dataclasses import dataclass, replace

import numpy as np

from motor_identification.bag.fields import collect_fields
from motor_identification.bag.motor.recording import read_motor
from motor_identification.bag.topic import absolute_name
from motor_identification.mapping.alignment import align
from motor_identification.mapping.mapped_recording import make_mapped_log, take_longest
from motor_identification.mapping.mapping import Mapping
from motor_identification.monitoring.heard import Heard
from motor_identification.recording import Floats, Recording, check

SPEED, INFO = "motor/speed", "motor/info"


@dataclass(frozen=True)
class Still:
    """A motor whose measured motion does not change; arrays of shape (K,)."""

    time: Floats  # [s] since the first row
    voltage: Floats  # [V] held from each row until the next


@dataclass(frozen=True)
class LiveMotor:
    """Which motor to read; `mapping` is None for one of our own plants in a namespace."""

    mapping: Mapping | None = None
    namespace: str = ""
    max_voltage: float = 0.0  # [V] of the model: what a window happened to see may be less

    @property
    def topics(self) -> tuple[str, ...]:
        """What has to be heard."""
        own = tuple(absolute_name(self.namespace, name) for name in (SPEED, INFO))
        return own if self.mapping is None else self.mapping.topics

    @property
    def optional(self) -> tuple[str, ...]:
        """Of these, what can be done without."""
        return self.topics[1:] if self.mapping is None else ()

    @property
    def motion(self) -> str:
        """The topic without which there is nothing to say."""
        return self.topics[0] if self.mapping is None else self.mapping.motion.path.topic

    def read(self, heard: Heard) -> Recording | Still:
        """Read what was heard as a recording, or as a motor that stands.

        Raises:
            RecordingError: a topic or a field is missing, or the numbers are those of no motor.
        """
        return self._read_own(heard) if self.mapping is None else self._read_mapped(heard, self.mapping)

    def _read_own(self, heard: Heard) -> Recording | Still:
        recording = read_motor(heard, self.namespace)
        if not np.any(recording.speed) and np.ptp(recording.edge_count) == 0:
            return Still(recording.time, recording.voltage)
        return self._with_full_voltage(check(recording))

    def _read_mapped(self, heard: Heard, mapping: Mapping) -> Recording | Still:
        fields = collect_fields(heard.messages(mapping.topics), mapping.paths, heard.uri, heard.topics)
        rows = align(fields[0], fields[1], None)
        if np.ptp(rows.motion) == 0.0 and (mapping.kind.value != "speed" or rows.motion[0] == 0.0):
            return Still((rows.time - rows.time[0]) * 1e-9, rows.voltage * mapping.voltage.scale)
        log = make_mapped_log(heard.uri, fields, mapping, signs_as_they_are=True)
        return self._with_full_voltage(check(take_longest(heard.uri, *log)))

    def _with_full_voltage(self, recording: Recording) -> Recording:
        full = max(self.max_voltage, recording.info.max_voltage)
        return replace(recording, info=replace(recording.info, max_voltage=full))
