"""What stops the motor for good, and what must not."""

from dataclasses import replace
from math import exp, inf, tau

import numpy as np
import pytest
from bench_board import DEFAULTS, drive, motor
from bench_motor import Plant, close_loop

from motor_control.controller import controller, faults
from motor_control.controller.controller import State
from motor_control.controller.motion import Motion, follow_motion
from motor_control.controller.output import Output
from motor_control.parameters import config_of
from motor_model.sample import Info, Sample

LIMIT, SLOT = 12.0, tau / 96
ENCODER = faults.Config(slot=SLOT)
Row = tuple[float, float, float]  # speed [rad/s], voltage [V], edges a second


def feed(rows: list[Row], config: faults.Config, reference: float = 100.0, period: float = 0.005) -> tuple[str, float]:
    """The first reason, and when [s]; edges come evenly."""
    state, motion, edges = faults.State(), Motion(), 0.0
    for k, (speed, voltage, rate) in enumerate(rows):
        edges += rate * period
        sample = Sample(round(k * period * 1e9), speed, voltage, int(edges), edge_period=1.0 / rate if rate else 0.0)
        motion = follow_motion(motion, sample, config.slot, period, LIMIT)
        seen = faults.Seen(sample, speed, motion, reference, period, LIMIT)
        reason, state = faults.find_fault(config, state, seen)
        if reason:
            return reason, k * period
    return "", inf


def turning(speed: float, voltage: float) -> Row:
    return speed, voltage, abs(speed) / SLOT


def test_a_stall_is_full_voltage_without_an_edge_for_stall_time() -> None:
    reason, when = feed([(0.0, -12.0, 0.0)] * 200, ENCODER)
    assert "blocked" in reason and 0.49 < when < 0.51
    assert feed([(0.0, 11.0, 0.0)] * 200, ENCODER)[0] == ""  # there is more to give
    assert feed([(0.0, 12.0, 0.0)] * 2000, replace(ENCODER, stall_time=0.0))[0] == ""


@pytest.mark.parametrize(("rate", "stalls"), [(2.0, True), (9.0, True), (14.0, False)])
def test_edges_too_slow_to_be_reported_are_no_motion(rate: float, stalls: bool) -> None:
    assert (feed([(0.0, 12.0, rate)] * 400, ENCODER)[0] != "") == stalls


def test_a_runaway_is_a_speed_that_grows_while_nothing_drives_it() -> None:
    growing = [turning(-1.0 - 0.5 * k, 12.0) for k in range(200)]  # wrong sign
    reason, when = feed(growing, ENCODER)
    assert "agree on the direction" in reason and 0.24 < when < 0.27
    stuck_bridge = [turning(20.0 + 0.5 * k, 0.0) for k in range(200)]
    assert feed(stuck_bridge, replace(ENCODER, fastest=174.0))[1] == pytest.approx(0.25, abs=0.02)
    assert 0.25 < feed(stuck_bridge, ENCODER)[1] < 0.45  # by growth alone
    assert feed([turning(1.0 + 0.5 * k, 12.0) for k in range(200)], ENCODER)[0] == ""  # driven
    assert feed([turning(100.0 - 0.4 * k, -12.0) for k in range(200)], ENCODER)[0] == ""  # braking
    assert feed([turning(20.0 + 0.005 * k, 0.0) for k in range(200)], ENCODER)[0] == ""  # hardly grows


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


def test_overspeed_is_beyond_the_model_and_more_than_one_odd_period() -> None:
    config = replace(ENCODER, fastest=174.0)
    reason, when = feed([turning(230.0, 12.0)] * 50, config)
    assert "230" in reason and 0.04 < when < 0.06
    odd = [turning(230.0 if k % 5 == 0 else 170.0, 12.0) for k in range(400)]
    assert feed(odd, config)[0] == ""
    assert feed([turning(220.0, 12.0)] * 50, config)[0] == ""
    assert feed([turning(1e4, 12.0)] * 50, ENCODER)[0] == ""


KNOWN = replace(ENCODER, fastest=174.0, kv=0.066, time_constant=0.08, friction=0.5)
LOST = [turning(100.0, 7.3)] * 200


@pytest.mark.parametrize("config", [ENCODER, KNOWN], ids=["learnt", "model"])
def test_edges_that_are_too_few_for_the_voltage(config: faults.Config) -> None:
    """The line is lost at 100 rad/s, and the law answers with 12 V."""
    reason, when = feed(LOST + [(0.0, 12.0, 0.0)] * 200, config)
    assert "Edges do not fit the voltage: 12 V" in reason and 1.0 < when < 1.2
    reason, when = feed(LOST + [(4.0, 12.0, 60.0)] * 200, config)
    assert "Edges do not fit" in reason and 1.0 < when < 1.55
    assert feed(LOST + [turning(60.0, 12.0)] * 400, config)[0] == ""  # a heavy load
    assert feed(LOST + [turning(5.0, 12.0)] * 400, config, reference=5.0)[0] == ""  # heavier, but it does as told
    assert feed(LOST + [(0.0, 0.0, 0.0)] * 200, config)[0] == ""


