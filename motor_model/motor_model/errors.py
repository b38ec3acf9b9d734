"""The one root of all errors that a user of the workbench is told about."""


class MotorError(Exception):
    """What is wrong and what to do about it, in one sentence; shells print it and exit with 1."""


class ModelError(MotorError):
    """A set of parameters or a model file that does not describe a motor."""


class RecordingError(MotorError):
    """A recording that cannot be read, or cannot answer what was asked of it."""
