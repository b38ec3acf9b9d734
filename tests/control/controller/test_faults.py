"""What stops the motor for good, and what must not."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest
from bench_board import DEFAULTS, drive, motor
from bench_motor import Plant, close_loop

from motor_control.controller import controller, faults
from motor_control.controller.controller import Output, State
from motor_control.parameters import config_of
from motor_model.sample import Info, Sample

LIMIT = 12.0


def feed(rows: list[tuple[float, float, int]], config: faults.Config, period: float = 0.005) -> tuple[str, float]:
    """Rows of (speed [rad/s], voltage [V], edges): the first reason, and when [s]."""
    state = faults.State()
    for k, (speed, voltage, edges) in enumerate(rows):
        sample = Sample(round(k * period * 1e9), speed, voltage, edges)
        reason, state = faults.update(config, state, sample, speed, period, LIMIT)
        if reason:
            return reason, k * period
    return "", inf


def test_a_stall_is_full_voltage_without_an_edge_for_stall_time() -> None:
    config = faults.Config(stall_time=0.5)
    reason, when = feed([(0.0, -12.0, 7)] * 200, config)
    assert "blocked" in reason and 0.49 < when < 0.51
    assert feed([(0.0, 11.0, 7)] * 200, config)[0] == ""  # there is more to give
    assert feed([(0.0, 12.0, k // 50) for k in range(400)], config)[0] == ""  # edges still come
    assert feed([(0.0, 12.0, 7)] * 2000, faults.Config(stall_time=0.0))[0] == ""


def test_a_runaway_is_a_speed_that_grows_while_nothing_drives_it() -> None:
    config = faults.Config()
    growing = [(-1.0 - 0.5 * k, 12.0, k) for k in range(200)]  # wrong sign
    reason, when = feed(growing, config)
    assert "agree on the direction" in reason and 0.24 < when < 0.27
    stuck_bridge = [(20.0 + 0.5 * k, 0.0, k) for k in range(200)]
    assert feed(stuck_bridge, config)[1] == pytest.approx(0.25, abs=0.01)
    assert feed([(speed, -voltage, k) for speed, voltage, k in growing], config)[0] == ""  # driven
    assert feed([(100.0 - 0.4 * k, -12.0, k) for k in range(200)], config)[0] == ""  # braking
    assert feed([(20.0 + 0.05 * k, 0.0, k) for k in range(200)], config)[0] == ""  # hardly grows


def test_overspeed_is_beyond_the_model_and_more_than_one_odd_period() -> None:
    config = faults.Config(fastest=174.0)
    reason, when = feed([(230.0, 12.0, k) for k in range(50)], config)
    assert "230" in reason and 0.04 < when < 0.06
    assert feed([(230.0 if k % 5 == 0 else 170.0, 12.0, k) for k in range(400)], config)[0] == ""
    assert feed([(220.0, 12.0, k) for k in range(50)], config)[0] == ""
    assert feed([(1e4, 12.0, k) for k in range(50)], faults.Config())[0] == ""


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
    assert 0.49 < run.time[first] - run.time[full[0]] < 0.7


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
