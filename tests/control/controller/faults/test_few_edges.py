"""Too few edges for the voltage."""

from math import exp

import pytest
from fault_bench import ENCODER, KNOWN, LOST, feed, turning

from motor_control.controller.faults.evidence import Config


@pytest.mark.parametrize("config", [ENCODER, KNOWN], ids=["learnt", "model"])
def test_edges_that_are_too_few_for_the_voltage(config: Config) -> None:
    """The line is lost at 100 rad/s, and the law answers with 12 V."""
    reason, when = feed(LOST + [(0.0, 12.0, 0.0)] * 200, config)
    assert "Edges do not fit the voltage: 12 V" in reason and 1.0 < when < 1.2
    reason, when = feed(LOST + [(4.0, 12.0, 60.0)] * 200, config)
    assert "Edges do not fit" in reason and 1.0 < when < 1.7
    assert feed(LOST + [turning(60.0, 12.0)] * 400, config)[0] == ""  # a heavy load
    assert feed(LOST + [turning(5.0, 12.0)] * 400, config, reference=5.0)[0] == ""  # heavier, but it does as told
    assert feed(LOST + [(0.0, 0.0, 0.0)] * 200, config)[0] == ""


def test_a_heavy_disc_from_rest_is_no_fault() -> None:
    """Time constants of up to 2 s, where the model knows one of 80 ms."""
    for time_constant in (0.08, 0.5, 2.0):
        rows = [turning(174.0 * (1.0 - exp(-k * 0.005 / time_constant)), 12.0) for k in range(400)]
        assert feed(rows, KNOWN, 150.0)[0] == "" == feed(LOST + rows, ENCODER, 150.0)[0]
