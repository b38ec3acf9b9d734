"""What a protocol refuses."""

from motor_model.errors import MotorError


class ProtocolError(MotorError):
    """A board that speaks another version, or a value that does not fit on the wire."""
