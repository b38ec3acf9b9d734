"""One sample that is repeated, while the loop asks for another voltage."""

from dataclasses import replace
from math import inf, nan

import pytest
from bench_board import drive, motor
from fault_bench import ENCODER, LIMIT

from motor_control.controller.faults import repetition
from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.motion import Motion
from motor_model.sample import Sample

SAME = Sample(0, 0.0, 3.0, 17, 9_000_000, 0.02)


def told(
    asked: float, sample: Sample = SAME, every: int = 0, period: float = 0.005, config: Config = ENCODER
) -> tuple[float, str]:
    """When [s] a sample is told to be repeated, which brings an edge `every` so many; and what is said."""
    state = repetition.State()
    for k in range(200):
        edges = sample.edge_count + (k // every if every else 0)
        look = Seen(replace(sample, edge_count=edges), 0.0, Motion(), 50.0, period, LIMIT, asked=asked)
        reason, state = repetition.check(config, state, look)
        if reason:
            return k * period, reason
    return inf, ""


@pytest.mark.parametrize("asked", [4.3, 1.7, -3.0, 0.0])
def test_a_repeated_sample_beside_another_voltage_is_told(asked: float) -> None:
    when, reason = told(asked)
    assert 0.15 < when < 0.18
    assert reason.startswith("The plant has repeated one sample on motor/speed for 0.17 s, with 3 V although")


def test_all_the_voltage_that_is_repeated_beside_less_is_told() -> None:
    """It is what a plant's own limit may leave of more, and of nothing else."""
    for voltage in (12.0, -12.0):
        for asked in (6.0, 0.0, -6.0):
            assert told(asked, replace(SAME, voltage=voltage))[0] < 0.18


@pytest.mark.parametrize(("period", "least", "most"), [(0.001, 0.15, 0.16), (0.1, 0.35, 0.55)])
def test_a_slow_plant_has_three_samples_more(period: float, least: float, most: float) -> None:
    assert least < told(6.0, period=period)[0] < most


@pytest.mark.parametrize(
    ("asked", "sample", "every"),
    [
        (4.1, SAME, 0),  # 0.09 of the limit from what was asked for: a sagging supply
        (nan, SAME, 0),  # nothing was
        (6.0, SAME, 32),  # an edge every 0.16 s
        (6.0, replace(SAME, voltage=0.0), 0),  # an output that is off, which ends the reference
        (12.0, replace(SAME, voltage=8.0, supply_voltage=8.4), 0),  # all that there is: a blocked shaft
    ],
)
def test_a_plant_that_stands_repeats_nothing(asked: float, sample: Sample, every: int) -> None:
    assert told(asked, sample, every) == (inf, "")


def test_the_check_is_off_without_a_stall_time_and_all_the_voltage_is_no_excuse_the_other_way() -> None:
    assert told(6.0, config=replace(ENCODER, stall_time=0.0)) == (inf, "")
    assert told(-12.0, replace(SAME, voltage=12.0))[0] < 0.2


@pytest.mark.parametrize("source", ["observer", "measured"])
def test_a_loop_at_3_percent_of_a_slow_motor_stops(source: str) -> None:
    """2.7 edges a second: the motor stood by what was repeated, and ran at its top speed for ever."""
    slow, told = motor(kv=2.0, ka=2.0 * 0.079, stribeck_speed=0.2), [SAME]

    def repeat(sample: Sample) -> Sample:
        if len(told) < 300 or not (told[-1] is told[-2] or 0.5 < sample.voltage < 3.0):
            told.append(sample)
        else:
            told.append(told[-1])
        return replace(told[-1], sample_time=sample.sample_time)

    run = drive(slow, 0.18, 4.0, model=slow, speed_source=source, kp=6.0, ki=76.0, line=repeat)
    begin = next(k for k in range(1, len(told) - 1) if told[k] is told[k + 1])
    stop = next(k for k, output in enumerate(run.outputs) if output.fault)
    assert 0.15 < run.time[stop] - run.time[begin] < 0.5 and run.speed[stop:].max() < 3.0
    assert "repeated one sample" in run.outputs[stop].fault and run.outputs[-1].terms.voltage == 0.0
