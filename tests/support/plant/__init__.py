"""A motor with its encoder board that shares no formula with `motor_model`: the truth that tests hold it against.

Written from `interfaces.md` and physics alone: a fine fixed step (`motor.py`) through the terms of the equation
(`forces.py`), a slotted disc (`encoder.py`) and the board that counts and stamps its edges (`board.py`). A mistake in
`motor_model` therefore cannot cancel out. `recording.record` is the way in; `profiles` has voltages to drive it with.
"""

if __name__ != "plant":  # Numba's cache remembers the name a module was compiled under: a second one could not load it
    raise ImportError(f"Import the plant as `plant`, not as {__name__}: put the folder tests/support/ on sys.path.")

from .parameters import BEYOND_THE_TABLE, TABLE
from .recording import Truth, record

__all__ = ["BEYOND_THE_TABLE", "TABLE", "Truth", "record"]
