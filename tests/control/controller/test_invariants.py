"""Whatever comes, in whatever order: within the limit, 0 V for bad input in time, a stop that only a call ends."""

from dataclasses import dataclass
from math import inf, isfinite, nan

from bench_board import DEFAULTS, motor, settings
from hypothesis import given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st

from motor_control.configuration import config_of
from motor_control.controller import controller
from motor_control.controller.controller import State
from motor_control.controller.output import RUNNING, STOPPED
from motor_model.sample import Info, Sample

CONFIGS = (
    config_of(DEFAULTS, Info()),
    config_of({**DEFAULTS, "voltage_limit": 3.0}, Info(single_channel=False, max_voltage=5.0)),
    settings(motor(), Info()),
    settings(motor(), Info(single_channel=False), kp=900.0, ki=9000.0),
)
PERIOD = 5_000_000  # [ns]


@dataclass(frozen=True)
class Step:
    """One period: what comes, and what somebody does."""

    kind: str  # sample | late | missing | doubled | nan | inf | back
    speed: float
    edges: int
    reference: float | None
    call: str  # "" | reset | release


STEPS = st.builds(
    Step,
    kind=st.sampled_from(["sample"] * 8 + ["late", "missing", "doubled", "nan", "inf", "back"]),
    speed=st.floats(-300.0, 300.0),
    edges=st.integers(0, 40),
    reference=st.none() | st.none() | st.floats(-200.0, 200.0),
    call=st.sampled_from([""] * 12 + ["reset", "release"]),
)


@hypothesis_settings(max_examples=150, deadline=None)
@given(steps=st.lists(STEPS, min_size=5, max_size=60), which=st.integers(0, len(CONFIGS) - 1))
def test_invariants(steps: list[Step], which: int) -> None:
    config, state, count, time, now = CONFIGS[which], State(), 0, 10**9, 0.0
    was_latched, call, asked, timed = "", "", 0.0, False  # timed: a sample of this clock has come in time
    for step in steps:
        now += 0.005
        time += PERIOD if step.kind != "back" else -PERIOD * 3
        if step.kind == "missing":
            output, state = controller.watch(config, state, now)
            assert output is None or output.terms.voltage == 0.0
            continue
        count += step.edges
        speed = {"nan": nan, "inf": inf}.get(step.kind, step.speed)
        sample = Sample(time, speed, asked, count, time - 1000, 1e-3)
        for _ in range(2 if step.kind == "doubled" else 1):
            late = 0.2 if step.kind == "late" else 0.0
            output, state = controller.update(config, state, sample, step.reference, now + late)
            asked = output.terms.voltage
            assert isfinite(asked) and abs(asked) <= config.voltage_limit
            if step.kind in ("nan", "inf") or (step.kind == "late" and timed) or state.latched:
                assert asked == 0.0 and output.state != RUNNING
            if was_latched and call != "reset":
                assert state.latched == was_latched and output.state == STOPPED
            was_latched, call = state.latched, ""
        timed = (timed and step.kind != "back") or step.kind in ("sample", "doubled")
        if step.call == "reset":
            state, call = controller.reset(state, now)[1], "reset"
        elif step.call == "release":
            state = controller.release(state, 0.0)[1]
        was_latched = state.latched


def test_silence_is_zero_within_its_time() -> None:
    for config in CONFIGS:
        state = State()
        for k in range(20):
            sample = Sample(10**9 + k * PERIOD, 50.0, 0.0, 4 * k, 10**9 + k * PERIOD - 9, 1.3e-3)
            _, state = controller.update(config, state, sample, 60.0, k * 0.005)
        assert controller.watch(config, state, 0.095 + config.sample_timeout)[0] is None
        output, _ = controller.watch(config, state, 0.0951 + config.sample_timeout)
        assert output is not None and output.terms.voltage == 0.0 and output.drives
