"""Pulses against the motion."""

from dataclasses import replace
from math import inf, tau

import pytest
from bench_board import DEFAULTS
from fault_bench import ENCODER, Row, feed, turning

from motor_control.configuration import config_of
from motor_control.controller import controller
from motor_model.parameters import Parameters
from motor_model.sensing.board import BoardConfig, SimulatedBoard

TWO = replace(ENCODER, two_channels=True)


def push(gain: float, voltage: float = 12.0, period: int = 20) -> list[Row]:
    """Coast backward to 60 rad/s, and be pushed for 10 ms: to so many times that speed."""
    coasting = [turning(-60.0 - (period - k), 0.0) for k in range(period)]
    return [*coasting, turning(-60.0, voltage), turning(-60.0 * gain**0.5, voltage), turning(-60.0 * gain, 0.0)]


def test_pulses_that_drive_the_motor_the_other_way_are_a_wrong_direction() -> None:
    """600 rad/s, 2,880 edges, no model: 10 ms of full voltage from every standstill, at 13 % of top speed for ever."""
    reason, when = feed(push(4.0) * 10, TWO)
    assert "3 pulses against the motion, of 12 V, made it faster, to 240 rad/s" in reason
    assert when == pytest.approx((3 * 23 - 1) * 0.005)  # with the sample that ends the third
    assert feed((push(4.0) + push(1.0)) * 3, TWO)[0]  # pulses that do nothing are none
    assert (
        feed([turning(-90.0, 0.0), *[turning(-w, 12.0) for w in (90.0, 60.0)], turning(-62.0, 0.0)] * 9, TWO)[0] == ""
    )
    few = [(-3.0, 12.0, 0.0), (-3.0, 12.0, 0.0), (-3.0, 0.0, 0.0), *[turning(-12.0, 0.0)] * 3, turning(-3.0, 0.0)]
    assert feed(few * 3, TWO)[1] < 0.1  # its edges come when it has ended


@pytest.mark.parametrize(
    "rows",
    [
        push(4.0) * 2,  # may be hits
        push(1.4) * 10,  # slots are irregular, and a load may still win
        push(4.0, voltage=5.9) * 10,  # a loop answers a load that drives the motor
        push(0.5) * 10,
        (push(4.0) * 2 + push(0.5)) * 5,
        push(4.0)[:1] * 9 + (push(4.0) + push(0.89)) * 10,
        (push(4.0) * 2 + [turning(0.5, 12.0)]) * 5,  # it turns as it is told
        (push(4.0) * 2 + [turning(0.5, 0.0)]) * 5,
        (push(4.0) + [turning(-9.0, -12.0)]) * 10,
    ],
    ids=["two", "little", "weak", "slower", "slower once", "little slower", "along", "along by itself", "both ways"],
)
def test_other_pulses_are_not(rows: list[Row]) -> None:
    assert feed(rows, TWO) == ("", inf)


@pytest.mark.parametrize(("tick", "told"), [(4e-6, False), (1e-7, True)])
def test_a_period_of_a_tick_less_is_no_faster_motion(tick: float, told: bool) -> None:
    """3,619 edges a turn at 200 rad/s and 1 kHz (seed 2000294): 145 and 217 rad/s in turn, under braking."""
    fine = replace(TWO, slot=tau / 3619, tick=tick)
    slow, fast = (fine.slot / (k * 4e-6) for k in (3, 2))
    rows = [turning(-slow, 0.0), turning(-slow, 7.0), turning(-fast, 7.0), turning(-slow, 0.0)]
    assert bool(feed(rows * 5, fine)[0]) is told


def test_one_channel_does_not_measure_the_direction() -> None:
    assert feed(push(4.0) * 10, ENCODER) == ("", inf)
    assert feed(push(4.0) * 10, replace(TWO, stall_time=0.0)) == ("", inf)


def test_channels_exchanged_from_the_start_stop_a_loop_without_a_model() -> None:
    """600 rad/s, 960 edges: the loop pushed this motor in pulses, at up to 11 % of its top speed, for ever."""
    plant = Parameters({"kv": 0.08, "ka": 0.0064, "ks": 1.6}, ("coulomb_friction",), max_voltage=48.0)
    encoder = BoardConfig(sample_rate=200.0, edges_per_revolution=960, single_channel=False)
    loop = {"kp": 0.23, "ki": 2.9, "voltage_limit": 48.0}
    config, board = config_of({**DEFAULTS, **loop}, encoder.info(plant)), SimulatedBoard(plant, encoder)
    state, voltage, asked = controller.State(), 0.0, []
    for k in range(200):
        sample = board.sample(voltage)
        swapped = replace(sample, speed=-sample.speed, edge_count=-sample.edge_count)
        output, state = controller.update(config, state, swapped, 90.0 if k == 0 else None, 0.005 * k)
        voltage = output.terms.voltage
        asked.append(voltage)
    assert "3 pulses against the motion" in state.latched
    assert any(asked[20:45]) and not any(asked[80:])
