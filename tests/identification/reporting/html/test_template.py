"""Templates: what is not given is an error, and what is given cannot break the page."""

import pytest
from jinja2 import UndefinedError

from motor_identification.reporting.html.template import fill_template


def test_a_value_that_is_missing_is_an_error() -> None:
    with pytest.raises(UndefinedError):
        fill_template("fit.html")


def test_every_template_and_style_is_installed() -> None:
    """What stands beside the modules and is no module goes into the package."""
    from pathlib import Path

    import motor_identification
    from motor_identification.reporting.html.template import HERE

    setup = (Path(motor_identification.__file__).resolve().parents[1] / "setup.py").read_text(encoding="utf-8")
    for suffix in {path.suffix for path in HERE.iterdir() if path.is_file()} - {".py"}:
        assert f'"reporting/html/*{suffix}"' in setup
