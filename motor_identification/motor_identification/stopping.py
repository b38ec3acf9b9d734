"""A way out of long computations: what was told to stop raises, wherever it is."""

from motor_model.errors import MotorError


class Stopped(MotorError):
    """The computation was told to stop."""
