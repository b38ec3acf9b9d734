"""No setting makes the voltage jump when it is changed in a running loop: the integral takes it up."""

import numpy as np
import pytest
from bench_board import DEFAULTS, drive, motor, settings

from motor_control.controller import controller
from motor_control.parameters import config_of
from motor_model.errors import MotorError
from motor_model.parameters import PAPER_KV
from motor_model.sample import Info, Measurement, Sample

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
@pytest.mark.parametrize("at", [0.7, 0.065])
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


@pytest.mark.parametrize(
    ("values", "info", "words"),
    [
        ({"speed_source": "observer"}, Info(), "No model is loaded, so the speed is the measured one"),
        ({"feedforward": True}, Info(), "there is no feed-forward"),
        ({"speed_source": "observer", "feedforward": True}, Info(), "measured one and there is no feed-forward"),
    ],
)
def test_what_cannot_be_had_is_said(values: dict[str, object], info: Info, words: str) -> None:
    config = config_of({**DEFAULTS, **values}, info)  # type: ignore[dict-item]
    assert config.observer is None and config.feedforward is None
    output, _ = controller.update(config, controller.State(), Sample(0, 50.0, 0.0), 60.0, 0.0)
    assert words in output.reason and "identify" in output.reason and output.warning
    assert output.state == controller.RUNNING and output.terms.proportional == pytest.approx(2.0)
    assert output.speed_sigma != output.speed_sigma


def test_the_observer_needs_to_know_the_encoder() -> None:
    values = {**DEFAULTS, "speed_source": "observer"}
    assert "motor/info" in config_of(values, None, motor()).note
    speeds = config_of(values, Info(measurement=Measurement.SPEED), motor())
    assert "stamp its edges" in speeds.note and speeds.observer is None
    unready = config_of(values, Info(), motor(), ready=False)
    assert "prepared" in unready.note and unready.observer is None
    known = config_of(values, Info(), motor())
    assert known.note == "" and known.observer is not None


def test_the_plants_voltage_replaces_the_models() -> None:
    config = config_of({**DEFAULTS, "speed_source": "observer", "feedforward": True}, Info(max_voltage=6.0), motor())
    assert config.voltage_limit == 6.0 and config.observer is not None and config.feedforward is not None
    assert config.observer.parameters.max_voltage == config.feedforward.parameters.max_voltage == 6.0
    assert config.faults.fastest == pytest.approx(6.0 / PAPER_KV)


def test_a_source_that_is_none_is_refused() -> None:
    with pytest.raises(MotorError, match="give measured or observer"):
        config_of({**DEFAULTS, "speed_source": "guess"}, None)
    with pytest.raises(MotorError, match="cannot read the model file"):
        config_of({**DEFAULTS, "model": "nowhere.yaml"}, None)
