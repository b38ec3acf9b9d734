"""The one root of all errors that a user of the workbench is told about."""

from motor_model.printable import escape


class MotorError(Exception):
    """What is wrong and what to do about it, in one sentence; shells print it and exit with 1.

    Names in it may be anybody's: as text it is one line without control characters.
    """

    def __str__(self) -> str:
        return escape(super().__str__(), longest=0)


class ModelError(MotorError):
    """A set of parameters or a model file that does not describe a motor."""


class RecordingError(MotorError):
    """A recording that cannot be read, or cannot answer what was asked of it."""
