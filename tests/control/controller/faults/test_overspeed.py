"""Faster than the model can."""

from dataclasses import replace

from fault_bench import ENCODER, feed, turning


def test_overspeed_is_beyond_the_model_and_more_than_one_odd_period() -> None:
    config = replace(ENCODER, fastest=174.0)
    reason, when = feed([turning(230.0, 12.0)] * 50, config)
    assert "230" in reason and 0.04 < when < 0.06
    odd = [turning(230.0 if k % 5 == 0 else 170.0, 12.0) for k in range(400)]
    assert feed(odd, config)[0] == ""
    assert feed([turning(220.0, 12.0)] * 50, config)[0] == ""
    assert feed([turning(1e4, 12.0)] * 50, ENCODER)[0] == ""
