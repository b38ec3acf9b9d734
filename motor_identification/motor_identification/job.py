"""One identification from bags to fit: what the command line and the node both run."""

from collections.abc import Callable
from dataclasses import dataclass

from motor_identification.bag import read_recording
from motor_identification.fit import Fit
from motor_identification.identify import Request, identify


@dataclass(frozen=True)
class Job:
    """Which bags, which part of them, and what to fit."""

    uris: tuple[str, ...]
    request: Request
    topic_namespace: str = ""
    start: float = 0.0  # [s]
    stop: float = 0.0  # [s] 0, 0 is all


def run_job(job: Job, progress: Callable[[str, float], None] | None = None) -> Fit:
    """Read the bags and fit.

    Raises:
        RecordingError: a bag cannot be read or cannot answer.
        ModelError: an effect is not in the table.
    """
    recordings = [read_recording(uri, job.topic_namespace, job.start, job.stop) for uri in job.uris]
    return identify(recordings, job.request, progress)
