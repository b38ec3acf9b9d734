"""Fields with times of their own as rows of one log: commands held, and averaged from one measurement to the next."""

from dataclasses import dataclass

import numpy as np

from motor_identification.bag.fields import Series
from motor_identification.logs.signals import Floats, Integers
from motor_model.errors import RecordingError

OTHER_CLOCK = 10**9  # [ns] between a message's header and its arrival, from which on another clock has stamped it


@dataclass(frozen=True)
class Rows:
    """Arrays of shape (K,): a row at each measurement that came after the first command."""

    time: Integers  # [ns]
    voltage: Floats  # mean of the commands held from this row until the next, in their unit
    motion: Floats
    current: Floats  # the latest; NaN before the first
    notes: tuple[str, ...]


def align(voltage: Series, motion: Series, current: Series | None) -> Rows:
    """Make rows of commands and measurements.

    Raises:
        RecordingError: they do not overlap.
    """
    time, about_motion = stamps_of(motion)
    commanded, about_voltage = stamps_of(voltage)
    order = np.argsort(commanded, kind="stable")
    commanded, commands = commanded[order], voltage.values[order]
    keep = time >= commanded[0]
    if np.count_nonzero(keep) < 2:
        raise RecordingError(
            f"{motion.path} has no messages after the first on {voltage.path}: their times do not overlap."
        )
    notes = [about_motion, about_voltage]
    if not keep.all():
        notes.append(
            f"{np.count_nonzero(~keep)} messages on {motion.path.topic} before the first command are left out."
        )
    time = time[keep]
    amperes: Floats = np.full(len(time), np.nan)
    if current is not None:
        when, about_current = stamps_of(current)
        place = np.searchsorted(when, time, side="right") - 1
        amperes = np.where(place >= 0, current.values[np.maximum(place, 0)], np.nan)
        notes.append(about_current)
    once = tuple(dict.fromkeys(notes))  # fields of one topic are stamped alike
    return Rows(time, _held_means(commanded, commands, time), motion.values[keep], amperes, once)


def stamps_of(series: Series) -> tuple[Integers, str]:
    """[ns] When the values were so, by the headers or by arrival, in the recorder's clock; and in words."""
    topic = series.path.topic
    lost = f" {series.garbled} messages on it cannot be decoded and are left out." if series.garbled else ""
    if not series.has_header:
        steps = np.diff(series.received) * 1e-6
        period = float(np.median(steps)) if len(steps) else 0.0
        jitter = float(np.sqrt(np.mean((steps - period) ** 2))) if len(steps) else 0.0
        said = f"{topic} has no stamps: times are those of arrival, every {period:.3g} ms give or take {jitter:.3f} ms."
        return series.received, said + lost
    late = series.received - series.stamp
    least, spread = int(np.min(late)), float(np.std(late)) * 1e-6
    if abs(int(np.median(late))) > OTHER_CLOCK:
        said = (
            f"{topic} is stamped by another clock, {np.median(late) * 1e-9:.4g} s away: its stamps are moved by that "
            f"of the message that came soonest (arrivals differ by {spread:.2g} ms)."
        )
        return series.stamp + least, said + lost
    said = (
        f"{topic} is stamped by its sender; messages arrive {np.median(late) * 1e-6:.2g} ms later, ± {spread:.3f} ms."
    )
    return series.stamp, said + lost


def _held_means(commanded: Integers, commands: Floats, time: Integers) -> Floats:
    """The mean of commands, each held until the next, from every time (K,) until the next; the last until its end."""
    origin = int(time[0])
    ends = np.append(time, time[-1] + int(np.median(np.diff(time)))) - origin
    begins = (commanded - origin).astype(np.float64)
    integral = np.concatenate(([0.0], np.cumsum(commands[:-1] * np.diff(begins))))
    place = np.clip(np.searchsorted(begins, ends, side="right") - 1, 0, len(begins) - 1)
    until = integral[place] + commands[place] * (ends - begins[place])
    length = np.diff(ends).astype(np.float64)
    here = commands[place[:-1]]
    means = np.divide(np.diff(until), length, out=here.copy(), where=length > 0.0)
    constant = place[1:] == place[:-1]  # exactly the command, where it did not change
    return np.asarray(np.where(constant, here, means), dtype=np.float64)
