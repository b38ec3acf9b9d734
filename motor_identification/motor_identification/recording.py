"""A recording: one motor's samples as arrays, checked, with what has to be known to read them."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import wraps
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from motor_model.errors import RecordingError
from motor_model.sample import RANGES, Info, Measurement, Sample

MOST_VOLTAGE = RANGES["max_voltage"][1]  # [V]
MOST_SPEED = 1e9  # [rad/s]; what is larger makes squares that mean nothing
STEADY_HOLD = 20.0  # [s] that a steady state is held for at least: any motor but the slowest has settled

T = TypeVar("T")

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Bools = NDArray[np.bool_]


@dataclass(frozen=True)
class Recording:
    """Samples of one motor in the order of its own clock; every array has shape (K,).

    `voltage[k]` holds from `sample_time[k]` until the next sample. `notes` are sentences a user has to read beside any
    result (such as: the bag was cut off, this is what could be read).
    """

    uri: str
    info: Info
    sample_time: Integers  # [ns] strictly increasing
    voltage: Floats  # [V]
    speed: Floats  # [rad/s]
    edge_count: Integers
    edge_time: Integers  # [ns]
    edge_period: Floats  # [s]
    supply_voltage: Floats  # [V] NaN if unmeasured
    current: Floats  # [A] NaN if unmeasured
    notes: tuple[str, ...] = ()

    def __len__(self) -> int:
        return len(self.sample_time)

    @property
    def time(self) -> Floats:
        """[s] since the first sample, shape (K,); exact to a nanosecond for recordings shorter than 100 days."""
        return np.asarray((self.sample_time - self.sample_time[0]) * 1e-9, dtype=np.float64)

    @property
    def duration(self) -> float:
        """[s] from the first sample to the last."""
        return float((self.sample_time[-1] - self.sample_time[0]) * 1e-9)

    @property
    def sample_period(self) -> float:
        """[s] what the plant says of it, or the median of what it did."""
        return self.info.sample_period or float(np.median(np.diff(self.sample_time))) * 1e-9

    @property
    def has_steady_states(self) -> bool:
        """Whether every sample is a steady state: a mean speed at the end of a voltage that was held for long."""
        info = self.info
        at_the_end = info.measurement is Measurement.SPEED and 0.0 < info.speed_window <= 0.25 * info.sample_period
        return at_the_end and info.sample_period >= STEADY_HOLD

    def between(self, start: float, stop: float) -> "Recording":
        """The part from `start` to `stop` seconds after the first sample; 0, 0 is all of it.

        Raises:
            RecordingError: the window is empty, reversed or outside the recording.
        """
        if start == 0.0 and stop == 0.0:
            return self
        end = stop if stop != 0.0 else np.inf
        if not (0.0 <= start < np.inf and 0.0 <= stop < np.inf):
            raise RecordingError(
                "--start and --stop are seconds after the first sample, 0 or more; --stop 0 is the end."
            )
        if start >= end:
            raise RecordingError(f"--start {start:g} s must be before --stop {stop:g} s.")
        inside = (self.time >= start) & (self.time <= end)
        if start >= self.duration:
            raise RecordingError(f"{self.uri} is {self.duration:.3g} s long: --start {start:g} s is after its end.")
        if np.count_nonzero(inside) < 2:
            end = min(end, self.duration)
            raise RecordingError(f"{self.uri} has fewer than two samples from {start:g} to {end:.4g} s: take more.")
        return self.at_rows(inside)

    def at_rows(self, which: Bools | Integers) -> "Recording":
        """The recording with these of its samples only, by marks (K,) or by ascending indices."""
        return replace(
            self,
            sample_time=self.sample_time[which],
            voltage=self.voltage[which],
            speed=self.speed[which],
            edge_count=self.edge_count[which],
            edge_time=self.edge_time[which],
            edge_period=self.edge_period[which],
            supply_voltage=self.supply_voltage[which],
            current=self.current[which],
        )


def have_steady_states(recordings: Sequence[Recording]) -> bool:
    """Tell whether recordings have nothing but steady states, which show nothing that takes time."""
    return bool(recordings) and all(recording.has_steady_states for recording in recordings)


def once(measure: Callable[[Recording], T]) -> Callable[[Recording], T]:
    """Measure something of a recording once, and keep it with it: a diagnosis asks for it hundreds of times."""
    name = f"{measure.__module__}.{measure.__qualname__}"

    @wraps(measure)
    def kept(recording: Recording) -> T:
        if name not in vars(recording):
            vars(recording)[name] = measure(recording)
        value: T = vars(recording)[name]
        return value

    return kept


def recording_of(samples: Sequence[Sample], info: Info, uri: str, notes: tuple[str, ...] = ()) -> Recording:
    """Return the recording that a sequence of samples makes; not checked."""

    def column(name: str, kind: type[np.generic]) -> NDArray[Any]:
        return np.array([getattr(sample, name) for sample in samples], dtype=kind)

    integers = {name: column(name, np.int64) for name in ("sample_time", "edge_count", "edge_time")}
    names = ("voltage", "speed", "edge_period", "supply_voltage", "current")
    floats = {name: column(name, np.float64) for name in names}
    return Recording(uri=uri, info=info, notes=notes, **integers, **floats)


def check(recording: Recording) -> Recording:
    """Return the recording if identification can use it.

    Raises:
        RecordingError: no samples, voltages or speeds that are not finite or that no motor has, an encoder without
            edges, a count or a clock that steps back, or no motion.
    """
    uri = recording.uri
    if len(recording) < 2:
        raise RecordingError(f"{uri} is too short (samples: {len(recording)}): record at least a second of motion.")
    for name, values in (("voltage", recording.voltage), ("speed", recording.speed)):
        bad = int(np.count_nonzero(~np.isfinite(values)))
        if bad:
            first = float(recording.time[int(np.argmin(np.isfinite(values)))])
            raise RecordingError(
                f"{uri} has {bad} {name} values that are not numbers (the first at {first:.3f} s): "
                "cut them out with --start and --stop, or record again."
            )
    _check_sizes(recording)
    if np.any(np.diff(recording.sample_time) <= 0):
        at = float(recording.time[int(np.argmax(np.diff(recording.sample_time) <= 0))])
        raise RecordingError(
            f"{uri}: the plant's clock stands still or steps back after {at:.3f} s: "
            "the plant was restarted. Use the part before (--stop)."
        )
    _check_encoder(recording)
    if not np.any(recording.speed) and np.ptp(recording.edge_count) == 0:
        raise RecordingError(
            f"{uri}: the motor never moves. Check supply, wiring and enable; record with a voltage that turns it."
        )
    return recording


def _check_sizes(recording: Recording) -> None:
    columns = (("voltage", recording.voltage, MOST_VOLTAGE, "V"), ("speed", recording.speed, MOST_SPEED, "rad/s"))
    for name, values, most, unit in columns:
        if np.max(np.abs(values)) > most:
            first = int(np.argmax(np.abs(values) > most))
            raise RecordingError(
                f"{recording.uri}: a {name} of {values[first]:.3g} {unit} at {recording.time[first]:.3f} s, which no "
                "such motor has: cut it out with --start and --stop, or record again."
            )


def _check_encoder(recording: Recording) -> None:
    uri, info = recording.uri, recording.info
    if info.measurement is not Measurement.SPEED and info.edges_per_revolution < 1:
        raise RecordingError(
            f"{uri}: motor/info says {info.edges_per_revolution} edges per revolution; "
            "set the plant's edges_per_revolution and record again."
        )
    falls = np.flatnonzero(np.diff(recording.edge_count) < 0)
    if info.measurement is Measurement.EDGES and info.single_channel and len(falls):
        raise RecordingError(
            f"{uri}: edge_count falls after {float(recording.time[falls[0]]):.3f} s, which one channel cannot "
            "show: use the part before (--stop), or correct single_channel in motor/info."
        )
