"""A loop whose samples come too seldom for its gains works with lower ones; one whose gains they bear is let be."""

from math import expm1

import numpy as np
import pytest
from bench_board import DEFAULTS
from hypothesis import given
from hypothesis import strategies as st
from tuning_bench import tuning

from motor_control.configuration import config_of
from motor_control.controller import controller, pi
from motor_control.controller.faults.evidence import Config as FaultConfig
from motor_control.controller.timing.sample_rate import (
    GUESSED,
    SHARE,
    are_few,
    explain_lowering,
    lower_gains,
    warn_of_swing,
)
from motor_control.controller.timing.timekeeping import find_longest_hold
from motor_control.tuning.speed_feedback import MEASURED, OBSERVER
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_model.sensing.board import BoardConfig, SimulatedBoard

TIME_CONSTANT = PAPER_KA / PAPER_KV  # [s]
GAINS = pi.Config(DEFAULTS["kp"], DEFAULTS["ki"], 12.0)
KNOWN, UNKNOWN = FaultConfig(kv=PAPER_KV, time_constant=TIME_CONSTANT), FaultConfig()
TOPS = [30.0, 174.0, 600.0]  # [rad/s] at 12 V


def lower(rate: float, gains: pi.Config = GAINS, faults: FaultConfig = KNOWN, most: float = 0.0) -> pi.Config:
    return lower_gains(gains, faults, most, 12.0, 1.0 / rate)


@pytest.mark.parametrize("faults", [KNOWN, UNKNOWN])
@pytest.mark.parametrize(("rate", "bears"), [(10, 0), (20, 0), (42, 0), (43, 1), (50, 1), (100, 1), (200, 1)])
def test_gains_are_lowered_where_the_period_is_longer_than_they_bear(
    rate: float, bears: bool, faults: FaultConfig
) -> None:
    """The limit is that of a late answer, for gains whose zero is on the pole; on either side of it."""
    assert (1.0 / rate <= find_longest_hold(GAINS, KNOWN, None, 1.0)) == bears
    after = lower(rate, faults=faults)
    assert (after is GAINS) == bears
    share = SHARE if faults is KNOWN else GUESSED
    if not bears:
        assert after.kp == pytest.approx(share * PAPER_KV / expm1(1.0 / (rate * TIME_CONSTANT)))
        assert after.ki == pytest.approx(share * PAPER_KV * rate)


def test_from_a_hundred_samples_a_second_on_any_gains_are_let_be() -> None:
    wild = pi.Config(10.0, 500.0, 12.0)
    assert lower(100.0, wild) is wild and lower(99.5, wild) is wild
    assert lower(98.0, wild).kp < 0.1 * wild.kp
    assert not are_few(0.0) and lower_gains(wild, KNOWN, 0.0, 12.0, 0.0) is wild


def test_only_what_is_too_large_is_lowered() -> None:
    assert lower(10.0, pi.Config(0.003, 2.5, 12.0)) == pi.Config(0.003, SHARE * PAPER_KV * 10.0, 12.0)
    assert lower(10.0, pi.Config(0.2, 0.0, 12.0)).ki == 0.0
    slow = pi.Config(0.02, 0.25, 12.0)
    assert lower(10.0, slow) is slow  # 0.75 of what 10 Hz bear
    none = pi.Config(0.0, 0.0, 12.0)
    assert lower(10.0, none) is none and lower(10.0, none, UNKNOWN) is none


def test_a_speed_shows_a_motor_that_is_quicker_than_gains_for_it() -> None:
    """Without a model: at 50 Hz the default gains are too large for a motor of 600 rad/s."""
    assert lower(50.0, faults=UNKNOWN, most=100.0) is GAINS
    assert lower(50.0, faults=UNKNOWN, most=400.0).ki == pytest.approx(GUESSED * 12.0 / 400.0 * 50.0)
    assert lower(50.0, faults=KNOWN, most=400.0) is GAINS  # the model knows


@given(
    st.floats(0.0, 1e3), st.floats(0.0, 1e4), st.floats(0.1, 90.0), st.floats(0.0, 10.0), st.floats(1e-6, 1e3),
    st.floats(0.0, 1e300),
)  # fmt: skip
def test_lower_gains_are_gains(kp: float, ki: float, rate: float, kv: float, lag: float, most: float) -> None:
    gains = pi.Config(kp, ki, 12.0)
    after = lower(rate, gains, FaultConfig(kv=kv, time_constant=lag), most)
    assert 0.0 <= after.kp <= kp and 0.0 <= after.ki <= ki


