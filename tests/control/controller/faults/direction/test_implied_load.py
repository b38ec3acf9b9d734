"""A motion against the voltage that only a load could make which no motor may have."""

from collections.abc import Callable
from dataclasses import replace
from math import inf, nan, tau

import numpy as np
import pytest

from motor_control.controller.faults.direction import implied_load
from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.motion import Motion
from motor_model.sample import Sample

LIMIT, TOP, STEP = 12.0, 60.0, 1e-4  # [V], [rad/s], [s]
Course = Callable[[float], float]


def two_channels(lag: float = 0.1, edges: int = 96) -> Config:
    """A motor that the model knows, without friction."""
    return Config(slot=tau / edges, fastest=TOP, kv=LIMIT / TOP, time_constant=lag, two_channels=True)


def turn(config: Config, volts: Course, load: Course, speed: float, uneven: float = 0.0, show: int = 1) -> list[Sample]:
    """A second of motion under a voltage and a load [V], sampled every 5 ms; show: -1 with exchanged channels."""
    flanks = config.slot * (np.arange(-4000, 4000) + uneven * np.random.default_rng(3).standard_normal(8000))
    angle, latest, period, stamp, samples = 0.0, 4000, 0.0, 0.0, []
    for k in range(10_000):
        time = k * STEP
        if k % 50 == 0:
            count = show * (latest - 4000)
            samples.append(Sample(k * 100_000, 0.0, volts(time), count, round(stamp * 1e9), period))
        force = volts(time) + load(time) - config.kv * speed
        speed += force / (config.kv * config.time_constant) * STEP
        angle += speed * STEP
        while not flanks[latest] <= angle < flanks[latest + 1]:
            latest += 1 if angle >= flanks[latest + 1] else -1
            period, stamp = time + STEP - stamp, time + STEP
    return samples


def judge(config: Config, samples: list[Sample]) -> tuple[str, float]:
    """The first reason, and when [s]."""
    state = implied_load.NONE
    for sample in samples:
        seen = Seen(sample, 0.0, Motion(), 0.0, 0.005, LIMIT)
        reason, state = implied_load.check(config, state, seen)
        if reason:
            return reason, sample.sample_time * 1e-9
    return "", inf


@pytest.mark.parametrize(
    ("lag", "share", "found"),
    [(0.02, 0.27, False), (0.02, 0.36, True), (0.1, 0.27, False), (0.1, 0.36, True)]
    + [(0.5, 0.36, False), (0.5, 0.55, True)],  # by how much a flywheel's speed changes is less certain
)
def test_exchanged_channels_show_a_load_of_twice_the_voltage(lag: float, share: float, found: bool) -> None:
    config = two_channels(lag)
    samples = turn(config, lambda t: share * LIMIT, lambda t: 0.0, 6.0, show=-1)
    reason, when = judge(config, samples)
    assert bool(reason) is found and (not found or 0.15 <= when < 0.3)
    assert not found or f" against {share * LIMIT:.3g} V, as if a load drove it with " in reason
    assert judge(config, turn(config, lambda t: share * LIMIT, lambda t: 0.0, 6.0)) == ("", inf)


@pytest.mark.parametrize("way", [1.0, -1.0])
@pytest.mark.parametrize(("share", "found"), [(0.25, False), (0.55, False), (0.75, True)])
def test_a_load_that_is_let_be_may_drive_the_motor_against_its_voltage(share: float, found: bool, way: float) -> None:
    config = two_channels()
    samples = turn(config, lambda t: -0.2 * way * LIMIT, lambda t: share * way * LIMIT, 0.0)
    reason, _ = judge(config, samples)
    assert bool(reason) is found
    if found:
        volts = float(reason.split("drove it with ")[1].split(" V")[0])
        assert 0.6 * LIMIT <= volts <= share * LIMIT + 1e-6


@pytest.mark.parametrize("lag", [0.02, 0.1, 1.0])
@pytest.mark.parametrize("uneven", [0.0, 0.05])
def test_a_reversal_from_top_speed_is_none(lag: float, uneven: float) -> None:
    config = two_channels(lag)
    assert judge(config, turn(config, lambda t: -LIMIT, lambda t: 0.0, TOP, uneven)) == ("", inf)


@pytest.mark.parametrize(("share", "found"), [(0.0, False), (0.09, False), (0.11, True)])
def test_at_hardly_any_voltage_a_stop_would_give_no_less(share: float, found: bool) -> None:
    """Somebody turns the wheel by hand, or pushes the robot."""
    config = two_channels()
    assert bool(judge(config, turn(config, lambda t: -share * LIMIT, lambda t: 0.95 * LIMIT, 0.0))[0]) is found


def test_a_load_that_helps_a_voltage_is_none() -> None:
    config = two_channels()
    assert judge(config, turn(config, lambda t: 0.3 * LIMIT, lambda t: LIMIT, 0.0)) == ("", inf)
    to_and_fro = turn(config, lambda t: LIMIT * (0.3 if t % 0.1 < 0.01 else -0.3), lambda t: LIMIT, 0.0)
    assert judge(config, to_and_fro) == ("", inf)


def test_a_motion_that_turns_round_begins_anew() -> None:
    """What was turned the other way is no speed of this one."""
    config = two_channels()
    turned = turn(config, lambda t: LIMIT * (t > 0.13) * 0.4, lambda t: -0.55 * LIMIT, 55.0)
    assert judge(config, turned) == ("", inf)


def test_periods_of_several_flanks_say_little_of_a_speed() -> None:
    """A flywheel that is braked, on a sensor whose channels are high for a third of a period each."""
    config = replace(two_channels(0.5), even=False)
    samples = turn(config, lambda t: -0.3 * LIMIT, lambda t: 0.0, 0.5 * TOP)
    odd = [replace(one, edge_period=one.edge_period * (0.6 + 0.8 * (one.edge_count % 2))) for one in samples]
    assert judge(config, odd) == ("", inf) and judge(replace(config, even=True), odd)[0]
    quick = replace(two_channels(0.05), even=False)
    assert judge(quick, turn(quick, lambda t: 0.5 * LIMIT, lambda t: 0.0, 1.0, show=-1))[0]


def test_a_count_that_jumps_and_voltages_that_are_none_are_no_motion() -> None:
    config = two_channels()
    driven = turn(config, lambda t: -0.2 * LIMIT, lambda t: 0.5 * LIMIT, 20.0)
    jumped = [replace(one, edge_count=one.edge_count + 500 * (k > 20)) for k, one in enumerate(driven)]
    assert judge(config, jumped) == ("", inf)
    exchanged = turn(config, lambda t: 0.5 * LIMIT, lambda t: 0.0, 6.0, show=-1)
    odd = [replace(one, voltage=nan) if k % 20 == 0 else one for k, one in enumerate(exchanged)]
    assert judge(config, odd) == ("", inf)
    assert judge(config, [*odd[:21], *exchanged[21:]])[0]  # it is forgotten


@pytest.mark.parametrize("change", [{"two_channels": False}, {"kv": 0.0}, {"slot": 0.0}, {"stall_time": 0.0}])
def test_without_direction_model_edges_or_the_wish_nothing_is_implied(change: dict[str, float]) -> None:
    config = two_channels()
    samples = turn(config, lambda t: 0.5 * LIMIT, lambda t: 0.0, 6.0, show=-1)
    assert judge(config, samples)[0] and judge(replace(config, **change), samples) == ("", inf)  # type: ignore[arg-type]
