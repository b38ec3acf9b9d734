"""Whatever samples, references and settings come: a finite voltage within the limit; nonsense is 0 V with a reason."""

from dataclasses import dataclass
from math import inf, isfinite, nan

import pytest
from bench_board import DEFAULTS, motor, settings
from hypothesis import given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st

from motor_control.configuration import config_of
from motor_control.controller import controller
from motor_control.controller.controller import State
from motor_model.sample import Info, Sample

EFFECTS = ("transport_delay", "dead_zone", "armature_inductance", "quadratic_drag", "coast_drive")
MODEL = motor(
    EFFECTS, delay=0.012, dead_zone_voltage=0.4, electrical_time_constant=0.002, drag=1e-4, coast_share=0.6
)  # fmt: skip
CONFIGS = (
    settings(MODEL, Info()),
    settings(MODEL, Info(single_channel=False), reference_rate_limit=500.0),
    settings(MODEL, Info(), feedforward=False, kp=900.0, ki=9000.0),
    settings(motor(), Info(max_voltage=3.0), speed_source="measured", stall_time=0.0),
    config_of(DEFAULTS, None),
)

ANY_FLOAT = st.floats(allow_nan=True, allow_infinity=True) | st.floats(-200.0, 200.0)
ANY_INT = st.integers(-50, 50) | st.integers(-(2**62), 2**62)


@dataclass(frozen=True)
class Step:
    """One sample and what happens around it."""

    advance: int  # [ns]
    speed: float
    voltage: float
    count: int
    edge: int  # [ns] after the sample
    period: float
    reference: float | None
    config: int
    reset: bool


STEPS = st.builds(
    Step,
    advance=st.integers(-(10**7), 10**8) | st.sampled_from([5_000_000]),
    speed=ANY_FLOAT,
    voltage=ANY_FLOAT,
    count=ANY_INT,
    edge=st.integers(-(10**7), 10**6) | ANY_INT,
    period=ANY_FLOAT,
    reference=st.none() | ANY_FLOAT,
    config=st.integers(0, len(CONFIGS) - 1),
    reset=st.booleans(),
)


@hypothesis_settings(max_examples=120, deadline=None)
@given(steps=st.lists(STEPS, min_size=1, max_size=25), one_config=st.booleans())
def test_the_voltage_is_finite_and_within_the_limit(steps: list[Step], one_config: bool) -> None:
    state, time = State(), 0
    for step in steps:
        time += step.advance
        config = CONFIGS[steps[0].config if one_config else step.config]
        sample = Sample(time, step.speed, step.voltage, step.count, time + step.edge, step.period)
        output, state = controller.update(config, state, sample, step.reference, 0.0)
        terms = output.terms
        assert isfinite(terms.voltage) and abs(terms.voltage) <= config.voltage_limit
        assert isfinite(terms.integral) and abs(terms.integral) <= config.gains.limit
        numbers = (step.speed, step.voltage, step.period, 0.0 if step.reference is None else step.reference)
        if not all(isfinite(number) for number in numbers):
            assert terms.voltage == 0.0 and output.state != controller.RUNNING and output.reason.endswith(".")
        state = controller.reset(state, 100.0)[1] if step.reset else state


@pytest.mark.parametrize("config", CONFIGS)
@pytest.mark.parametrize("value", [nan, inf, -inf])
@pytest.mark.parametrize("field", ["speed", "voltage", "edge_period", "reference"])
def test_one_that_is_no_number_is_zero_volts_and_a_reason(config: controller.Config, field: str, value: float) -> None:
    state, reasons, voltages = State(), [], []
    for k in range(12):
        numbers = {"speed": 50.0, "voltage": 5.0, "edge_period": 1e-3, "reference": 60.0}
        numbers |= {field: value} if k == 8 else {}
        sample = Sample(
            k * 5_000_000, numbers["speed"], numbers["voltage"], 4 * k, k * 5_000_000 - 9, numbers["edge_period"]
        )
        output, state = controller.update(config, state, sample, numbers["reference"], 0.0)
        reasons.append(output.reason)
        voltages.append(output.terms.voltage)
    assert voltages[8] == 0.0 and str(value) in reasons[8]
    assert reasons[9] == reasons[7] and voltages[11] != 0.0


def test_an_observer_that_is_lost_begins_anew(monkeypatch: pytest.MonkeyPatch) -> None:
    config, state = CONFIGS[0], State()
    assert config.observer is not None
    kind, update = type(config.observer), type(config.observer).update

    def lost(self, before, sample):  # type: ignore[no-untyped-def]
        estimate, after = update(self, before, sample)
        return type(estimate)(nan, nan, nan, nan, False), after

    outputs = []
    for k in range(6):
        if k == 3:
            monkeypatch.setattr(kind, "update", lost)
        if k == 4:
            monkeypatch.setattr(kind, "update", update)
        output, state = controller.update(config, state, Sample(k * 5_000_000, 0.0, 0.0), 60.0, 0.0)
        outputs.append(output)
    assert outputs[3].state == controller.STOPPED and outputs[3].terms.voltage == 0.0
    assert "observer" in outputs[3].reason and not state.latched
    assert outputs[4].state == controller.RUNNING and outputs[5].terms.voltage > 0.0
