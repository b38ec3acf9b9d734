"""What a setting must satisfy, and the sentence for one that does not."""

from math import isfinite

from motor_model.errors import MotorError


def at_least(low: float, **values: float) -> None:
    """Check named settings.

    Raises:
        MotorError: one of them is not finite or below `low`.
    """
    for name, value in values.items():
        if not (isfinite(value) and value >= low):
            raise MotorError(f"{name} = {value:g} does not work: give a finite number of at least {low:g}.")
