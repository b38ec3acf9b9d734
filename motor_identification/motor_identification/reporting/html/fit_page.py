"""The page of a fit: everything its template shows, computed and worded."""

from collections.abc import Sequence

from motor_identification.recording import Recording
from motor_identification.reporting.curves import find_largest_error, make_fit_curves
from motor_identification.reporting.fit_text import list_cautions
from motor_identification.reporting.html.next_steps import Files, list_fit_steps
from motor_identification.reporting.html.pictures import Picture, draw_picture
from motor_identification.reporting.html.tables import list_parameters
from motor_identification.reporting.html.template import fill_template
from motor_identification.reporting.names import effect_name
from motor_identification.reporting.numbers import format_ratio
from motor_identification.uncertainty.result import Fit

MOST_RECORDINGS = 3  # that are drawn


def render_fit(fit: Fit, recordings: Sequence[Recording], files: Files) -> str:
    """Render the report of a fit to its recordings as HTML."""
    floor = fit.noise_floor
    return fill_template(
        "fit.html",
        fit=fit,
        motor=fit.parameters.name or recordings[0].info.name,
        effects=[effect_name(effect) for effect in fit.parameters.effects],
        times_floor=format_ratio(fit.residual_rms / floor) if floor > 0.0 else "",
        parameters=list_parameters(fit),
        cautions=list_cautions(fit),
        pictures=[picture for recording in recordings[:MOST_RECORDINGS] for picture in _draw_pictures(recording, fit)],
        left_out=max(len(recordings) - MOST_RECORDINGS, 0),
        steps=list_fit_steps(fit, files),
        model_file=files.model,
    )


def _draw_pictures(recording: Recording, fit: Fit) -> list[Picture]:
    """The seconds with the largest error, then the whole recording."""
    curves = make_fit_curves(recording, fit)
    start, stop = find_largest_error(curves, recording.duration)
    pictures = [draw_picture(curves, None, f"{recording.uri}, whole recording")]
    if start > 0.0 or stop < recording.duration:
        title = f"{recording.uri}, {start:g} to {stop:g} s: the largest error"
        pictures.insert(0, draw_picture(curves.between(start, stop), None, title))
    return pictures
