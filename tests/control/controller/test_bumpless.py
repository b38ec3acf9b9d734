"""No setting makes the voltage jump when it is changed in a running loop: the integral takes it up."""

import numpy as np
import pytest
from bench_board import drive, motor, settings
from tiers import keep_fast

from motor_control.controller import controller
from motor_model.parameters import PAPER_KV
from motor_model.sample import Info, Sample

CHANGES: dict[str, tuple[dict[str, object], dict[str, object]]] = {
    "larger gains": ({"speed_source": "measured", "feedforward": False}, {"kp": 1.0, "ki": 10.0}),
    "smaller gains": ({}, {"kp": 0.05, "ki": 0.5}),
    "observer": ({"speed_source": "measured", "feedforward": False}, {"speed_source": "observer"}),
    "measured": ({"feedforward": False}, {"speed_source": "measured"}),
    "feed-forward": ({"feedforward": False}, {"feedforward": True}),
    "no feed-forward": ({}, {"feedforward": False}),
    "observer with feed-forward": (
        {"speed_source": "measured", "feedforward": False},
        {"speed_source": "observer", "feedforward": True},
    ),
    "no model": ({}, {"model": None}),
    "irregularity": ({}, {"slot_irregularity": 0.05}),
}


@pytest.mark.parametrize("name", CHANGES)
@pytest.mark.parametrize("at", keep_fast([0.7, 0.065], 0.065))
def test_the_voltage_does_not_jump(name: str, at: float) -> None:
    """Settled, and on the way to 60 rad/s; the same loop without the change is the measure."""
    before, after = CHANGES[name]
    changed = drive(motor(), 60.0, at + 0.5, configs=[(at, after)], **before)  # type: ignore[arg-type]
    same = drive(motor(), 60.0, at + 0.5, **before)  # type: ignore[arg-type]
    k = round(at * 200.0)
    difference = changed.shown("voltage")[k] - same.shown("voltage")[k]
    assert abs(difference) < 1e-9
    assert np.array_equal(changed.voltage[: k + 1], same.voltage[: k + 1])
    assert changed.outputs[k].terms != same.outputs[k].terms or name == "irregularity"
    assert changed.speed[-1] == pytest.approx(60.0, rel=0.1)
    terms = changed.outputs[k].terms
    assert terms.voltage == pytest.approx(terms.proportional + terms.integral + terms.feedforward, abs=1e-9)


@pytest.mark.parametrize("source", ["measured", "observer"])
def test_an_integral_without_a_gain_is_forgotten(source: str) -> None:
    """Two channels: what it held from before would turn the motor for ever, at a reference of 0 too."""
    before = {"speed_source": source, "feedforward": False}

    def reference(time: float) -> float:
        return 60.0 if time < 1.0 else 0.0

    for gains in ({"ki": 0.0}, {"ki": 0.0, "kp": 0.0}, {"ki": 0.001}):
        run = drive(motor(), reference, 3.0, single_channel=False, configs=[(0.7, gains)], **before)  # type: ignore[arg-type]
        k = round(0.7 * 200.0)
        assert abs(run.voltage[k + 1] - run.voltage[k]) < 0.5 and run.speed[k + 5] > 50.0  # and does not jump
        assert abs(run.speed[-1]) < 0.1 and abs(run.voltage[-1]) < (0.95 if gains["ki"] else 0.05)


def test_another_model_takes_the_motion_over() -> None:
    info, state = Info(), controller.State()
    first, second = settings(motor(), info), settings(motor(kv=PAPER_KV * 1.1), info)
    config, voltages, speeds = first, [], []
    for k in range(60):
        config = second if k == 40 else first if k < 40 else config
        sample = Sample(k * 5_000_000, 0.0, voltages[-1] if voltages else 0.0, 0)
        output, state = controller.update(config, state, sample, 0.0 if k < 2 else 5.0, 0.0)
        voltages.append(output.terms.voltage)
        speeds.append(output.speed)
    assert abs(voltages[40] - voltages[39]) < 0.6 and max(voltages) <= 12.0
