"""Effects that no fit can have: said before anything is computed."""

from motor_model.effects import EFFECT_BY_NAME
from motor_model.errors import ModelError


def check_effects(effects: tuple[str, ...]) -> None:
    """Raise a ModelError for effects that no fit can have, and for one that is given twice."""
    for name in effects:
        effect = EFFECT_BY_NAME.get(name)  # unknown names are refused where effects are normalised
        if effect is not None and not effect.fitted:
            raise ModelError(f"{name} is detected in every fit and cannot be fitted: remove it from the effects.")
        if effects.count(name) > 1:
            raise ModelError(f"'{name}' is given twice: name every effect once.")
