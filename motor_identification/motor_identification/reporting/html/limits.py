"""The limits of a diagnosis in sentences: what the recording could not show, what was left out, the noise floor."""

from motor_identification.diagnosis.result import Diagnosis
from motor_identification.reporting.diagnosis_table import describe_rises
from motor_identification.reporting.diagnosis_text import SEEN
from motor_identification.reporting.names import effect_name, join_names
from motor_model.effects import EFFECT_BY_NAME
from motor_model.sample import Measurement

NO_NOISE = (
    "The noise level is unknown, so there is no noise floor to compare the gap with: give the encoder's edges per "
    "revolution (edges_per_revolution of the plant, --edges-per-revolution of import_csv)."
)


def list_limits(diagnosis: Diagnosis) -> list[str]:
    """One sentence for each limit."""
    return [
        *_undetectable(diagnosis),
        *_left_out(diagnosis),
        *_noise_floor(diagnosis),
        _validated_by(diagnosis),
        *filter(None, (describe_rises(diagnosis),)),
        *dict.fromkeys((*diagnosis.model.notes, *_notes(diagnosis))),
    ]


def _undetectable(diagnosis: Diagnosis) -> list[str]:
    return [
        f"This recording could not show {effect_name(effect)} ({EFFECT_BY_NAME[effect].summary}); "
        f"the profile '{EFFECT_BY_NAME[effect].shown_by}' would."
        for effect in diagnosis.undetectable
    ]


def _left_out(diagnosis: Diagnosis) -> list[str]:
    counted = int(diagnosis.after.counted.sum())
    rows = (
        (diagnosis.left_out, "contain a reversal, or their direction is unknown (one encoder channel)"),
        (diagnosis.miscounted, "are off by whole slots: edges were missed or counted twice"),
    )
    unseen = "the fits have seen, too" if diagnosis.after.seen else "no fit has seen"
    said = [f"{number} intervals were left out because they {why}." for number, why in rows if number]
    return [f"The gap is computed over {counted} intervals that {unseen}.", *said]


def _noise_floor(diagnosis: Diagnosis) -> list[str]:
    """Say what the noise floor is made of, and how strong the random torque is."""
    info = diagnosis.after.recordings[0].info
    sensor, parts = diagnosis.after.floor(0.0), []
    if info.measurement is Measurement.EDGES and info.edge_resolution > 0.0:
        parts.append(f"{sensor:.3g} rad/s from the timer's tick of {1e6 * info.edge_resolution:.3g} µs")
    elif sensor > 0.0:
        parts.append(f"{sensor:.3g} rad/s from counts that are sampled, not stamped")
    if diagnosis.slot_share > 0.0 and info.measurement is Measurement.SPEED:
        rest = max(diagnosis.sensor_floor**2 - sensor**2, 0.0) ** 0.5
        parts.append(f"{rest:.3g} rad/s of white noise that the sensor has beside")
    elif diagnosis.slot_share > 0.0 and info.edges_per_revolution:
        rest = max(diagnosis.sensor_floor**2 - sensor**2, 0.0) ** 0.5
        parts.append(f"{rest:.3g} rad/s from slots that are irregular by {100 * diagnosis.slot_share:.2g} %")
    random = _list_random(diagnosis)
    if random:
        rest = max(diagnosis.noise_floor**2 - diagnosis.sensor_floor**2, 0.0) ** 0.5
        parts.append(f"{rest:.3g} rad/s from {' and '.join(random)}")
    if not parts:
        return [NO_NOISE]
    if len(parts) == 1:
        return [f"The noise floor is {parts[0]}."]
    return [f"The noise floor is {diagnosis.noise_floor:.3g} rad/s: {' and '.join(parts)} (root sum of squares)."]


def _list_random(diagnosis: Diagnosis) -> list[str]:
    """List what leaves the motion scattered whatever the sensor: a random torque, and gains that differ."""
    torque, scatter = diagnosis.disturbance, diagnosis.gain_scatter
    gains = [f"gains that differ by {100 * scatter:.2g} % from run to run"] if scatter > 0.0 else []
    return [*([] if torque is None else [f"a random torque of {torque.rms_voltage:.2g} V RMS"]), *gains]


def _validated_by(diagnosis: Diagnosis) -> str:
    if diagnosis.validation:
        return f"Validated on {join_names(diagnosis.validation)}; no physical parameter was fitted to this motion."
    if diagnosis.after.seen:
        return SEEN
    return (
        "Validated on a quarter of the recorded motion, which was kept out of every fit; a second recording "
        "(--validate) is a stronger test."
    )


def _notes(diagnosis: Diagnosis) -> tuple[str, ...]:
    return tuple(note for recording in diagnosis.after.recordings for note in recording.notes)
