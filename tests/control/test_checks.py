"""One sentence for a setting that does not work, naming it and its bound."""

from math import inf, nan

import pytest

from motor_control.checks import at_least
from motor_model.errors import MotorError


@pytest.mark.parametrize("value", [-0.1, nan, inf, -inf])
def test_what_does_not_work_is_named(value: float) -> None:
    with pytest.raises(MotorError, match=r"ki = .* does not work: give a finite number of at least 0\."):
        at_least(0.0, kp=1.0, ki=value)


def test_the_bound_itself_works() -> None:
    at_least(0.0, kp=0.0, ki=5.0)
