"""A speed that grows by itself."""

from dataclasses import replace
from math import exp, inf

import numpy as np
import pytest
from fault_bench import ENCODER, SLOT, feed, turning


def test_a_runaway_is_a_speed_that_grows_while_nothing_drives_it() -> None:
    growing = [turning(-1.0 - 0.5 * k, 12.0) for k in range(200)]  # wrong sign
    reason, when = feed(growing, ENCODER)
    assert "agree on the direction" in reason and 0.24 < when < 0.27
    stuck_bridge = [turning(20.0 + 2.0 * k, 0.0) for k in range(200)]
    assert feed(stuck_bridge, replace(ENCODER, fastest=174.0))[1] == pytest.approx(0.25, abs=0.02)
    assert feed(stuck_bridge, ENCODER)[0] == ""  # or a load: nothing is known, and the motor has 0 V (seed 400029)
    assert feed([turning(1.0 + 0.5 * k, 12.0) for k in range(200)], ENCODER)[0] == ""  # driven
    assert feed([turning(100.0 - 0.4 * k, -12.0) for k in range(200)], ENCODER)[0] == ""  # braking
    assert feed([turning(20.0 + 0.005 * k, 0.0) for k in range(200)], ENCODER)[0] == ""  # hardly grows


def test_a_voltage_is_not_blamed_for_what_a_load_did_before() -> None:
    """At 0 V a load has driven a motor of which nothing is known, and now it is braked (seed 812089)."""
    driven = [turning(0.0, 0.0), *[turning(-0.2 * k, 0.0) for k in range(100)]]
    assert feed([*driven, *[turning(-20.0 + 0.2 * k, 7.0) for k in range(90)]], ENCODER) == ("", inf)
    reason, when = feed([*driven, *[turning(-20.0 - 0.5 * k, 7.0) for k in range(90)]], ENCODER)
    assert "agree on the direction" in reason and 0.74 < when < 0.8


@pytest.mark.parametrize(("spare", "stops"), [(0.15, True), (0.25, False)])
def test_a_load_that_is_allowed_drives_a_motor_without_a_voltage(spare: float, stops: bool) -> None:
    """From rest to 22 % of the top speed: a random torque of 5 % RMS stopped motors at 6 % (seeds 98005, 98016)."""
    rows = [turning(0.0, 0.0)] + [turning(0.22 * 174.0 * (1.0 - exp(-k * 0.005 / 0.08)), 0.0) for k in range(1, 200)]
    reason, _ = feed(rows, replace(ENCODER, fastest=174.0, spare=spare))
    assert bool(reason) == stops


@pytest.mark.parametrize("top", [6.0, 12.0, 30.0, 174.0, 600.0])
@pytest.mark.parametrize("known", [False, True])
def test_a_wrong_sign_is_a_runaway_whatever_the_top_speed(top: float, known: bool) -> None:
    """Full voltage, the wrong way, with a time constant of 80 ms: the bound was 10 rad/s, so slow motors ran on."""
    rows = [turning(-top * (1.0 - exp(-k * 0.005 / 0.08)), 12.0) for k in range(200)]
    reason, when = feed(rows, replace(ENCODER, fastest=top if known else inf))
    assert "agree on the direction" in reason and when < 0.3


def test_coasting_on_an_irregular_disc_is_no_runaway() -> None:
    """5 % of a slot: the reported speed jumps by 20 %, and one dip was the smallest speed."""
    rng = np.random.default_rng(2)
    for _ in range(20):
        rows = []
        for k in range(200):
            speed = 100.0 * exp(-k * 0.005 / 3.0)
            rows.append((speed * (1.0 + 0.07 * rng.standard_normal()), 0.0, speed / SLOT))
        assert feed(rows, ENCODER)[0] == "" == feed(rows, replace(ENCODER, fastest=174.0))[0]
