"""A port that cannot be opened is a sentence that says what to do."""

import errno

import pytest

from motor_driver.ports.port_error import cannot_open


@pytest.mark.parametrize(
    ("number", "says"),
    [
        (
            errno.ENOENT,
            "'p', there is none: plug the board in, or set the parameter port (there are a and b)",
        ),
        (errno.EACCES, "'p', no permission: add yourself to the group dialout (sudo usermod -aG dialout "),
        (errno.EBUSY, "'p', it is in use: end the other program"),
        (errno.EAGAIN, "'p', it is in use: end the other program"),
        (None, "'p', it is no serial port that can do 9600 baud"),
    ],
)
def test_each_error_has_its_cure(number: int | None, says: str) -> None:
    said = cannot_open("p", 9600, number, "there are a and b")
    assert f"Cannot open serial port {says}" in said and said.endswith("; retrying.")
