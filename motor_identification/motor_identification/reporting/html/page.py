"""The page: everything the template shows, computed and worded."""

from dataclasses import dataclass
from pathlib import Path

from motor_identification.diagnosis.result import Diagnosis, Verdict
from motor_identification.discrepancy.missing_torque import shape_in_words
from motor_identification.discrepancy.residual_maps import maps, shape_left, worst
from motor_identification.discrepancy.worst_regions import sentence
from motor_identification.reporting.diagnosis_text import listed, named, quantity, summary
from motor_identification.reporting.html.charts import draw_map, draw_shape
from motor_identification.reporting.html.curves import curves, telling
from motor_identification.reporting.html.limits import limits
from motor_identification.reporting.html.onward import commands
from motor_identification.reporting.html.overlay import NARROW, WIDE, draw_overlay
from motor_identification.reporting.html.tables import ladder, lost, parameter_rows
from motor_model.effects import EFFECT_BY_NAME

HERE = Path(__file__).parent
VERDICTS = {
    Verdict.EXPLAINED: "explained",
    Verdict.NOTHING_MISSING: "nothing is missing",
    Verdict.UNEXPLAINED: "not explained",
    Verdict.UNDECIDED: "undecided",
}
MOST_RECORDINGS = 3  # that get maps of their own


@dataclass(frozen=True)
class Picture:
    """A picture in its forms for wide and narrow screens."""

    title: str
    wide: str
    narrow: str


def rendered(diagnosis: Diagnosis) -> str:
    """The whole report as HTML."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    environment = Environment(
        loader=FileSystemLoader(HERE), autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters |= {"named": named, "lost": lost, "listed": listed}
    regions = worst(diagnosis.before, diagnosis.slot_share)
    show_regions = diagnosis.verdict is not Verdict.NOTHING_MISSING
    return environment.get_template("page.html").render(
        d=diagnosis,
        motor=diagnosis.model.parameters.name or diagnosis.after.problem.recordings[0].info.name,
        verdict=VERDICTS[diagnosis.verdict],
        summary=summary(diagnosis),
        ladder=ladder(diagnosis),
        effects=EFFECT_BY_NAME,
        regions=[sentence(region) for region in regions] if show_regions else [],
        pictures=_pictures(diagnosis),
        maps=_maps(diagnosis),
        shapes=_shapes(diagnosis),
        shape=shape_in_words(shape_left(diagnosis.after)),
        parameters=parameter_rows(diagnosis),
        values=lambda one: ", ".join(quantity(name, *value) for name, value in one.parameters.items()),
        limits=limits(diagnosis),
        commands=commands(diagnosis),
        css=(HERE / "style.css").read_text(encoding="utf-8"),
    )


def _pictures(diagnosis: Diagnosis) -> list[Picture]:
    """The most telling seconds, then the whole recording they are from."""
    share = diagnosis.slot_share
    number, start, stop = telling(diagnosis)
    found = bool(diagnosis.findings)
    regions = worst(diagnosis.before, share) if diagnosis.verdict is not Verdict.NOTHING_MISSING else ()
    before = curves(diagnosis.before, share, number, regions)
    after = curves(diagnosis.after, share, number, ()) if found else None
    uri = diagnosis.after.problem.recordings[number].uri
    parts = [(f"{uri}, {start:g} to {stop:g} s: the most telling seconds", (start, stop)), (f"{uri}, all of it", None)]
    made = []
    for title, window in parts:
        one = before if window is None else before.between(*window)
        other = after if window is None or after is None else after.between(*window)
        made.append(Picture(title, *(draw_overlay(one, other, title, size) for size in (WIDE, NARROW))))
    return made


def _maps(diagnosis: Diagnosis) -> list[str]:
    before = maps(diagnosis.before, diagnosis.slot_share)
    after = maps(diagnosis.after, diagnosis.slot_share) if diagnosis.findings else (None,) * len(before)
    pairs = zip(before, after, strict=True)
    return [draw_map(a, b, _uri(diagnosis, a.recording)) for a, b in pairs if a.recording < MOST_RECORDINGS]


def _shapes(diagnosis: Diagnosis) -> list[str]:
    shapes = shape_left(diagnosis.after)
    return [
        draw_shape(shape, _uri(diagnosis, shape.recording)) for shape in shapes if shape.recording < MOST_RECORDINGS
    ]


def _uri(diagnosis: Diagnosis, number: int) -> str:
    recordings = diagnosis.after.problem.recordings
    return recordings[number].uri if number >= 0 and len(recordings) > 1 else ""
