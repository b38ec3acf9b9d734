"""Hold how a log's speeds were made, and read recordings by it: when, over which time, and how smoothed."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import tau

import numpy as np

from motor_identification.recording import Recording
from motor_identification.sensor.description import tells_of_speeds
from motor_identification.sensor.pulses.pulse_periods import divide_slot
from motor_identification.sensor.speed_sensor import find_counts, is_assumed, is_converted
from motor_identification.timing.row_times import AS_STAMPED, RowTimes
from motor_identification.timing.speed_filter import MEAN, SpeedFilter
from motor_model.sample import Measurement

INSTANT = 0.02  # rows: the window of a value of one instant
LEAST_DELAY = 0.05  # rows: with a longer dead time nothing comes too early

TAKEN = (
    "The speeds are taken as {}: as means over the row before they fit the motion much worse "
    "(--speed-window {:.3g} --speed-lag {:.3g} says so to an import)."
)
CONVERTED = (
    "The speeds are taken as {}, as a converter reads them: their steps are no counts of a turn (--speed-window {:.3g} "
    "--speed-lag {:.3g} says so to an import)."
)
PERIODS = (
    "The speeds are taken as a slot of {:.3g} rad (some {:.3g} a turn) over the time between the latest two edges: the "
    "slower, the older. Values that repeat, or fall with the time since, are left out; noise is a share of each."
)
SMOOTHED = "The speeds are smoothed: {}, as noise and motion show. What was smoothed is taken."
EARLY = (
    "The voltages are taken as those that held until their rows: else the motion came before them (--voltage-before "
    "says so to an import)."
)
OWN = "values of their rows' own instants"


@dataclass(frozen=True)
class Timing:
    """When speeds were made, in rows: how long the window of each is, and how old its middle; and how smoothed.

    What is younger than its row was logged with the voltage that held until then: a row more, however long that was.
    """

    window: float
    lag: float
    name: str
    filter: SpeedFilter | None = None  # that they passed
    rows: RowTimes = AS_STAMPED  # how the times of rows are read, once a filter is undone
    slot: float = 0.0  # [rad] over whose times between edges speeds were computed

    def set_on(self, recordings: Sequence[Recording]) -> tuple[Recording, ...]:
        """Read recordings with this timing, those of which nobody said another; the first one's notes say so."""
        timed = [self._set(recording) for recording in recordings]
        if timed:
            said = [note for note in timed[0].notes if not (self.slot > 0.0 and tells_of_speeds(note))]
            timed[0] = replace(timed[0], notes=(*said, *self._describe(recordings[0], timed[0])))
        return tuple(timed)

    def _set(self, recording: Recording) -> Recording:
        left = 0.0
        if self.filter and self._smooths(recording, self.filter):
            left = self.filter.measure_delay_left(recording.speed)
            recording = replace(recording, speed=self.filter.undo(recording.speed, recording.time))
        if self.is_early and is_voltage_open(recording):
            return _hold_until(recording)
        if not is_open(recording):
            return recording
        recording = self.rows.set_on(recording)
        row, lag = recording.info.sample_period, self.lag + left
        if self.is_early:
            recording, lag = _hold_until(recording), lag + 1.0
        if self.slot > 0.0:
            recording = replace(recording, edge_period=divide_slot(self.slot, recording.speed))
        return replace(recording, info=replace(recording.info, speed_window=self.window * row, speed_lag=lag * row))

    @property
    def is_early(self) -> bool:
        """Whether rows hold the voltages until them."""
        return self.lag < 0.0

    @staticmethod
    def _smooths(recording: Recording, passed: SpeedFilter) -> bool:
        """Whether a recording's speeds may have passed a filter: not what is no speed, nor counts as it is.

        A mean of counts lies on one.
        """
        if recording.info.measurement is not Measurement.SPEED:
            return False
        return passed.kind == MEAN or find_counts(recording.speed, recording.sample_period) == 0.0

    def _describe(self, recording: Recording, timed: Recording) -> list[str]:
        """Say how a recording is read otherwise than it says."""
        row, notes = recording.info.sample_period, []
        if self.slot and is_open(recording):
            notes.append(PERIODS.format(self.slot, tau / self.slot))
        elif self.name and is_open(recording):
            text = CONVERTED if is_converted(recording) else TAKEN
            notes.append(text.format(self.name, self.window * row, timed.info.speed_lag))
        if self.is_early and (is_open(recording) or is_voltage_open(recording)):
            notes.append(EARLY)
        if self.filter and self._smooths(recording, self.filter):
            notes.append(SMOOTHED.format(self.filter.describe(row)))
        return [*notes, *(self.rows.describe(recording, timed) if is_open(recording) else ())]


ASSUMED = Timing(1.0, 0.5, "")
UNTIL = Timing(1.0, -0.5, "")
OTHERS = (
    Timing(INSTANT, 0.0, OWN),
    UNTIL,
    Timing(INSTANT, -1.0, OWN),
)


def read_again(recording: Recording, timing: Timing | None) -> Recording:
    """Read a recording again with the timing that a fit found for it; None: as was assumed."""
    return recording if timing is None else timing.set_on([recording])[0]


def list_readings(recording: Recording, passed: SpeedFilter | None = None) -> tuple[Recording, ...]:
    """List how a recording may be read: as it says, and with values of its rows' own instants where it says nothing.

    Each also as smoothed, where speeds of the same motor passed a filter.
    """
    timings = (ASSUMED, OTHERS[0]) if is_open(recording) else (ASSUMED,)
    plain = (recording, *(timing.set_on([recording])[0] for timing in timings[1:]))
    smoothed = [replace(timing, filter=passed).set_on([recording])[0] for timing in timings if passed]
    return (*plain, *smoothed)


def is_voltage_open(recording: Recording) -> bool:
    """Decide whether a recording is of counts, of which nobody said from when on their rows' voltages hold.

    Speeds of said counts are those of a row, whose end is known.
    """
    info = recording.info
    counted = info.measurement is Measurement.COUNTS
    counted = counted or (info.measurement is Measurement.SPEED and info.edges_per_revolution > 0)
    return counted and info.voltage_assumed


def is_open(recording: Recording) -> bool:
    """Decide whether a recording is of speeds of which nobody said when they were made, nor that they are counts.

    A recording that is no import may have a window of one row that ends there as whatever it is: that is open, too.
    """
    info = recording.info
    unsaid = info.measurement is Measurement.SPEED and not info.edges_per_revolution and is_assumed(info)
    return unsaid and abs(info.speed_lag - ASSUMED.lag * info.sample_period) < LEAST_DELAY * info.sample_period


def _hold_until(recording: Recording) -> Recording:
    """Read a recording's voltages as those that held until their rows."""
    info = replace(recording.info, voltage_assumed=False)
    return replace(recording, info=info, voltage=np.append(recording.voltage[1:], recording.voltage[-1]))