def test_a_heavy_disc_from_rest_is_no_fault() -> None:
    """Time constants of up to 2 s, where the model knows one of 80 ms."""
    for time_constant in (0.08, 0.5, 2.0):
        rows = [turning(174.0 * (1.0 - exp(-k * 0.005 / time_constant)), 12.0) for k in range(400)]
        assert feed(rows, KNOWN, 150.0)[0] == "" == feed(LOST + rows, ENCODER, 150.0)[0]


@pytest.mark.parametrize(("spread", "noise"), [(0.1, False), (0.3, False), (1.3, True)])
def test_periods_that_jump_under_full_voltage_are_noise(spread: float, noise: bool) -> None:
    """Periods with a log-normal scatter; those of random edges scatter by 1.3, of a disc irregular by 20 % by 0.3."""
    rng, config = np.random.default_rng(4), ENCODER
    state, motion = faults.State(), Motion()
    reasons = []
    for k in range(200):
        sample = Sample(k * 5_000_000, 13.0, 12.0, k + 1, edge_period=0.005 * exp(spread * rng.standard_normal()))
        motion = follow_motion(motion, sample, SLOT, 0.005, LIMIT)
        reason, state = faults.find_fault(config, state, faults.Seen(sample, 13.0, motion, 100.0, 0.005, LIMIT))
        reasons.append(reason)
    assert any("periods jump by a factor of" in reason for reason in reasons) == noise


@pytest.mark.parametrize("source", ["observer", "measured"])
def test_a_blocked_shaft_stops_the_loop_until_reset(source: str) -> None:
    blocked = motor(("load_bias",), bias_voltage=0.0, ks=20.0, breakaway_voltage=30.0)
    run = drive(blocked, 40.0, 3.0, model=motor(), speed_source=source, feedforward=source == "observer")
    stopped = [output for output in run.outputs if output.state == controller.STOPPED]
    assert stopped and all(output.terms.voltage == 0.0 for output in stopped)
    assert run.outputs[-1].state == controller.STOPPED
    assert "blocked" in stopped[0].reason and "motor/reset" in stopped[0].reason
    first = next(k for k, output in enumerate(run.outputs) if output.state == controller.STOPPED)
    full = np.flatnonzero(run.voltage == 12.0)
    assert 0.07 < run.time[first] - run.time[full[0]] < 0.6


def test_a_wrong_sign_stops_the_loop() -> None:
    """Two channels, swapped: what the controller means for ahead goes back."""
    plant = Plant(single_channel=False)
    config = config_of({**DEFAULTS}, Info(single_channel=False))
    state, outputs = State(), []

    def answer(sample: Sample, time: float) -> float:
        nonlocal state
        seen = replace(sample, speed=-sample.speed, edge_count=-sample.edge_count)
        output, state = controller.update(config, state, seen, 50.0, time)
        outputs.append(output)
        return output.terms.voltage

    trace = close_loop(plant, answer, 1.0)
    assert outputs[-1].state == controller.STOPPED and "agree on the direction" in outputs[-1].reason
    assert trace.time[trace.voltages.index(0.0)] < 0.3
    assert plant.speed < 60.0


def ignoring(enabled: list[bool]) -> list[Output]:
    """A plant at rest whose output is off at some samples."""
    config, state, outputs = config_of({**DEFAULTS, "kp": 0.01}, Info()), State(), []
    for k, on in enumerate(enabled):
        voltage = state.run.asked if state.run and on else 0.0
        sample = Sample(k * 5_000_000, 0.0, voltage, 0)
        output, state = controller.update(config, state, sample, 20.0, 0.005 * k)
        outputs.append(output)
    return outputs


def test_an_output_that_is_off_does_not_wind_up_the_integral() -> None:
    outputs = ignoring([True] * 5 + [False] * 200 + [True] * 5)
    off, on = outputs[20:205], outputs[206:]
    assert len({output.terms.integral for output in off}) == 1
    assert 0.5 < off[0].terms.integral < 5.5
    assert all("motor/enable" in output.reason and output.warning for output in off)
    assert all(output.state == controller.RUNNING for output in outputs)
    assert on[-1].reason == "" and on[-1].terms.integral > off[-1].terms.integral
    assert max(output.terms.integral for output in ignoring([True] * 205)) > 11.0


def test_no_fault_in_ordinary_motion() -> None:
    def reference(time: float) -> float:
        return (100.0, -100.0, 0.0, 3.0, -3.0, 160.0, 0.0)[min(int(time / 0.4), 6)]

    for source in ("observer", "measured"):
        run = drive(motor(), reference, 2.8, speed_source=source, feedforward=source == "observer")
        assert run.states() == {"running"}