@pytest.mark.parametrize("rate", [20.0, 50.0, 200.0, 1000.0])
@pytest.mark.parametrize("source", [MEASURED, OBSERVER])
def test_what_tune_designs_for_a_rate_is_borne(rate: float, source: str) -> None:
    found = tuning(sample_period=1.0 / rate, source=source).gains
    gains = pi.Config(found.kp, found.ki, 12.0)
    assert lower(rate, gains) is gains
    assert warn_of_swing(gains, KNOWN, 1.0 / rate) == ""


@pytest.mark.parametrize(
    ("rate", "top", "lag", "warns"),
    [
        (100, 600.0, 0.05, True),  # 218 to 381 rad/s where 300 were asked for, and as those below nobody said it
        (200, 600.0, 0.05, True),
        (1000, 600.0, 0.05, False),  # 297 to 303
        (100, 300.0, 0.05, True),
        (200, 300.0, 0.05, False),  # 149 to 152 of 150
        (1000, 600.0, 0.01, True),
        (100, 30.0, 0.05, False),
        (50, 600.0, 0.05, False),  # there they are lowered
    ],
)
def test_default_gains_that_let_a_fast_motor_swing_are_said_with_its_model(
    rate: int, top: float, lag: float, warns: bool
) -> None:
    assert bool(warn_of_swing(GAINS, FaultConfig(kv=12.0 / top, time_constant=lag), 1.0 / rate)) is warns
    assert warn_of_swing(GAINS, UNKNOWN, 1.0 / rate) == "" == warn_of_swing(GAINS, KNOWN, 0.0)


def test_the_sentence_says_what_the_loop_works_with() -> None:
    said = explain_lowering(pi.Config(0.00554, 0.138, 12.0), KNOWN, 0.1)
    assert "Only 10 samples a second" in said and "0.0055 and 0.14" in said and "guessed" not in said
    assert explain_lowering(GAINS, UNKNOWN, 0.1).endswith("it is guessed how low they have to be.")


def swing(rate: float, top: float, model: bool, share: float) -> tuple[float, float, set[str], str]:
    """Speeds of the last two seconds of six, least and largest, as shares of what is asked for; what is said."""
    kv = 12.0 / top
    values = {"kv": kv, "ka": kv * TIME_CONSTANT, "ks": 0.4, "breakaway_voltage": 0.9, "stribeck_speed": 0.03 * top}
    motor = Parameters(values, ("static_friction",))
    board = BoardConfig(sample_rate=rate, slot_irregularity=0.01, seed=1, single_channel=True)
    plant, state, command, speeds, states = SimulatedBoard(motor, board), controller.State(), 0.0, [], set()
    gains = {"kp": 0.2 * kv / PAPER_KV, "ki": 2.5 * kv / PAPER_KV}
    with_model = {"speed_source": "observer", "feedforward": True} if model else {}
    config = config_of({**DEFAULTS, **gains, **with_model}, board.info(motor), motor if model else None)  # type: ignore[dict-item]
    for k in range(round(6.0 * rate)):
        sample = plant.sample(command)
        output, state = controller.update(config, state, sample, share * top if k == 0 else None, k / rate)
        command = output.terms.voltage
        states.add(output.state)
        speeds.append(plant.speed / (share * top))
    end = np.array(speeds[-round(2.0 * rate) :])
    return float(end.min()), float(end.max()), states, output.reason


@pytest.mark.parametrize("model", [False, True])
@pytest.mark.parametrize("top", TOPS)
@pytest.mark.parametrize("rate", [10.0, 20.0, 30.0, 50.0, 100.0])
def test_a_motor_holds_its_speed_at_any_rate(rate: float, top: float, model: bool) -> None:
    """At 10 Hz the default gains swung from 0 to 0.89 of the top speed, for ever; at 30 Hz by half the reference."""
    low, high, states, reason = swing(rate, top, model, 0.5)
    assert low > 0.92 and high < 1.08 and states == {"running"}
    assert ("the loop works with" in reason) == (rate < 42.0) and ("Only" in reason) == (rate < 100.0)
