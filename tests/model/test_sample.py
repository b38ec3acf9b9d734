"""What a plant says of itself is checked where it is read."""

from dataclasses import replace
from math import inf, nan

import pytest

from motor_model.errors import MotorError
from motor_model.sample import RANGES, Info, check_info


@pytest.mark.parametrize("name", RANGES)
def test_each_number_has_a_range(name: str) -> None:
    low, high = RANGES[name]
    for value in (low, high):
        check_info(replace(Info(), **{name: value}))
    for value in (low - 1e-7, high * 1.001, inf, -inf, nan):
        with pytest.raises(MotorError, match=f"^motor/info says {name} .*: it must be from "):
            check_info(replace(Info(), **{name: value}))


def test_a_gear_that_is_said_is_one_that_there_is() -> None:
    check_info(replace(Info(), gear_ratio=0.001))
    for ratio in (5e-324, 7e-310, 1e-7, 0.000999):
        with pytest.raises(
            MotorError, match=r"^motor/info says gear_ratio .*: it must be 0 \(none\), or 0.001 and more"
        ):
            check_info(replace(Info(), gear_ratio=ratio))


def test_what_plants_are_is_taken() -> None:
    check_info(Info())
    check_info(replace(Info(), edges_per_revolution=65_536, sample_period=0.001, max_voltage=400.0))
