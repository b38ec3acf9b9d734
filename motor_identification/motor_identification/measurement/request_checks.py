"""Effects that no fit can have, or none of some recordings: said before anything is computed."""

from collections.abc import Sequence

from motor_identification.recording import Recording
from motor_model.errors import ModelError
from motor_model.sample import Measurement


def refuse_nonsense(recordings: Sequence[Recording], effects: tuple[str, ...]) -> None:
    """Raise a ModelError for effects that no fit can have, or none of these recordings."""
    if "missed_edges" in effects:
        raise ModelError("missed_edges is recognised in every fit and left out, not fitted: drop it from the effects.")
    for name in effects:
        if effects.count(name) > 1:
            raise ModelError(f"'{name}' is named twice: name every effect once.")
    for recording in recordings:
        if "encoder_eccentricity" in effects and recording.info.measurement is Measurement.SPEED:
            raise ModelError(
                f"encoder_eccentricity needs a recording that counts edges, and {recording.uri} has speeds only: drop "
                "it from the effects."
            )
