"""What `tune` predicts of a loop with the observer is what that loop does in simulation, held from both sides."""

from collections import deque
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from tiers import keep_fast

from motor_control.configuration import config_of
from motor_control.controller import controller
from motor_control.parameters import ROWS
from motor_control.tuning.design import Tuning, Wish, tune
from motor_control.tuning.linear_loop import plant_of
from motor_control.tuning.margins import Margins, margins_of
from motor_control.tuning.simulated_loop import rehearse
from motor_control.tuning.speed_feedback import OBSERVER, Encoder
from motor_model.errors import MotorError
from motor_model.parameters import paper_motor
from motor_model.sample import Sample
from motor_model.sensing.board import BoardConfig, SimulatedBoard
from motor_ros.parameters import Value

MOTOR = paper_motor()
Floats = np.ndarray[tuple[int], np.dtype[np.float64]]


@cache
def tuned(rate: float) -> Tuning:
    return tune(MOTOR, Encoder(), Wish(1.0 / rate, 10.0, source=OBSERVER))


def config(board: BoardConfig, tuning: Tuning) -> controller.Config:
    values: dict[str, Value] = {row.name: row.default for row in ROWS}
    values |= {"kp": tuning.gains.kp, "ki": tuning.gains.ki, "speed_source": OBSERVER, "feedforward": True}
    return config_of({**values, "stall_time": 0.0}, board.info(MOTOR), MOTOR)


def margins(tuning: Tuning, speed: float) -> Margins:
    bare = plant_of(MOTOR, tuning.wish.sample_period)
    return margins_of(tuning.sight.loop(bare, tuning.gains, speed), bare.sample_period, bare.late)


def swing_after_a_nudge(rate: float, speed: float, late: int = 0, factor: float = 1.0) -> float:
    """[rad/s] in the last 0.4 s of 3: from 1 s on voltages come `late` samples later, their deviations by `factor`.

    The observer is not told. At 1.1 s the reference is 0.2 rad/s higher for a tenth of a second.
    """
    tuning = tuned(rate)
    description = BoardConfig(sample_rate=rate, single_channel=False, seed=1)
    board, state, law = SimulatedBoard(MOTOR, description), controller.State(), config(description, tuning)
    asked, needed = deque([0.0] * (late + 1), late + 1), MOTOR.value("kv") * speed
    speeds = []
    for k in range(round(3.0 * rate)):
        time = k / rate
        voltage = needed + factor * (asked[0] - needed) if time > 1.0 else asked[-1]
        sample: Sample = replace(board.sample(voltage), voltage=asked[-1])
        reference = speed + (0.2 if 1.1 < time < 1.2 else 0.0)
        output, state = controller.update(law, state, sample, reference, time)
        asked.append(output.terms.voltage)
        speeds.append(board.speed)
    return float(np.ptp(speeds[-round(0.4 * rate) :]))


@pytest.mark.slow
@pytest.mark.parametrize("speed", [30.0, 100.0])
def test_delay_margin(speed: float) -> None:
    margin = margins(tuned(1000.0), speed).delay * 1000.0  # [sample]
    assert 10.0 < margin < 16.0
    assert swing_after_a_nudge(1000.0, speed, late=int(margin)) < 0.2
    assert swing_after_a_nudge(1000.0, speed, late=int(margin) + 2) > 5.0


@pytest.mark.parametrize("speed", keep_fast([30.0, 100.0], 100.0))
def test_gain_margin(speed: float) -> None:
    margin = margins(tuned(200.0), speed).gain
    assert 2.3 < margin < 3.0
    assert swing_after_a_nudge(200.0, speed, factor=0.8 * margin) < 0.2
    assert swing_after_a_nudge(200.0, speed, factor=1.05 * margin) > 5.0


@pytest.mark.parametrize(
    ("rate", "speed"),
    keep_fast([(200.0, 3.0), (200.0, 10.0), (200.0, 30.0), (1000.0, 10.0)], (200.0, 3.0), (200.0, 30.0)),
)
def test_the_disc_makes_the_shaft_swing_as_predicted(rate: float, speed: float) -> None:
    tuning = tuned(rate)
    swing = tuning.sight.ripple(plant_of(MOTOR, 1.0 / rate), tuning.gains, speed)
    seen = []
    for seed in range(3):
        board = BoardConfig(sample_rate=rate, slot_irregularity=0.01, seed=seed)
        run = rehearse(MOTOR, board, config(board, tuning), lambda _: speed, 2.0)
        seen += [np.ptp(run.speed[round(t * rate) : round((t + 0.5) * rate)]) / speed for t in (1.0, 1.5)]
    assert 0.65 < np.median(seen) / swing.speed < 1.35


@pytest.mark.parametrize("rate", [200.0, 1000.0])
def test_the_predicted_step_is_the_step(rate: float) -> None:
    tuning = tuned(rate)
    step, board = tuning.large_step, BoardConfig(sample_rate=rate)
    run = rehearse(MOTOR, board, config(board, tuning), lambda _: step.reference, float(step.time[-1]))
    predicted = np.interp(run.time, step.time, step.speed)
    assert np.abs(run.speed - predicted).max() < 0.01 * step.reference
    assert step.overshoot < 0.001 and run.speed.max() < 1.005 * step.reference


def test_the_bound_is_the_phase_margin_or_the_delay() -> None:
    slow, fast = tuned(200.0), tuned(1000.0)
    assert slow.margins.phase == pytest.approx(45.0, abs=0.5) and slow.margins.gain > 2.0
    assert fast.margins.phase > 45.0 and fast.gains.kp == pytest.approx(MOTOR.value("ka") / 0.003, rel=1e-6)
    assert 0.018 < slow.time_constant < 0.022 and 0.003 < fast.time_constant < 0.004
    plain = tune(MOTOR, Encoder(), Wish(0.005, 10.0))
    assert 1.4 < plain.time_constant / slow.time_constant < 2.0
    assert slow.ripples[-1][1].speed < 0.03 * plain.ripples[-1][1].speed


def test_refusals() -> None:
    with pytest.raises(MotorError, match="needs its own margins: ask for 19.9 ms or more, or sample"):
        tune(MOTOR, Encoder(), Wish(0.005, 10.0, 0.015, source=OBSERVER))
    with pytest.raises(MotorError, match="1 s is too long for this law: ask for 0.08"):
        tune(MOTOR, Encoder(), Wish(0.005, 10.0, 1.0, source=OBSERVER))
    wished = tune(MOTOR, Encoder(), Wish(0.005, 10.0, 0.03, source=OBSERVER))
    assert wished.time_constant == pytest.approx(0.03, rel=1e-3)
