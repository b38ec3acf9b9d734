"""What the commands that diagnose share: a diagnosis with a progress bar, on the terminal and in files."""

import os
import threading
from collections.abc import Callable
from dataclasses import dataclass, replace
from datetime import datetime, timezone
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING

from motor_model.errors import MotorError
from motor_model.regular_file import say_refusal
from motor_ros.command.shell import ended_by_interrupt
from motor_ros.output_files import check_outputs

if TYPE_CHECKING:
    from motor_identification.bag import Source
    from motor_identification.diagnose import Stage
    from motor_identification.diagnosis.result import Diagnosis
    from motor_identification.service.job import DiagnosisJob

BAR = "{desc} {bar} {percentage:3.0f} %"


def diagnosed(job: "DiagnosisJob", files: "Files", interrupted: str) -> "Diagnosis":
    """Diagnose with a progress bar, write files, and print what came out; `interrupted` is what Ctrl-C says.

    Raises:
        MotorError: it cannot be done.
    """
    from tqdm import tqdm

    from motor_identification.service.job import run_diagnosis

    speaking = threading.Lock()  # stages come from any thread
    with tqdm(total=100, delay=2.0, disable=None, bar_format=BAR) as bar:

        def show(stage: "Stage") -> None:
            with speaking:
                bar.set_description(_described(stage), refresh=False)
                bar.update(max(round(100 * stage.share) - bar.n, 0))

        with ended_by_interrupt(interrupted):
            diagnosis = run_diagnosis(job, show)
    files = replace(files, source=job.source)
    written, troubles = files.write(diagnosis)  # first: whoever reads what is printed may stop reading
    print(as_text(diagnosis), *written, sep="\n")
    if troubles:
        raise MotorError(" ".join(troubles))
    return diagnosis


def as_text(diagnosis: "Diagnosis") -> str:
    """Return what a terminal shows."""
    from motor_identification.reporting.diagnosis_table import format_diagnosis
    from motor_identification.reporting.diagnosis_text import summarize_diagnosis
    from motor_identification.service.job import notes_of

    return "\n".join([format_diagnosis(diagnosis), "", summarize_diagnosis(diagnosis), *notes_of(diagnosis)])


def _described(stage: "Stage") -> str:
    return f"{stage.text}, gap {stage.gap:.3g} rad/s" if isfinite(stage.gap) else stage.text


@dataclass(frozen=True)
class Files:
    """Where a diagnosis goes; None is nowhere."""

    model: str | None = None
    json: str | None = None
    report: str | None = None  # a directory, for the report, the model and the JSON
    source: "Source | None" = None  # of the recordings: what the report's commands read again

    def rows(self) -> "list[tuple[str, Callable[[Diagnosis, Path], None], Path]]":
        """What is written, how and where; what comes without being asked for has no name."""
        rows = [("model", write_model, self.model), ("json", write_json, self.json)]
        if self.report is not None:
            files = (("", write_model, "model.yaml"), ("", write_json, "diagnosis.json"))
            last = ("report", self._write_report, "report.html")  # the longest: nothing waits for it
            rows += [(name, write, os.path.join(self.report, file)) for name, write, file in (*files, last)]
        return [(name, write, Path(path)) for name, write, path in rows if path]

    def _write_report(self, diagnosis: "Diagnosis", path: Path) -> None:
        """The report, with pictures, in one file; it names the model file that was asked for."""
        from motor_identification.reporting import html

        model = self.model or str(path.parent / "model.yaml")
        html.write_report(diagnosis, path, html.Files(model, self.source))

    def check(self, force: bool = False) -> None:
        """Refuse before anything is computed what could not be written afterwards, or would replace what is there.

        Raises:
            MotorError: a directory is missing or must not be written to, or a file exists and `force` is false.
        """
        check_outputs((path for _name, _write, path in self.rows()), force, self.report)

    def write(self, diagnosis: "Diagnosis") -> tuple[list[str], list[str]]:
        """Write everything; returns lines that say where it is, and sentences about what could not be written."""
        written, troubles = [], []
        if self.report is not None:
            try:
                Path(self.report).mkdir(parents=True, exist_ok=True)
            except OSError as error:
                return [], [f"cannot make the directory {self.report} {say_refusal(error)}."]
        for name, write, path in self.rows():
            try:
                write(diagnosis, path)
                if name:
                    written.append(f"{name}: {path}")
            except MotorError as error:
                troubles.append(str(error))
        return written, troubles


def write_model(diagnosis: "Diagnosis", path: Path) -> None:
    """Write the model with the effects that were found, as a model file."""
    from motor_identification.reporting.fit_model_file import save_model

    save_model(path, diagnosis.model, datetime.now(timezone.utc).isoformat(timespec="seconds"))


def write_json(diagnosis: "Diagnosis", path: Path) -> None:
    """Everything that was found, in the form that the interfaces promise."""
    from motor_identification.reporting import json_values
    from motor_identification.reporting.diagnosis_json import diagnosis_to_json

    json_values.write_json(path, diagnosis_to_json(diagnosis))
