"""Reads one motor's recording out of any bag, with notes on what its user has to know about that."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from motor_identification.bag.metadata import read_cautions
from motor_identification.bag.motor.absence import explain_absence, find_only_namespace, list_names
from motor_identification.bag.motor.cdr import Rows
from motor_identification.bag.motor.rows import SPEED_TOPIC, read_motor_rows
from motor_identification.bag.storage import Bag, Messages, tell_damage
from motor_identification.bag.topic import absolute_name
from motor_identification.recording import Recording, check
from motor_model.sample import Info


def read_recording(uri: str | Path, topic_namespace: str = "", start: float = 0.0, stop: float = 0.0) -> Recording:
    """Read the samples on `motor/speed` with the latest `motor/info`, in the order of the log.

    Args:
        uri: a rosbag2 directory (MCAP or sqlite3, compressed or not, with or without metadata.yaml) or a storage file.
        topic_namespace: the namespace that the plant ran in, `/` for none; empty: none, or the only one in the bag that
            has a motor, which a note says then.
        start: [s] after the first sample; what lies outside of start and stop is not checked either.
        stop: [s] after the first sample; 0, 0 is all of it.

    Raises:
        RecordingError: no such bag, no bag, an empty one, one without this motor, one that identification cannot use.
    """
    recording = check(read_motor(Bag(uri), topic_namespace).between(start, stop))
    return replace(recording, notes=(*recording.notes, *read_cautions(Path(uri))))


def read_motor(bag: Messages, topic_namespace: str) -> Recording:
    """Read the same out of messages, wherever they are; not checked.

    Raises:
        RecordingError: none is of this motor, or they cannot be understood.
    """
    rows, infos, info_topic = read_motor_rows(bag, topic_namespace)
    notes: list[str] = []
    only = find_only_namespace(bag)
    if len(rows) == 0 and not topic_namespace and only:
        rows, infos, info_topic = read_motor_rows(bag, only)
        notes = [f"{bag.uri} has one motor, in the namespace {only}: that one is used."]
    if len(rows) == 0:
        raise explain_absence(bag, absolute_name(topic_namespace, SPEED_TOPIC))
    kept, repeats = _without_repeats(rows, bag.uri)
    notes = [*repeats, *notes]
    if bag.cut:
        span = float(kept["sample_time"][-1] - kept["sample_time"][0]) * 1e-9
        notes = [f"{bag.uri} is cut off: {len(kept)} samples, {span:.2f} s up to the cut.", *notes]
    if damage := tell_damage(bag, bag.uri):
        notes.append(damage)
    if bag.garbled:
        notes.append(f"{bag.uri}: {bag.garbled} messages are garbled and were left out.")
    if bag.missing:
        notes.append(
            f"{bag.uri} lacks {list_names(bag.missing)}, which its metadata.yaml lists: those samples are missing."
        )
    info = _info(infos, kept, info_topic, bag.uri, notes)
    return _recording(bag.uri, info, kept, tuple(notes))


def _without_repeats(rows: Rows, uri: str) -> tuple[Rows, list[str]]:
    """Drop messages that are there twice; a clock that really steps back is left for `check` to tell."""
    time, stamp = rows["sample_time"], rows["stamp"]
    if np.all(np.diff(time) > 0):
        return rows, []
    order = np.lexsort((stamp, time))  # stable: of two alike, the first in the log stays
    alike = (np.diff(time[order]) == 0) & (np.diff(stamp[order]) == 0)
    keep = np.ones(len(rows), dtype=np.bool_)
    keep[order[1:][alike]] = False
    kept = rows[keep]
    kept = kept[np.concatenate(([True], np.diff(kept["sample_time"]) != 0))]
    dropped = len(rows) - len(kept)
    return kept, [f"{uri} has {dropped} samples more than once; the repeats were dropped."] if dropped else []


def _info(infos: list[Info], rows: Rows, info_topic: str, uri: str, notes: list[str]) -> Info:
    """The latest info, or defaults; adds to the notes what the user has to know about that."""
    if len(infos) > 1:
        notes.append(f"{uri}: {info_topic} changes during the recording; the latest is used for all of it.")
    if infos:
        return infos[-1]
    info = Info()
    if len(rows) > 1:
        info = replace(info, sample_period=float(np.median(np.diff(rows["sample_time"]))) * 1e-9)
    notes.append(
        f"{uri} has no {info_topic}; assumed: {info.edges_per_revolution} stamped edges per revolution on one channel, "
        f"{info.edge_resolution * 1e6:g} µs resolution, {info.max_voltage:g} V at full duty."
    )
    return info


def _recording(uri: str, info: Info, rows: Rows, notes: tuple[str, ...]) -> Recording:
    columns = {name: np.ascontiguousarray(rows[name]) for name in rows.dtype.names or () if name != "stamp"}
    return Recording(uri=uri, info=info, notes=notes, **columns)
