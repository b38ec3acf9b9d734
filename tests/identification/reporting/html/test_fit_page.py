"""A fit in HTML: its numbers, cautions, pictures and next commands."""

import re
from dataclasses import replace
from html import unescape
from pathlib import Path

import pytest
from diagnosed import fitted

from motor_identification.diagnosis.result import Diagnosis
from motor_identification.reporting.fit_text import list_cautions
from motor_identification.reporting.html import Files, write_fit_report
from motor_identification.reporting.html.fit_page import render_fit
from motor_identification.reporting.html.next_steps import NO_FILES


def text_of(html: str) -> str:
    return re.sub(r"\s+", " ", unescape(re.sub(r"<[^>]+>", " ", html)))


@pytest.fixture(scope="module")
def html(found: Diagnosis) -> str:
    """The fit with Coulomb friction, to the recording that it was found in."""
    recordings = fitted(ks=0.4)[0].problem.recordings
    return render_fit(replace(found.model, notes=("<the bag> was cut off.",)), recordings, Files("found.yaml"))


@pytest.fixture
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pages without pictures, where only the text matters."""
    monkeypatch.setattr("motor_identification.reporting.html.pictures.draw_overlay", lambda *how: "")


def test_the_page_has_the_numbers(found: Diagnosis, html: str) -> None:
    text, fit = text_of(html), found.model
    assert f"{fit.residual_rms:.3g} rad/s" in text and f"{fit.noise_floor:.3g} rad/s" in text
    assert f"{fit.r_squared:.5f}" in text and f"{fit.residual_rms / fit.noise_floor:.2g}" in text
    row = re.search(r"ks ([\d.]+) ([\d.e-]+) ([\d.]+) … ([\d.]+) V", text)
    assert row is not None
    value, error, low, high = map(float, row.groups())
    assert value == pytest.approx(fit.parameters.value("ks"), abs=0.1 * fit.standard_errors["ks"])
    assert error == pytest.approx(fit.standard_errors["ks"], rel=0.05)
    assert low == pytest.approx(value - 1.96 * error, abs=0.2 * error)
    assert high == pytest.approx(value + 1.96 * error, abs=0.2 * error)
    for caution in (*list_cautions(fit), "<the bag> was cut off."):
        assert caution in text
    assert "<the bag>" not in html
    assert "ros2 run motor_sim motor_sim --ros-args -p model:=found.yaml" in text


def test_the_page_has_the_pictures(html: str) -> None:
    labels = re.findall(r'<svg role="img" aria-label="([^"]*)"', html)
    assert len(labels) == 4 and labels[0] == labels[1] and labels[2] == labels[3]  # for wide and narrow screens
    assert re.fullmatch(r"train\.bag, [\d.]+ to [\d.]+ s: the largest error", labels[0])
    assert labels[2] == "train.bag, whole recording"
    assert all(inside.startswith("#") for inside in re.findall(r"url\(([^)]*)\)", html))


@pytest.mark.usefixtures("undrawn")
def test_it_is_written_where_it_was_asked_for(found: Diagnosis, tmp_path: Path) -> None:
    recordings = fitted(ks=0.4)[0].problem.recordings
    path = write_fit_report(found.model, recordings, tmp_path / "new")
    assert path == tmp_path / "new" / "report.html" and path.read_text(encoding="utf-8").startswith("<!DOCTYPE html>")


@pytest.mark.usefixtures("undrawn")
def test_without_noise_and_variance_there_are_no_numbers(found: Diagnosis) -> None:
    one = replace(found.model, noise_floor=0.0, r_squared=float("nan"))
    text = text_of(render_fit(one, fitted(ks=0.4)[0].problem.recordings, NO_FILES))
    assert "noise floor unknown" in text and "R² –" in text and "nan" not in text.split("How to go on")[0]
