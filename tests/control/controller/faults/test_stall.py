"""Full voltage, and no edge."""

from dataclasses import replace

import pytest
from fault_bench import ENCODER, feed


def test_a_stall_is_full_voltage_without_an_edge_for_stall_time() -> None:
    reason, when = feed([(0.0, -12.0, 0.0)] * 200, ENCODER)
    assert "blocked" in reason and 0.49 < when < 0.51
    assert feed([(0.0, 11.0, 0.0)] * 200, ENCODER)[0] == ""  # there is more to give
    assert feed([(0.0, 12.0, 0.0)] * 2000, replace(ENCODER, stall_time=0.0))[0] == ""


@pytest.mark.parametrize(("rate", "stalls"), [(2.0, True), (9.0, True), (14.0, False)])
def test_edges_too_slow_to_be_reported_are_no_motion(rate: float, stalls: bool) -> None:
    assert (feed([(0.0, 12.0, rate)] * 400, ENCODER)[0] != "") == stalls
