"""Jobs: from bags to a fit or a diagnosis, what the command line and the node both run."""

import sys
import traceback
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from os.path import realpath
from typing import TYPE_CHECKING

from motor_identification.bag import Source, Window
from motor_identification.estimation.request import Request
from motor_identification.progress import Stage, Stopped
from motor_identification.recording import Recording
from motor_identification.uncertainty.result import Fit
from motor_model.errors import RecordingError
from motor_model.sample import Info

if TYPE_CHECKING:
    from motor_identification.diagnosis.result import Diagnosis


@dataclass(frozen=True)
class Job:
    """Recordings to read, and what to fit to them."""

    source: Source
    request: Request = Request()


def prepare() -> None:
    """Load what every fit needs, as a worker does before its first job; whoever hands out jobs needs none of it."""
    from motor_identification.service import warm_up

    warm_up.prepare()


def run_job(job: Job, progress: Callable[[str, float], None] | None = None) -> Fit:
    """Read the bags and fit.

    Raises:
        RecordingError: a bag cannot be read or cannot answer.
        ModelError: an effect is not in the table.
    """
    refuse_repeats(job.source.uris)
    from motor_identification.identify import identify

    recordings = say_whose([job.source.read(uri) for uri in job.source.uris])
    return identify(recordings, job.request, progress)


def say_whose(recordings: list[Recording]) -> list[Recording]:
    """Add a note to the first recording where they are of motors with names that differ: the two wheels of one log."""
    names = sorted({recording.info.name for recording in recordings} - {"", Info().name})
    if len(names) < 2:
        return recordings
    note = f"The bags are of different motors ({', '.join(names)}), fitted as one: give those of one motor at a time."
    return [replace(recordings[0], notes=(*recordings[0].notes, note)), *recordings[1:]]


def refuse_repeats(uris: Sequence[str]) -> None:
    """Refuse a bag that is given twice: its noise would count as two measurements, and every error come out too small.

    Raises:
        RecordingError: one is.
    """
    seen: set[str] = set()
    for uri in uris:
        if realpath(uri) in seen:
            raise RecordingError(f"{uri} is given twice: name every bag once.")
        seen.add(realpath(uri))


@dataclass(frozen=True)
class DiagnosisJob:
    """Recordings to diagnose, bags to judge by, and what the first fit has: the effects known already."""

    source: Source
    validation: tuple[str, ...] = ()  # of the same motor; always whole
    request: Request = Request()


@dataclass(frozen=True)
class Reported:
    """A diagnosis and where its report is."""

    diagnosis: "Diagnosis"
    report: str  # empty where there is none
    trouble: str  # why there is none, in a sentence


def run_diagnosis(
    job: DiagnosisJob,
    progress: Callable[[Stage], None] | None = None,
    stopped: Callable[[], bool] | None = None,
) -> "Diagnosis":
    """Read the bags and diagnose.

    Raises:
        RecordingError: a bag cannot be read or cannot answer, or is both fitted and judged by.
        ModelError: a known effect is not in the table.
        Stopped: `stopped` said so.
    """
    from motor_identification.diagnose import diagnose

    refuse_repeats(job.source.uris)
    refuse_repeats(job.validation)
    kept_out = replace(job.source, uris=job.validation, window=Window())
    twice = {realpath(uri) for uri in job.source.uris} & {realpath(uri) for uri in job.validation}
    if twice:
        raise RecordingError(f"{twice.pop()} is given for the fit and for validation: leave it out of one of the two.")

    def read(source: Source) -> Iterator[Recording]:
        for uri in source.uris:
            if stopped is not None and stopped():
                raise Stopped("the diagnosis was stopped.")
            if progress is not None:
                progress(Stage(f"reading {uri}", 0.0, "", float("nan")))
            yield source.read(uri)

    recordings, validation = say_whose(list(read(job.source))), list(read(kept_out))
    return diagnose(recordings, validation, job.request, progress, stopped)


def run_reported(
    job: DiagnosisJob,
    report: str,
    model: str,
    progress: Callable[[Stage], None] | None = None,
    stopped: Callable[[], bool] | None = None,
) -> Reported:
    """Diagnose and write the report to a file (none where `report` is empty); one that cannot be written loses nothing.

    model: the file that the model will be written to, which the report names; empty: none.

    Raises:
        MotorError: as `run_diagnosis`.
    """
    from motor_identification.reporting.html import Files, write_report

    diagnosis = run_diagnosis(job, progress, stopped)
    if not report:
        return Reported(diagnosis, "", "")
    if progress is not None:
        progress(Stage("report", 1.0, "", diagnosis.gap_after))
    try:
        return Reported(diagnosis, str(write_report(diagnosis, report, Files(model, job.source))), "")
    except Exception as error:  # whatever it is, the diagnosis is worth more
        traceback.print_exc(file=sys.stderr)
        return Reported(diagnosis, "", f"The report was not written: {error}")


def notes_of(diagnosis: "Diagnosis") -> tuple[str, ...]:
    """Return what a user has to read beside the result: bags that were cut off, what was left out; each once."""
    judged_by = (note for recording in diagnosis.after.recordings for note in recording.notes)
    return tuple(dict.fromkeys((*diagnosis.model.notes, *judged_by)))
