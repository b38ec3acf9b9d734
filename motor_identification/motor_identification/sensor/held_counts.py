"""Take held counts out of a recording: a counter that is read less often than rows are written."""

from dataclasses import replace

import numpy as np

from motor_identification.recording import Recording
from motor_identification.sensor.held_samples import find_frames


def drop_held_counts(recording: Recording) -> Recording:
    """Keep one row for each time the counter was read, at that time; the recording itself where every row is fresh.

    Only the first row stays besides, since times count from it. A voltage may change within a frame: for commands take
    the recording as it was.
    """
    frames = find_frames(recording.time, recording.edge_count.astype(np.float64), position=True)
    if frames is None:
        return recording
    later = frames.time > 0.5e-9  # of the first row
    rows = np.concatenate([[0], frames.row[later]])
    begin = recording.sample_time[0]
    stamps = begin + np.round(frames.time[later] * 1e9).astype(np.int64)
    return replace(recording.at_rows(rows), sample_time=np.concatenate([[begin], stamps]))
