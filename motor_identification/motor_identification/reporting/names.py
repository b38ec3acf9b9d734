"""Effects by the names that people use, and lists of them in a sentence."""

from collections.abc import Sequence

from motor_model.effects import EFFECT_BY_NAME

MOST = 6  # effects that are listed by name in a sentence


def effect_name(effect: str) -> str:
    """Return an effect's name as a person writes it: `coulomb_friction` is Coulomb friction."""
    return EFFECT_BY_NAME[effect].title


def join_names(names: Sequence[str], last: str = "and") -> str:
    """Join names as a sentence lists them: a, b and c."""
    return "".join(names) if len(names) < 2 else ", ".join(names[:-1]) + f" {last} {names[-1]}"


def join_effects(effects: Sequence[str], last: str = "or") -> str:
    """Join effects by name, at most six of them, and count the others."""
    names = [effect_name(effect) for effect in effects]
    more = len(names) - MOST
    if more <= 0:
        return join_names(names, last)
    return f"{', '.join(names[:MOST])} and {more} {'other' if more == 1 else 'others'}"


def capitalize(text: str) -> str:
    """Begin a sentence with a capital, and leave the rest as it is."""
    return text[:1].upper() + text[1:]
