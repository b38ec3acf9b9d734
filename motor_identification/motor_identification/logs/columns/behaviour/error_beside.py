"""Tell what is measured by the error beside it: both together are the set-point, which stays while they change."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.heading import Heading
from motor_identification.logs.columns.vocabulary import MOVES, Quantity, words_of
from motor_identification.logs.csv.table import Table

Floats = NDArray[np.float64]

ERRORS = words_of(
    "error err erro fehler erreur errore galat e écart ecart écarts ecarts uchyb odchylka regelabweichung hata"
)
FEWEST_STEPS = 20  # from row to row, in which what is measured changes with its error
STAYS = 0.9  # of them, in which the set-point stays
ROUNDED = 0.02  # of a step, that printed digits leave
DIGITS = 5.0  # the fewest last digits of a step that tells


def measured_beside_error(table: Table, headings: Sequence[Heading]) -> list[Heading] | None:
    """Read as motion what makes a set-point with an error beside it, whatever its name; None where nothing does.

    An error is a set-point less what was measured, or the other way round. Their sum, or difference, stays then from
    row to row but where the set-point is another one, while both change. What a controller puts out does no such thing:
    it goes with the error, by a gain of its own. Where several columns do it, or a motion has a name, nothing is told.
    """
    errors = [one for one in headings if ERRORS & set(one.words) and one.quantity in (None, Quantity.OTHER)]
    able = [one for one in headings if one not in errors and one.quantity in (None, Quantity.DUTY, Quantity.VOLTAGE)]
    if any(one.quantity in MOVES for one in headings):
        return None
    found: list[Heading] = []
    for error in errors:
        made_of = table.numbers(error.name)
        own = [one for one in able if _make_set_point(table.numbers(one.name), made_of)]
        if len(own) > 1:
            return None
        found += own
    if not found:
        return None
    return [replace(one, quantity=Quantity.POSITION) if one in found else one for one in headings]


def _make_set_point(values: Floats, error: Floats) -> bool:
    """Whether values and an error, shape (K,), change together so that their sum, or difference, stays.

    And is another number than 0: what a controller of a gain of 1 puts out is the error itself.
    """
    steps, others = np.diff(values), np.diff(error)
    size = np.abs(steps)
    digit = _find_digit(others)
    large = size >= max(float(np.median(size[size > 0.0])) if np.any(size > 0.0) else np.inf, DIGITS * digit)
    if np.count_nonzero(large) < FEWEST_STEPS:
        return False
    same = np.abs(np.abs(values) - np.abs(error))[1:] <= max(digit, _find_digit(steps))
    if np.mean(same[large]) > 0.5:
        return False
    left = [np.abs(steps + sign * others)[large] for sign in (1.0, -1.0)]
    return any(bool(np.mean(one <= ROUNDED * size[large] + digit) >= STAYS) for one in left)


def _find_digit(steps: Floats) -> float:
    """The smallest change of a column from its steps, shape (K - 1,): its last digit, if it is printed with few."""
    changes = np.abs(steps[steps != 0.0])
    return float(np.min(changes, initial=np.inf)) if len(changes) else 0.0
