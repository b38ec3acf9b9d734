"""What can go wrong around a board, each worded as what to do next."""

from motor_model.errors import MotorError


class BoardError(MotorError):
    """A firmware that cannot be built, flashed or emulated here."""
