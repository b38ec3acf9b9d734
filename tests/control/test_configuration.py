"""What parameters, plant and model make of the controller; what is asked for and cannot be had is said."""

from math import tau

import pytest
from bench_board import DEFAULTS, motor

from motor_control.configuration import config_of
from motor_control.controller import controller
from motor_model.errors import MotorError
from motor_model.parameters import PAPER_KV, Parameters
from motor_model.sample import Info, Measurement, Sample


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


@pytest.mark.parametrize(("rate", "few"), [(10.0, True), (61.0, True), (99.5, False), (100.0, False), (1000.0, False)])
def test_samples_that_are_too_few_for_the_checks_are_said(rate: float, few: bool) -> None:
    """At 10 Hz the default gains swing from 0 to 0.89 of the top speed, and nobody said a word."""
    config = config_of(DEFAULTS, Info(sample_period=1.0 / rate))
    output, _ = controller.update(config, controller.State(), Sample(0, 50.0, 0.0), 60.0, 0.0)
    assert output.state == controller.RUNNING and output.warning == few
    assert output.reason == "" if not few else f"Only {rate:.3g} samples a second" in output.reason


@pytest.mark.parametrize(("kp", "said"), [(0.2, False), (2.0, True)])
def test_gains_that_are_too_large_for_the_model_and_200_samples_a_second_are_said(kp: float, said: bool) -> None:
    config = config_of({**DEFAULTS, "kp": kp}, Info(), motor())
    assert config.gains.kp == kp and ("motor_control tune" in config.note) is said


@pytest.mark.parametrize(("quadrature", "even"), [(0, True), (1, True), (2, False), (4, False)])
def test_edges_are_even_where_one_flank_a_period_is_counted(quadrature: int, even: bool) -> None:
    assert config_of(DEFAULTS, Info(quadrature=quadrature), None).faults.even == even


@pytest.mark.parametrize(("edges", "few"), [(2, 2), (4, 4), (5, 0), (96, 0)])
def test_slots_that_are_few_are_known_one_by_one(edges: int, few: int) -> None:
    assert config_of(DEFAULTS, Info(edges_per_revolution=edges)).faults.few_slots == few


def test_the_plants_voltage_replaces_the_models() -> None:
    config = config_of({**DEFAULTS, "speed_source": "observer", "feedforward": True}, Info(max_voltage=6.0), motor())
    assert config.voltage_limit == 6.0 and config.observer is not None and config.feedforward is not None
    assert config.observer.parameters.max_voltage == config.feedforward.parameters.max_voltage == 6.0
    assert config.faults.fastest == pytest.approx(6.0 / PAPER_KV)


@pytest.mark.parametrize(("edges", "refused"), [(0.99, True), (1.01, False)])
@pytest.mark.parametrize("measurement", [Measurement.EDGES, Measurement.COUNTS])
def test_an_encoder_whose_edges_at_top_speed_count_as_a_standstill_is_refused(
    edges: float, refused: bool, measurement: Measurement
) -> None:
    """10 edges a second: a motor of 6 rad/s with 8 edges a turn and exchanged channels ran for ever."""
    slow = Parameters({"kv": PAPER_KV * 1000.0, "ka": 1.0}, max_voltage=12.0)
    gear = 10.0 * edges / (12.0 / PAPER_KV / 1000.0) * tau / 8.0
    info = Info(edges_per_revolution=8, gear_ratio=gear, measurement=measurement)
    config = config_of(DEFAULTS, info, slow)
    assert ("By its model this motor shows 9.9 edges a second" in config.unusable) == refused == bool(config.unusable)
    output, _ = controller.update(config, controller.State(), Sample(0, 0.0, 0.0), 0.1, 0.0)
    assert (output.terms.voltage == 0.0 and output.state == controller.STOPPED) == refused


def test_a_source_that_is_none_is_refused() -> None:
    with pytest.raises(MotorError, match="give measured or observer"):
        config_of({**DEFAULTS, "speed_source": "guess"}, None)
    with pytest.raises(MotorError, match="cannot read the model file"):
        config_of({**DEFAULTS, "model": "nowhere.yaml"}, None)
