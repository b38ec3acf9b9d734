"""The recording's limits in sentences: what it could not have shown, what was left out, what the floor is made of."""

from motor_identification.diagnosis.result import Diagnosis
from motor_identification.reporting.diagnosis_text import named
from motor_model.effects import EFFECT_BY_NAME
from motor_model.sample import Measurement


def limits(diagnosis: Diagnosis) -> list[str]:
    """One sentence for each limit."""
    return [
        *_unseen(diagnosis),
        *_left_out(diagnosis),
        *_floor(diagnosis),
        _judged_by(diagnosis),
        *dict.fromkeys((*diagnosis.model.notes, *_notes(diagnosis))),
    ]


def _unseen(diagnosis: Diagnosis) -> list[str]:
    return [
        f"It could not have shown {named(effect)} ({EFFECT_BY_NAME[effect].summary}); "
        f"the profile '{EFFECT_BY_NAME[effect].shown_by}' would."
        for effect in diagnosis.undetectable
    ]


def _left_out(diagnosis: Diagnosis) -> list[str]:
    counted = int(diagnosis.after.counted.sum())
    rows = (
        (diagnosis.left_out, "contain a reversal, or a direction that one channel cannot tell"),
        (diagnosis.miscounted, "are off by whole slots: edges that were not counted, or counted twice"),
    )
    said = [f"{number} intervals were left out because they {why}." for number, why in rows if number]
    return [f"The gap is over {counted} intervals of held-out motion.", *said]


def _floor(diagnosis: Diagnosis) -> list[str]:
    info = diagnosis.after.problem.recordings[0].info
    parts = []
    if info.measurement is Measurement.EDGES and info.edge_resolution > 0.0:
        tick = diagnosis.after.floor(0.0)
        parts.append(f"{tick:.3g} rad/s from the timer's tick of {1e6 * info.edge_resolution:.3g} µs")
    elif diagnosis.after.floor(0.0) > 0.0:
        parts.append(f"{diagnosis.after.floor(0.0):.3g} rad/s from counts that are sampled, not stamped")
    if diagnosis.slot_share > 0.0 and info.edges_per_revolution:
        rest = max(diagnosis.noise_floor**2 - diagnosis.after.floor(0.0) ** 2, 0.0) ** 0.5
        parts.append(f"{rest:.3g} rad/s from slots that are irregular by {100 * diagnosis.slot_share:.2g} % of a slot")
    if not parts:
        return ["The recording says nothing of its own noise: there is no floor to compare the gap with."]
    return [
        f"The noise floor of {diagnosis.noise_floor:.3g} rad/s is made of {' and '.join(parts)} (added in squares)."
    ]


def _judged_by(diagnosis: Diagnosis) -> str:
    if diagnosis.validation:
        return f"Judged by {', '.join(diagnosis.validation)}, which no physical parameter was fitted on."
    return "Judged by parts of the recording that were kept out of every fit; a recording of its own would say more."


def _notes(diagnosis: Diagnosis) -> tuple[str, ...]:
    return tuple(note for recording in diagnosis.after.problem.recordings for note in recording.notes)
