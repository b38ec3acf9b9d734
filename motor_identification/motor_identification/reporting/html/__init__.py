"""Write a diagnosis or a fit as one HTML file with everything in it, to be read without a network and shown around.

In: a `Diagnosis`, or a `Fit` with its recordings, and where the model file is. Out: a page of text, tables and SVG.
"""

from collections.abc import Sequence
from pathlib import Path

from motor_identification.diagnosis.result import Diagnosis
from motor_identification.recording import Recording
from motor_identification.reporting.html.diagnosis_page import render_diagnosis
from motor_identification.reporting.html.fit_page import render_fit
from motor_identification.reporting.html.next_steps import NO_FILES, Files
from motor_identification.uncertainty.result import Fit
from motor_model.errors import MotorError
from motor_model.regular_file import say_refusal, write_text

__all__ = ["Files", "write_fit_report", "write_report"]


def write_report(diagnosis: Diagnosis, target: str | Path, files: Files = NO_FILES) -> Path:
    """Write the report to a file that ends in .html, or as report.html into a directory; return the file.

    Raises:
        MotorError: it cannot be written.
    """
    return _write(render_diagnosis(diagnosis, files), target)


def write_fit_report(fit: Fit, recordings: Sequence[Recording], target: str | Path, files: Files = NO_FILES) -> Path:
    """Write the report of a fit to its recordings, as `write_report` does.

    Raises:
        MotorError: it cannot be written.
    """
    return _write(render_fit(fit, recordings, files), target)


def _write(text: str, target: str | Path) -> Path:
    path = Path(target)
    if path.suffix.lower() not in (".html", ".htm"):
        path = path / "report.html"
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_text(path, text)
    except OSError as error:
        raise MotorError(f"cannot write {path} {say_refusal(error)}.") from error
    return path
