"""A diagnosis in HTML: complete, true to the numbers, and readable without anything from outside."""

import json
import re
import shutil
import subprocess
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from tiers import keep_fast

from motor_identification.diagnosis.result import Diagnosis, Verdict
from motor_identification.discrepancy.region_text import describe_error
from motor_identification.reporting.diagnosis_table import format_diagnosis
from motor_identification.reporting.diagnosis_text import summarize_diagnosis
from motor_identification.reporting.html import write_report
from motor_identification.reporting.html.diagnosis_page import render_diagnosis
from motor_identification.reporting.html.next_steps import NO_FILES, Files
from motor_identification.reporting.html.tables import list_gaps
from motor_model.errors import MotorError

BROWSER = shutil.which("chromium") or shutil.which("google-chrome") or shutil.which("chromium-browser")


@pytest.fixture(scope="module")
def html(found: Diagnosis) -> str:
    return render_diagnosis(found, Files("found.yaml"))


class Reader(HTMLParser):
    """Collects what a page refers to, its tags and its text."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.references: list[str] = []
        self.tags: list[str] = []
        self.ids: list[str] = []
        self.text = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        for name, value in attrs:
            if name in ("src", "href", "xlink:href", "srcset", "action", "data"):
                self.references.append(value or "")
            elif name == "id":
                self.ids.append(value or "")

    def handle_data(self, data: str) -> None:
        self.text += data


def squeezed(text: str) -> str:
    return re.sub(r"\s+", " ", text)


def test_the_page_needs_nothing_from_outside(html: str) -> None:
    reader = Reader(html)
    assert len(reader.references) > 20
    assert all(reference.startswith(("#", "data:")) for reference in reader.references)
    assert "script" not in reader.tags and "@import" not in html
    assert all(inside.startswith(("#", "'#")) for inside in re.findall(r"url\(([^)]*)\)", html))
    assert len(html.encode()) < 3_000_000
    referred = {reference[1:] for reference in reader.references if reference.startswith("#")}
    referred |= set(re.findall(r"url\(#([^)]*)\)", html))
    assert referred <= set(reader.ids)
    assert set(re.findall(r"var\((--\w+)\)", html)) <= set(re.findall(r"(--\w+):", html))


def test_every_picture_is_there_for_both_screens(html: str) -> None:
    drawn = re.findall(r"<svg.*?</svg>", html, re.DOTALL)
    labels = []
    for one in drawn:
        root = ElementTree.fromstring(one)
        assert root.get("viewBox") and root.get("width") is None and root.get("role") == "img"
        labels.append(root.get("aria-label") or "")
    assert len([label for label in labels if "s: the largest change" in label]) == 2
    assert len([label for label in labels if "whole recording" in label]) == 2
    assert len([label for label in labels if label.startswith("gap over")]) == 7
    assert len([label for label in labels if label.startswith("residual torque over")]) == 3


def test_the_page_says_it_all(found: Diagnosis, html: str) -> None:
    text = squeezed(Reader(html).text)
    finding = found.findings[0]
    for part in (
        summarize_diagnosis(found),
        finding.where,
        "Less than 1 % of this improvement: quadratic drag.",
        "This recording could not show warm up",
        f"{found.left_out} intervals were left out",
        "ros2 run motor_sim motor_sim --ros-args -p model:=found.yaml",
        "irregular by 0.2",
        "timer's tick of 4 µs",
    ):
        assert part in text, part


@pytest.mark.usefixtures("undrawn")
def test_files_and_directories(found: Diagnosis, tmp_path: Path) -> None:
    assert write_report(found, tmp_path / "deep" / "there") == tmp_path / "deep" / "there" / "report.html"
    path = write_report(found, str(tmp_path / "own.html"))
    assert path == tmp_path / "own.html" and path.read_text(encoding="utf-8").startswith("<!DOCTYPE html>")
    (tmp_path / "file").write_text("")
    with pytest.raises(MotorError, match="cannot write"):
        write_report(found, tmp_path / "file" / "report.html")


@pytest.mark.usefixtures("undrawn")
@pytest.mark.parametrize("verdict", list(Verdict))
def test_every_verdict_has_a_page(variants: dict[Verdict, Diagnosis], verdict: Verdict) -> None:
    reader = Reader(render_diagnosis(variants[verdict], NO_FILES))
    text = squeezed(reader.text)
    assert squeezed(summarize_diagnosis(variants[verdict])) in text
    assert ("Largest errors of the model before" in text) == (verdict is not Verdict.NOTHING_MISSING)
    assert ("What was found" in text) == bool(variants[verdict].findings)
    assert ("experiment coast" in text) == (verdict is Verdict.UNDECIDED)


@pytest.mark.usefixtures("undrawn")
def test_names_cannot_break_the_page(found: Diagnosis) -> None:
    text = render_diagnosis(replace(found, bags=("<b>&'bag",), suggested_experiment="rich"), NO_FILES)
    assert "<b>&'bag" not in text and "&lt;b&gt;&amp;" in text
    assert "diagnose '<b>&'\"'\"'bag' rich" in Reader(text).text  # and neither the shell


@pytest.mark.slow
def test_without_findings_there_is_one_curve(variants: dict[Verdict, Diagnosis]) -> None:
    reader = Reader(render_diagnosis(variants[Verdict.UNEXPLAINED], NO_FILES))
    assert reader.tags.count("svg") == 14 and "before and after" not in reader.text
    assert "simulated" in reader.text and "worst 1" in reader.text


@pytest.mark.slow
def test_a_recording_too_short_to_hold_anything_out(variants: dict[Verdict, Diagnosis]) -> None:
    one = variants[Verdict.UNEXPLAINED]
    empty = replace(one.after, scored=tuple(np.zeros_like(marks) for marks in one.after.scored), miscounted=0)
    short = replace(one, verdict=Verdict.UNDECIDED, before=empty, after=empty, gap_before=0.0, gap_after=0.0)
    assert "too short to keep a part of it for validation" in summarize_diagnosis(short)
    assert (
        "no motion was kept for validation" in describe_error(empty, 0.0)
        and render_diagnosis(short, NO_FILES).count("</svg>") == 14
    )


@pytest.mark.usefixtures("undrawn")
def test_without_a_floor_there_is_no_ratio(found: Diagnosis) -> None:
    one = replace(found, noise_floor=0.0)
    assert "the noise level is unknown" in summarize_diagnosis(one)
    assert [row.times for row in list_gaps(one)] == ["", "", ""] and "–" in format_diagnosis(one)
    assert "inf" not in squeezed(Reader(render_diagnosis(one, NO_FILES)).text).split("How to go on")[0].lower().replace(
        "info", ""
    )


MEASURE = """<script>document.title = JSON.stringify([innerWidth, document.documentElement.scrollWidth,
[...document.querySelectorAll('.narrow')].filter(e => e.offsetWidth).length,
Math.min(...[...document.querySelectorAll('svg')].map(e => e.clientWidth).filter(w => w))]);</script>"""


@pytest.mark.skipif(BROWSER is None, reason="no Chromium here")
@pytest.mark.parametrize(("width", "narrow"), keep_fast([(1280, 0), (500, 2)], (500, 2)))
def test_it_opens_in_a_browser(html: str, tmp_path: Path, width: int, narrow: int) -> None:
    """Without a console error, and nothing wider than the screen; a browser's window is 500 pixels wide at least."""
    (tmp_path / "report.html").write_text(html.replace("</body>", f"{MEASURE}</body>"), encoding="utf-8")
    done = subprocess.run(
        [str(BROWSER), "--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", "--dump-dom",
         f"--user-data-dir={tmp_path / 'profile'}", f"--window-size={width},900", str(tmp_path / "report.html")],
        capture_output=True, text=True, timeout=100,
    )  # fmt: skip
    assert "CONSOLE" not in done.stderr, done.stderr
    title = re.search(r"<title>(.*?)</title>", done.stdout)
    assert title, done.stderr
    inner, needed, shown, smallest = json.loads(title[1])
    assert inner == width and needed <= inner and shown == narrow and smallest > 250


@pytest.mark.skipif(BROWSER is None, reason="no Chromium here")
def test_it_prints_on_full_pages(html: str, tmp_path: Path) -> None:
    """Sections break where a page ends; only pictures, rows and paragraphs stay whole."""
    (tmp_path / "report.html").write_text(html, encoding="utf-8")
    subprocess.run(
        [str(BROWSER), "--headless", "--no-sandbox", "--disable-gpu", f"--print-to-pdf={tmp_path / 'report.pdf'}",
         f"--user-data-dir={tmp_path / 'profile'}", str(tmp_path / "report.html")],
        capture_output=True, check=True, timeout=100,
    )  # fmt: skip
    pages = len(re.findall(rb"/Type\s*/Page\b(?!s)", (tmp_path / "report.pdf").read_bytes()))
    assert 2 <= pages <= 4
