"""What is no number, again and again."""

from math import inf, nan

import pytest
from fault_bench import SLOT

from motor_control.controller import controller
from motor_control.controller.interruptions import Interruptions, count_interruption
from motor_control.controller.output import RUNNING, STOPPED
from motor_control.controller.pi import Config as Gains
from motor_control.controller.run import Config
from motor_model.sample import Sample

CONFIG = Config(Gains(0.2, 2.5, 12.0), 12.0, 0.1, 0.0, 0.0, sample_period=0.005)


def stopped(every: int, how: str, value: float = nan) -> tuple[float, str]:
    """When [s] the motor is stopped for good where every so many-th speed, or reference, is no number."""
    state = controller.State()
    for k in range(1, 2001):
        bad = k % every == 0
        sample = Sample(k * 5_000_000, value if bad and how == "sample" else 1.0, 3.0, k, k * 5_000_000, SLOT)
        reference = (value if bad else 50.0) if how == "reference" else 50.0 if k == 1 else None
        output, state = controller.update(CONFIG, state, sample, reference, 0.005 * k)
        assert output.state == (STOPPED if bad or state.latched else RUNNING)
        if state.latched:
            assert output.fault == state.latched and "motor/reset" in output.reason
            return 0.005 * k, state.latched
    return inf, ""


@pytest.mark.parametrize("value", [nan, inf, -inf])
@pytest.mark.parametrize("how", ["sample", "reference"])
def test_the_third_in_a_row_of_interruptions_stops_the_motor(how: str, value: float) -> None:
    """It was half of the voltage for ever, on a lost line, too."""
    for every in (2, 3, 10, 100):
        when, reason = stopped(every, how, value)
        assert when == pytest.approx(3 * every * 0.005)
        assert reason.startswith("A sample on motor/speed says" if how == "sample" else "The reference is")
        assert "comes and goes, 3 times within a second" in reason


@pytest.mark.parametrize("how", ["sample", "reference"])
def test_seldom_ones_do_not(how: str) -> None:
    assert stopped(202, how) == (inf, "")  # every 1.01 s


def test_one_that_lasts_is_one() -> None:
    state = Interruptions()
    for k in range(100):
        reason, state = count_interruption(state, "bad", 0.01 * k)
        assert not reason and state.count == 1
    reason, state = count_interruption(state, "", 1.0)
    assert not reason and not state.bad and state.count == 1
