"""The page of a diagnosis: everything its template shows, computed and worded."""

from motor_identification.diagnosis.result import Diagnosis, Verdict
from motor_identification.discrepancy.missing_torque import describe_torque, estimate_missing_torque
from motor_identification.discrepancy.region_text import describe_region
from motor_identification.discrepancy.residual_maps import map_residuals
from motor_identification.discrepancy.worst_regions import find_worst_regions
from motor_identification.reporting.curves import find_largest_change, make_held_out_curves
from motor_identification.reporting.diagnosis_table import format_parameters
from motor_identification.reporting.diagnosis_text import summarize_diagnosis
from motor_identification.reporting.html.charts import draw_map, draw_torque
from motor_identification.reporting.html.limits import list_limits
from motor_identification.reporting.html.next_steps import Files, list_diagnosis_steps
from motor_identification.reporting.html.pictures import Picture, draw_picture
from motor_identification.reporting.html.tables import list_gaps, list_parameters, rank_alternatives
from motor_identification.reporting.html.template import fill_template
from motor_identification.reporting.numbers import describe_change, format_ratio
from motor_model.effects import EFFECT_BY_NAME

VERDICTS = {
    Verdict.EXPLAINED: "explained",
    Verdict.NOTHING_MISSING: "nothing is missing",
    Verdict.UNEXPLAINED: "not explained",
    Verdict.UNDECIDED: "undecided",
}
MOST_RECORDINGS = 3  # that get maps of their own


def render_diagnosis(diagnosis: Diagnosis, files: Files) -> str:
    """Render the report of a diagnosis as HTML."""
    regions = find_worst_regions(diagnosis.before, diagnosis.slot_share)
    show_regions = diagnosis.verdict is not Verdict.NOTHING_MISSING
    floor = diagnosis.noise_floor
    return fill_template(
        "diagnosis.html",
        d=diagnosis,
        motor=diagnosis.model.parameters.name or diagnosis.after.recordings[0].info.name,
        verdict=VERDICTS[diagnosis.verdict],
        summary=summarize_diagnosis(diagnosis),
        times_floor=format_ratio(diagnosis.gap_after / floor) if floor > 0.0 else "",
        gaps=list_gaps(diagnosis),
        effects=EFFECT_BY_NAME,
        regions=[describe_region(region) for region in regions] if show_regions else [],
        pictures=_draw_pictures(diagnosis),
        maps=_draw_maps(diagnosis),
        torques=_draw_torques(diagnosis),
        torque=describe_torque(estimate_missing_torque(diagnosis.after)),
        parameters=list_parameters(diagnosis.model, diagnosis.baseline),
        format_parameters=format_parameters,
        describe_change=describe_change,
        rank_alternatives=rank_alternatives,
        limits=list_limits(diagnosis),
        steps=list_diagnosis_steps(diagnosis, files),
        model_file=files.model,
    )


def _draw_pictures(diagnosis: Diagnosis) -> list[Picture]:
    """The seconds that the diagnosis changes most, then the whole recording they are from."""
    share = diagnosis.slot_share
    number, start, stop = find_largest_change(diagnosis)
    regions = find_worst_regions(diagnosis.before, share) if diagnosis.verdict is not Verdict.NOTHING_MISSING else ()
    before = make_held_out_curves(diagnosis.before, share, number, regions)
    after = make_held_out_curves(diagnosis.after, share, number, ()) if diagnosis.findings else None
    uri = diagnosis.after.recordings[number].uri
    what = "the largest change" if after else "the largest error"
    part = before.between(start, stop), after and after.between(start, stop)
    pictures = [draw_picture(before, after, f"{uri}, whole recording")]
    if start > 0.0 or stop < diagnosis.before.recordings[number].duration:
        pictures.insert(0, draw_picture(*part, f"{uri}, {start:g} to {stop:g} s: {what}"))
    return pictures


def _draw_maps(diagnosis: Diagnosis) -> list[str]:
    before = map_residuals(diagnosis.before, diagnosis.slot_share)
    after = map_residuals(diagnosis.after, diagnosis.slot_share) if diagnosis.findings else (None,) * len(before)
    pairs = zip(before, after, strict=True)
    return [draw_map(a, b, _uri(diagnosis, a.recording)) for a, b in pairs if a.recording < MOST_RECORDINGS]


def _draw_torques(diagnosis: Diagnosis) -> list[str]:
    torques = estimate_missing_torque(diagnosis.after)
    return [draw_torque(one, _uri(diagnosis, one.recording)) for one in torques if one.recording < MOST_RECORDINGS]


def _uri(diagnosis: Diagnosis, number: int) -> str:
    recordings = diagnosis.after.recordings
    return recordings[number].uri if number >= 0 and len(recordings) > 1 else ""
