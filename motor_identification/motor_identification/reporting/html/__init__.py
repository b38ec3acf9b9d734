"""The report of a diagnosis: one HTML file with everything in it, to be read without a network and shown around."""

from pathlib import Path

from motor_identification.diagnosis.result import Diagnosis
from motor_identification.reporting.html.page import rendered
from motor_model.errors import MotorError

__all__ = ["write_report"]


def write_report(diagnosis: Diagnosis, target: str | Path) -> Path:
    """Write the report to a file that ends in .html, or as report.html into a directory; returns the file.

    Raises:
        MotorError: it cannot be written.
    """
    path = Path(target)
    if path.suffix.lower() not in (".html", ".htm"):
        path = path / "report.html"
    text = rendered(diagnosis)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise MotorError(f"cannot write {path}: {error.strerror}.") from error
    return path
