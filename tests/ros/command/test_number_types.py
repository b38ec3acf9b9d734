"""Numbers on the command line."""

import argparse
from collections.abc import Callable

import pytest

from motor_ros.command.number_types import between, not_negative, positive, whole_between


@pytest.mark.parametrize(
    ("take", "text", "value"),
    [(positive, "0.5", 0.5), (not_negative, "0", 0.0), (positive, "0", None), (not_negative, "-1", None)]
    + [(positive, text, None) for text in ("inf", "nan", "much")]
    + [(between(1, 20), "20", 20.0), (between(1, 20), "20.5", None), (between(1, 20), "0.9", None)]
    + [(whole_between(-1, 3), "-1", -1), (whole_between(-1, 3), "4", None), (whole_between(-1, 3), "2.0", None)],
)
def test_numbers_outside_their_range_are_refused(take: Callable[[str], float], text: str, value: float | None) -> None:
    if value is not None:
        assert take(text) == value
        return
    with pytest.raises(argparse.ArgumentTypeError, match=text):
        take(text)
