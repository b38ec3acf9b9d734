"""A port that cannot be opened is a sentence that says what to do."""

import errno

import pytest

from motor_driver.ports.port_error import COMMAND, cannot_open


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


@pytest.mark.parametrize(
    ("number", "says"),
    [
        (errno.ENOENT, "'p', there is none: plug the board in, or set --port (there are a and b)."),
        (
            errno.EBUSY,
            "'p', it is in use: end the other program that has opened it (another motor_driver, a serial monitor).",
        ),
        (None, "'p', it is no serial port that can do 9600 baud: set --port and --baud (there are a and b)."),
    ],
)
def test_a_command_names_its_options_and_tries_once(number: int | None, says: str) -> None:
    assert cannot_open("p", 9600, number, "there are a and b", COMMAND) == f"Cannot open serial port {says}"
