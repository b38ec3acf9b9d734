"""A mean command moves a motor as those of its rows do; where they differ by much, each stays."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from plant import profiles, record

from motor_identification.estimation.joined_commands import MOST_LACKING, join_commands
from motor_identification.recording import Recording, check
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_model.simulate import simulate

ROWS = 8
MOTOR = Parameters({"kv": PAPER_KV, "ka": 3.0 * PAPER_KA, "ks": 0.3}, ("coulomb_friction",))


@cache
def stepped(noise: float) -> Recording:
    """Steps at 1,000 rows a second, up to 10 of 12 V, beside noise [V]."""
    recording = check(record(MOTOR.values, *profiles.staircase(10.0, 6, 0.5), sample_rate=1000.0)[0])
    beside = noise * np.random.default_rng(3).standard_normal(len(recording))
    return replace(recording, voltage=recording.voltage + beside)


def test_commands_that_stay_are_one_each() -> None:
    recording = stepped(0.0)
    time, voltage = join_commands(recording, ROWS)
    changes = np.flatnonzero(np.diff(recording.voltage, prepend=np.nan) != 0.0)
    assert np.array_equal(time, recording.time[changes]) and np.array_equal(voltage, recording.voltage[changes])


def test_the_mean_of_many_moves_a_motor_as_they_do() -> None:
    recording = stepped(0.03)
    time, voltage = join_commands(recording, ROWS)
    assert len(time) < 0.25 * len(recording)
    ends = recording.time[::ROWS]
    each, joined = (
        np.diff(simulate(MOTOR, *command, ends).angle) / np.diff(ends)
        for command in ((recording.time, recording.voltage), (time, voltage))
    )
    top = np.abs(each).max()
    off = float(np.sqrt(np.mean((joined - each) ** 2)))
    assert 1e-7 * top < off < 2e-5 * top


@pytest.mark.parametrize(("size", "joined"), [(0.5, True), (4.0, False)])
def test_a_step_stays_where_it_is_unless_it_is_a_small_one(size: float, joined: bool) -> None:
    """Of so many hundredths of the largest voltage, in the middle of rows that differ by next to nothing."""
    recording, row = stepped(0.0), 100 * ROWS + 3
    step = size * MOST_LACKING * float(np.abs(recording.voltage).max())
    rows = np.arange(len(recording))
    voltage = np.where(rows < row, 6.0, 6.0 - step) + 1e-6 * (-1.0) ** rows
    voltage[-1] = recording.voltage.max()
    times, _volts = join_commands(replace(recording, voltage=voltage), ROWS)
    assert len(times) < 0.2 * len(recording)
    assert (recording.time[row] not in times) is joined


def test_they_are_joined_once() -> None:
    recording = stepped(0.03)
    assert join_commands(recording, 4)[0] is join_commands(recording, 4)[0]
    assert len(join_commands(recording, 4)[0]) > len(join_commands(recording, ROWS)[0])
