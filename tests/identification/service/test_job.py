"""Jobs: which recordings are read for what, and how one is stopped."""

from dataclasses import replace
from pathlib import Path

import pytest

from motor_identification.bag import Source, Window
from motor_identification.diagnose import Stage, Stopped
from motor_identification.identify import Request
from motor_identification.recording import Recording
from motor_identification.service.job import DiagnosisJob, Job, run_diagnosis, run_job
from motor_model.errors import RecordingError

BAGS = Path(__file__).resolve().parents[3] / "bags"
STEP, RICH = str(BAGS / "step"), str(BAGS / "rich")


def test_a_job_fits_every_bag_of_its_source() -> None:
    fit = run_job(Job(Source((STEP, RICH), window=Window(0.0, 1.0)), Request(("coulomb_friction",))))
    assert fit.uris == (STEP, RICH)
    assert list(fit.parameters.values) == ["kv", "ka", "ks"]


def test_bags_of_motors_with_other_names_are_said_to_be(monkeypatch: pytest.MonkeyPatch) -> None:
    named = {STEP: "left", RICH: "right"}
    read = Source.read

    def as_named(self: Source, uri: str) -> Recording:
        recording = read(self, uri)
        return replace(recording, info=replace(recording.info, name=named[uri]))

    monkeypatch.setattr(Source, "read", as_named)
    job = Job(Source((STEP, RICH), window=Window(0.0, 1.0)))
    note = "The bags are of different motors (left, right), fitted as one: give those of one motor at a time."
    assert note in run_job(job).notes
    named[STEP] = "right"
    assert note not in run_job(job).notes
    named[STEP] = "motor"  # as one that nobody named
    assert not [one for one in run_job(job).notes if "different motors" in one]


def test_validation_is_read_whole_and_after_what_is_fitted() -> None:
    read: list[str] = []

    def hear(stage: Stage) -> None:
        if not stage.text.startswith("reading "):
            raise Stopped("enough was heard.")
        read.append(stage.text)

    job = DiagnosisJob(Source((RICH,), window=Window(20.0, 25.0)), (STEP,))  # the step is over by then
    with pytest.raises(Stopped, match="enough"):
        run_diagnosis(job, hear)
    assert read == [f"reading {RICH}", f"reading {STEP}"]


def test_no_bag_is_both_fitted_and_judged_by() -> None:
    job = DiagnosisJob(Source((STEP, RICH)), (f"{BAGS}/rich/../step",))
    with pytest.raises(RecordingError, match="step is given for the fit and for validation: leave it out of one"):
        run_diagnosis(job)


def test_a_diagnosis_that_is_stopped_while_it_reads_reads_no_further() -> None:
    read: list[str] = []
    with pytest.raises(Stopped, match="the diagnosis was stopped"):
        run_diagnosis(DiagnosisJob(Source((STEP, RICH))), lambda stage: read.append(stage.text), lambda: bool(read))
    assert read == [f"reading {STEP}"]
