"""Two channels tell a motor that turns against its voltage from one that is braked; when that is a stop."""

import numpy as np
import pytest
from motion_samples import checked, sample

from motor_model.sample import Sample
from motor_model.sensing.motion_check import MotionCheck


@pytest.mark.parametrize("time_constant", [0.05, 1.0, 20.0])
def test_braking_a_flywheel_with_the_motor_is_no_stop(time_constant: float) -> None:
    """From top speed with half the voltage against the motion, whatever the inertia."""
    samples, speed = [], 170.0
    for k in range(2000):
        samples.append(sample(0.005 * k, k, speed, -6.0))
        speed += 0.005 / time_constant * (-85.0 - speed)
    check = MotionCheck(12.0, False)
    for one in samples:
        check = check.see(one)
        assert check.stop == ""


def test_turning_against_a_strong_voltage_without_slowing_down_is_a_stop() -> None:
    turning = [sample(0.05 * k, -k, -min(20.0 * k, 80.0) * (1.0 + 0.03 * (-1) ** k), 8.0) for k in range(30)]
    assert [bool(checked(False, *turning[:k]).stop) for k in (8, 20)] == [False, True]
    assert checked(True, *turning).stop == ""  # one channel does not know


@pytest.mark.parametrize(
    ("times", "stops"),
    [
        ((0.2, 0.4, 0.6), True),  # five edges a second, which a plant reports as a standstill
        ((0.2, 0.4, 0.59), True),
        ((0.2, 0.4, 0.66), False),  # each a quarter later than the one before: it comes to rest
        ((0.09, 0.18, 0.27), False),  # fast enough for a speed that tells
    ],
)
@pytest.mark.parametrize("sign", [1, -1])
def test_slow_edges_against_a_strong_voltage_are_a_stop(times: tuple[float, ...], stops: bool, sign: int) -> None:
    """A motor of 6 rad/s with 8 edges a turn and exchanged channels ran for ever."""
    edges = (0.0, *times)
    check = MotionCheck(12.0, single_channel=False)
    for k in range(160):
        passed = [at for at in edges if at <= 0.005 * k]
        period = passed[-1] - passed[-2] if len(passed) > 1 else 0.2
        check = check.see(Sample(k * 5_000_000, 0.0, 7.2 * sign, -sign * len(passed), edge_period=period))
        if check.stop:
            break
    assert check.stop.startswith("the motor turns against") == stops
    along = MotionCheck(12.0, single_channel=False)
    for k in range(160):
        along = along.see(Sample(k * 5_000_000, 0.0, 7.2, sum(at <= 0.005 * k for at in edges), edge_period=0.2))
    assert "against" not in along.stop


@pytest.mark.parametrize(("share", "stops"), [(0.25, False), (0.5, True)])
def test_pulses_against_the_motion_are_a_wrong_direction_if_they_are_strong_in_the_mean(
    share: float, stops: bool
) -> None:
    """A loop with its channels exchanged lets a fast motor coast and pushes on: 12 and 0 V in turn, for ever."""
    rng, on = np.random.default_rng(4), 0.0
    check, stopped = MotionCheck(12.0, False), 0.0
    for k in range(400):
        on += share
        pulse, on = (12.0, on - 1.0) if on >= 1.0 else (0.0, on)
        speed = -20.0 - 2.0 * float(rng.uniform())
        check = check.see(sample(0.005 * k, -k, speed, pulse))
        stopped = stopped or 0.005 * k * bool(check.stop)
    assert (0.39 < stopped < 0.6) if stops else not stopped
    assert not check.stop or check.stop.startswith("the motor turns against its voltage")


@pytest.mark.parametrize(("share", "stops"), [(0.296, True), (0.26, False)])
def test_what_presses_against_the_motion_for_good_is_a_wrong_sign(share: float, stops: bool) -> None:
    """A limit on plugging held exchanged channels at 0.296 of the voltage, at 26 % of the top speed, for ever."""
    turning = [sample(0.005 * k, -5 * k, -45.0, share * 12.0) for k in range(200)]
    at = next((0.005 * k for k in range(200) if checked(False, *turning[: k + 1]).stop), None)
    assert (at is not None) == stops and (at is None or 0.39 < at < 0.5)
    assert checked(True, *turning).stop == ""


def test_a_load_that_drives_the_motor_is_braked_by_what_presses_against_it() -> None:
    """It has been held back for long, and grown; then another reference brakes it hard, within 75 ms."""
    held = [sample(0.005 * k, -k, -(10.0 + 0.1 * min(k, 100)), 0.2 * 12.0) for k in range(300)]
    braked = [sample(1.5 + 0.005 * k, -300 - k, -20.0 + 0.6 * k, 12.0) for k in range(15)]
    assert not any(checked(False, *held, *braked[: k + 1]).stop for k in range(15))
