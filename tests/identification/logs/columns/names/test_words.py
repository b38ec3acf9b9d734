"""A column's name is taken apart into words, however they are written together."""

import pytest

from motor_identification.logs.columns.names.words import find_device, find_side, split_words


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("leftSpeedRpm", ("left", "speed", "rpm")),
        ("wheel2_velocity", ("wheel", "2", "velocity")),
        ("MotorVoltage", ("motor", "voltage")),
        ("Motordrehzahl", ("motor", "drehzahl")),
        ("实际转速", ("实际", "转速")),
        ("Lspeed", ("l", "speed")),
        ("dticks", ("d", "ticks")),
        ("denc", ("denc",)),  # beside aenc, benc and cenc the fourth motor's
        ("dEncoder", ("d", "encoder")),
        ("dutycount", ("dutycount",)),
        ("lap", ("lap",)),  # no side of anything
        ("supply mV", ("supply", "mv")),
        ("ωref", ("ω", "ref")),
        ("duty%", ("duty", "%")),
    ],
)
def test_a_name_is_taken_apart(name: str, words: tuple[str, ...]) -> None:
    assert split_words(name) == words


@pytest.mark.parametrize(
    ("words", "side"),
    [
        (("speed", "left"), "left"),
        (("r", "speed"), "right"),
        (("r",), ""),  # a reference
        (("motor", "2", "speed"), "2"),
        (("speed", "2"), ""),  # of which motor?
    ],
)
def test_words_tell_the_side(words: tuple[str, ...], side: str) -> None:
    assert find_side(words) == side


def test_a_controller_of_brushless_motors_is_known_by_its_number() -> None:
    assert find_device(split_words("DutyCycle_V1")) == "1"
    assert find_device(split_words("x_V1")) == find_device(split_words("V1")) == ""
