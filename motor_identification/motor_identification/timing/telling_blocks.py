"""Choose the blocks of long recordings that tell how their speeds were made: those in which the command swings most.

A filter, a clock or a lag shows in some thousand rows as well as in a hundred thousand, each of which a search for them
would filter some hundred times.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from motor_identification.measurement.command_swing import measure_swings
from motor_identification.noise.error_data import ErrorData
from motor_identification.recording import Floats, Recording

ROWS = 1000  # of a block
MOST_ROWS = 8000  # that are looked at, of all recordings

Span = tuple[float, float]  # [s] since the first sample


def choose_blocks(recordings: Sequence[Recording]) -> list[list[Span]]:
    """Choose spans of every recording; all of it where recordings are short."""
    total = sum(map(len, recordings))
    if total <= MOST_ROWS:
        return [[(-np.inf, np.inf)] for _ in recordings]
    return [_choose(recording, MOST_ROWS * len(recording) / total) for recording in recordings]


def _choose(recording: Recording, rows: float) -> list[Span]:
    """Choose blocks of so many rows together, one at least; neighbours are one."""
    begins = np.arange(0, max(len(recording) - ROWS // 2, 1), ROWS)
    swings = np.add.reduceat(measure_swings(recording), begins)
    chosen = np.sort(np.argsort(-swings, kind="stable")[: max(round(rows / ROWS), 1)])
    ends = np.append(recording.time[begins[1:]], np.inf)
    spans: list[Span] = []
    for number in chosen:
        begin, end = float(recording.time[begins[number]]), float(ends[number])
        if spans and spans[-1][1] == begin:
            begin = spans.pop()[0]
        spans.append((begin, end))
    return spans


def take_blocks(data: ErrorData, end: Floats, spans: Sequence[Span]) -> list[ErrorData]:
    """Take the parts of a recording's increments whose intervals end, at ascending times [s] (I,), within spans."""
    parts = [slice(*(int(k) for k in np.searchsorted(end, span))) for span in spans]
    return [_take(data, part) for part in parts if part.stop > part.start]


def _take(data: ErrorData, part: slice) -> ErrorData:
    """Take a part of increments: what was before it is forgotten."""
    names = ("fresh", "still", "pause", "duration", "blur", "slack", "increments", "counted")
    columns = {name: getattr(data, name)[part].copy() for name in names}
    columns["fresh"][0], columns["pause"][0] = True, np.inf
    return replace(data, **columns)
