"""Numbers in a column of duties that are no duties: a program's code for a free motor, or for no value."""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

REGISTER = 255.0  # the full duty of most boards: a level of no other register by chance
FAR = 2.0  # times that, from which on a number is a code
MOST_CODES = 2
FEWEST_LEVELS = 3  # of duties beside 0, where they are of one sign


def find_codes(duties: Floats) -> tuple[float, ...]:
    """Find one or two numbers far beyond a register of 8 bits that all other duties, shape (K,), fill; empty if none.

    1000 beside -255 to 255 is "let it run free", not four times the supply. A larger register ends at a power of 2
    less 1.
    """
    if not np.any(np.abs(duties) == REGISTER) or np.any(duties % 1.0):
        return ()
    within = np.abs(duties) <= REGISTER
    beyond, levels = np.unique(duties[~within]), np.unique(duties[within])
    levels = levels[levels != 0.0]
    if len(beyond) > MOST_CODES or (len(levels) < FEWEST_LEVELS and np.min(levels) > 0.0):
        return ()
    if any(abs(code) < FAR * REGISTER or _ends_register(abs(code)) for code in beyond):
        return ()
    return tuple(map(float, beyond))


def _ends_register(number: float) -> bool:
    return bool(np.log2(number + 1.0) % 1.0 == 0.0 or np.log2(number) % 1.0 == 0.0)
