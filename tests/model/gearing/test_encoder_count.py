"""Counts per turn out of a plant's parameters, and what contradicts itself."""

from fractions import Fraction

import pytest

from motor_model.errors import MotorError
from motor_model.gearing.encoder_count import EncoderCount, read_encoder_count

DEFAULTS = {
    "edges_per_revolution": 96,
    "single_channel": True,
    "quadrature": 1,
    "pulses_per_revolution": 0,
    "gear_ratio": "1",
}


@pytest.mark.parametrize(
    ("said", "count"),
    [
        ({}, EncoderCount(96, 1, True, Fraction(1))),
        ({"edges_per_revolution": 12, "single_channel": False}, EncoderCount(12, 1, False, Fraction(1))),
        ({"pulses_per_revolution": 11, "quadrature": 4}, EncoderCount(44, 4, False, Fraction(1))),
        ({"pulses_per_revolution": 11, "quadrature": 2, "edges_per_revolution": 22}, EncoderCount(22, 2, False, 1)),
        ({"pulses_per_revolution": 11, "gear_ratio": "34.014"}, EncoderCount(11, 1, True, Fraction(17007, 500))),
    ],
)
def test_counts_are_pulses_times_quadrature(said: dict[str, object], count: EncoderCount) -> None:
    assert read_encoder_count(DEFAULTS | said) == count


@pytest.mark.parametrize(
    ("said", "why"),
    [
        ({"quadrature": 3}, "quadrature is 3: it must be 1, 2 or 4"),
        ({"quadrature": 4}, "pulses_per_revolution is not said"),
        (
            {"quadrature": 4, "pulses_per_revolution": 11, "edges_per_revolution": 11},
            "4 × 11 pulses make 44",
        ),
        ({"quadrature": 4, "pulses_per_revolution": 90_000}, "360000 counts a turn, and 100,000 are the most"),
        ({"gear_ratio": "34:1"}, "gear_ratio '34:1' is no ratio"),
    ],
)
def test_what_contradicts_itself_is_one_sentence(said: dict[str, object], why: str) -> None:
    with pytest.raises(MotorError, match=why):
        read_encoder_count(DEFAULTS | said)
