"""Effects that no fit can have, or none of some recordings: said before anything is computed."""

from collections.abc import Sequence

from motor_identification.recording import Recording
from motor_model.effects import EFFECT_BY_NAME
from motor_model.errors import ModelError
from motor_model.sample import Measurement


def check_effects(recordings: Sequence[Recording], effects: tuple[str, ...]) -> None:
    """Raise a ModelError for effects that no fit can have, or none of these recordings."""
    for name in effects:
        effect = EFFECT_BY_NAME.get(name)  # unknown names are refused where effects are normalised
        if effect is not None and not effect.fitted:
            raise ModelError(f"{name} is detected in every fit and cannot be fitted: remove it from the effects.")
        if effects.count(name) > 1:
            raise ModelError(f"'{name}' is given twice: name every effect once.")
        if effect is not None and effect.on_disc:
            _check_edges(recordings, name)


def _check_edges(recordings: Sequence[Recording], effect: str) -> None:
    for recording in recordings:
        if recording.info.measurement is Measurement.SPEED:
            raise ModelError(
                f"{effect} needs a recording with encoder counts, and {recording.uri} has speeds only: remove it from "
                "the effects."
            )
