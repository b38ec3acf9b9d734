"""What stops a loop for good, and what must not."""

from dataclasses import replace
from math import nan

import numpy as np
import pytest
from bench_board import DEFAULTS, drive, motor, settings
from bench_motor import Plant, close_loop

from motor_control.configuration import config_of
from motor_control.controller import controller
from motor_control.controller.controller import State
from motor_control.controller.faults import detection, stall
from motor_control.controller.output import Output
from motor_control.controller.reference.demand import Kind
from motor_model.sample import Info, Sample


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
    outputs = ignoring([True] * 5 + [False] * 90 + [True] * 5)
    off, on = outputs[20:95], outputs[96:]
    assert len({output.terms.integral for output in off}) == 1
    assert 0.5 < off[0].terms.integral < 5.5
    assert all("motor/enable" in output.reason and output.warning for output in off)
    assert all(output.state == controller.RUNNING for output in outputs)
    assert on[-1].reason == "" and on[-1].terms.integral > off[-1].terms.integral
    assert max(output.terms.integral for output in ignoring([True] * 205)) > 11.0


def ask(state: State, k: int, wanted: str) -> State:
    """Ask anew before the k-th sample, in one of the ways that end a run."""
    if wanted == "angle" and k % 2:
        return controller.refer(state, 500.0, 0.005 * k, Kind.POSITION)
    if wanted == "no number" and k % 10 == 5:
        return controller.refer(state, nan, 0.005 * k)
    return controller.release(state, 0.0)[1] if wanted == "release" and k % 10 == 5 else state


@pytest.mark.parametrize("wanted", ["speed", "angle", "no number", "release"])
def test_whoever_asks_for_something_else_again_and_again_blinds_no_check(wanted: str) -> None:
    """Stray edges on a lost line, of which the plant's own check knows nothing: the motor ran at full speed on."""
    random, state, voltage = np.random.default_rng(4), State(), 0.0
    config, count, time = settings(motor(), Info(single_channel=False)), 0, 0
    for k in range(400):
        sample = Sample(k * 5_000_000, 0.0, voltage, count, time, 0.01)
        if random.random() < 0.4:  # 80 a second
            period, time = max((k * 5_000_000 - time) * 1e-9 - 0.004 * random.random(), 1e-4), k * 5_000_000 - 10_000
            count += 1
            sample = replace(sample, edge_count=count, edge_time=time, edge_period=period, speed=0.065 / period)
        state = ask(state, k, wanted)
        if wanted == "release" and k % 10 == 6:  # it begins again with 0
            state = controller.refer(state, 0.0, 0.005 * k)
        fresh = 60.0 if k % 10 == 6 or wanted == "angle" and k % 2 == 0 else None
        output, state = controller.update(config, state, sample, fresh, 0.005 * k)
        voltage = output.terms.voltage
        if state.latched:
            break
    reason = "The reference is nan" if wanted == "no number" else "Edges do not fit"
    assert reason in state.latched and 0.005 * k < 1.0


def test_what_a_run_has_shown_is_not_held_against_one_much_later() -> None:
    known = detection.State(stalled=stall.State(0.4, 1))
    state = replace(State(), faults=known, judged=1_000_000_000)
    for later, kept in ((900_000_000, True), (1_100_000_000, False)):
        sample = Sample(1_000_000_000 + later, 0.0, 12.0)
        _, after = controller.update(config_of(DEFAULTS, Info()), state, sample, 50.0, 0.0)
        assert after.run is not None and (after.run.faults.stalled.time >= 0.4) == kept


def test_no_fault_in_ordinary_motion() -> None:
    def reference(time: float) -> float:
        return (100.0, -100.0, 0.0, 3.0, -3.0, 160.0, 0.0)[min(int(time / 0.4), 6)]

    for source in ("observer", "measured"):
        run = drive(motor(), reference, 2.8, speed_source=source, feedforward=source == "observer")
        assert run.states() == {"running"}
