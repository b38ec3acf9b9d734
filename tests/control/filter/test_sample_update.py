"""A sample: its edges in order, its commands shifted, and the speed at which the next voltage acts."""

from math import nan

import numpy as np
import pytest
from filter_bench import NOISE, SLOT, held, vector

from motor_control.filter.load_jump import no_jumps
from motor_control.filter.packed_state import unpack_hypotheses
from motor_control.filter.sample_update import (
    Edge,
    predict_speed,
    shift_commands,
    start_filter,
    update_at_sample,
)

NO_EDGE = Edge(nan, 0.0, False)


def test_edges_of_a_steady_motor_find_its_speed() -> None:
    """60 rad/s from a start that says 40; two edges and a bit every 2.5 ms."""
    p, dt, voltage = vector(), 2.5e-3, 60.0 * vector()[0]
    memory, commands, angle = start_filter(vector(), NOISE, 40.0, 1.0, no_jumps()), held(voltage), 0.0
    for _ in range(40):
        first = int(angle / SLOT) + 1
        angle += 60.0 * dt
        edges = [Edge((k * SLOT - angle) / 60.0 + dt, 1.0, False) for k in range(first, int(angle / SLOT) + 1)]
        latest = (NO_EDGE, NO_EDGE, *edges)[-2:]
        if len(edges) > 2:
            latest = (latest[0]._replace(steps=len(edges) - 1.0), latest[1])
        update = update_at_sample(p, NOISE, memory, commands, dt, voltage, latest, 0.005)
        memory, commands = update.memory, update.commands
    assert update.ahead.mean == pytest.approx(60.0, abs=0.1) and 0.0 < update.ahead.sigma < 0.3
    assert update.load == pytest.approx(0.0, abs=0.1) and not update.stands
    assert unpack_hypotheses(memory).likely.elapsed == pytest.approx(0.1)


def test_commands_are_counted_from_the_new_sample() -> None:
    commands = shift_commands(shift_commands(held(1.0), 2.0, 0.005), 3.0, 0.005)
    assert commands.times.tolist() == [0.0, -0.005] and commands.voltages.tolist() == [3.0, 2.0]
    same = shift_commands(commands, 3.0, 0.005)
    assert same.times.tolist() == [-0.005, -0.01] and same.voltages.tolist() == [3.0, 2.0]


def test_what_is_ahead_is_what_the_voltage_does_until_then() -> None:
    memory = start_filter(vector(), NOISE, 0.0, 0.0, no_jumps())
    near, far = (predict_speed(vector(), NOISE, memory, held(12.0), lead) for lead in (0.001, 0.01))
    assert near.mean == pytest.approx(12.0 / 0.0055 * 0.001, rel=0.02)
    assert far.mean > 9.0 * near.mean and far.sigma > near.sigma
    assert np.isfinite(far.sigma)
