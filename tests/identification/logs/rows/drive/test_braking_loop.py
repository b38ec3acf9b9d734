"""A loop that holds a shaft, and a motor with exchanged wires: both go against the voltage."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.rows.drive.braking_loop import brakes
from motor_identification.logs.rows.swapped_sign import turn_round
from motor_identification.logs.signals import Signals

COUNT = 1000


def held(seed: int, rows: int = COUNT) -> Signals:
    """A shaft under random torques that a loop of speed and position holds, by what a coarse encoder shows of it."""
    random = np.random.default_rng(seed)
    speed, voltage, torque, position = np.zeros(rows), np.zeros(rows), 0.0, 0.0
    for k in range(rows):
        position += np.rint(speed[k])
        voltage[k] = -0.05 * np.rint(speed[k]) - 0.002 * position
        torque = 0.9 * torque + 0.5 * random.standard_normal()
        if k + 1 < rows:
            speed[k + 1] = 0.9 * speed[k] + 2.0 * (voltage[k] + torque)
    return made(voltage, np.rint(speed))


def driven(voltage: np.ndarray, slow: float, before: bool = False) -> Signals:
    """A motor with exchanged wires; `before`: a voltage held until its row."""
    random, speed = np.random.default_rng(1), np.zeros(len(voltage))
    held_voltage = voltage if before else np.append(0.0, voltage[:-1])
    for k in range(1, len(voltage)):
        speed[k] = slow * speed[k - 1] + (1.0 - slow) * 20.0 * held_voltage[k]
    return made(voltage, -np.rint(speed + random.standard_normal(len(voltage))))


def made(voltage: np.ndarray, motion: np.ndarray) -> Signals:
    rows, unknown = len(voltage), np.full(len(voltage), np.nan)
    time = np.arange(rows) * 10_000_000
    runs = {"1": slice(0, rows // 2), "2": slice(rows // 2, rows)}
    return Signals(Path("log.csv"), np.arange(rows), time, voltage, motion, unknown, unknown, runs)


def test_a_shaft_that_a_loop_holds_is_not_turned_round() -> None:
    """Its speeds go against the voltage, which brakes them: the sign was turned, and kv was 233 % off."""
    against = 0
    for seed in range(20):
        given = held(seed)
        against += float(np.sum(given.voltage * given.motion)) < -0.5 * float(
            np.sum(np.abs(given.voltage * given.motion))
        )
        assert brakes(given) and turn_round(given, True)[1] == []
    assert against > 15


def test_a_loop_whose_speed_is_logged_the_other_way_round_brakes_nothing() -> None:
    given = held(3)
    assert not brakes(replace(given, motion=-given.motion))


@pytest.mark.parametrize("slow", [0.1, 0.9])
@pytest.mark.parametrize("before", [False, True])
@pytest.mark.parametrize("kind", ["steps", "sine", "ramp", "levels"])
def test_a_motor_with_exchanged_wires_is_no_loop(kind: str, before: bool, slow: float) -> None:
    k = np.arange(COUNT)
    voltage = {
        "steps": 6.0 * (-1.0) ** (k // 100),
        "sine": np.round(6.0 * np.sin(k / 40.0), 2),
        "ramp": np.round(6.0 * np.abs((k % 400) / 100.0 - 2.0) - 6.0, 2),
        "levels": np.repeat(np.random.default_rng(2).uniform(-6.0, 6.0, COUNT // 10), 10),
    }[kind]
    given = driven(voltage, slow, before)
    assert not brakes(given)
    assert turn_round(given, True)[1] or kind == "levels"  # of which a slow motor goes against too few


def test_rows_far_apart_tell_of_no_loop() -> None:
    """Each speed is that of its own voltage there, as if the voltage answered it."""
    voltage = np.random.default_rng(2).uniform(-6.0, 6.0, COUNT)
    given = driven(voltage, 0.0, before=True)
    assert not brakes(given) and turn_round(given, True)[1]


@pytest.mark.parametrize(("rows", "found"), [(8, False), (400, True)])
def test_runs_of_a_few_rows_tell_nothing(rows: int, found: bool) -> None:
    assert brakes(held(1, rows)) is found
