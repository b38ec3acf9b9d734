"""The angle is counted within a run, and bridged by a model between two."""

import numpy as np
import pytest

from motor_identification.measurement.intervals import Intervals, append_standstills, index_intervals
from motor_identification.measurement.measured_angle import make_track

SLOT = 0.1  # [rad]


def counted(bounds: list[float], speed: float, edge: int = 0) -> Intervals:
    """Successive intervals of one slot each."""
    start, end = np.array(bounds[:-1]), np.array(bounds[1:])
    numbers = np.column_stack([edge + np.arange(len(start)), edge + 1 + np.arange(len(start))])
    return index_intervals(start, end, np.full(len(start), speed), np.zeros(len(start)), edge=numbers, slot=SLOT)


def test_within_a_run_the_model_has_no_say() -> None:
    data = counted([0.0, 0.1, 0.2, 0.3], 1.0)
    for wrong in (0.5, 1.0, 2.0):
        track = make_track(data, wrong * data.time)
        assert track.angle == pytest.approx([0.0, 0.1, 0.2, 0.3]) and not np.any(track.run)
        assert track.at(np.array([0.05, 0.25])) == pytest.approx([0.05, 0.25])


@pytest.mark.parametrize(("bridge", "taken"), [(0.15, 0.15), (0.35, 0.3), (-0.4, -0.3)])
def test_a_gap_is_the_models_but_for_the_edges_in_it(bridge: float, taken: float) -> None:
    """Two edges are missing between the runs: three slots at most, counting one to either flank."""
    one, other = counted([0.0, 0.1], 1.0), counted([0.5, 0.6], 1.0, edge=3)
    data = index_intervals(
        np.append(one.time[one.first], other.time[other.first]),
        np.append(one.time[one.last], other.time[other.last]),
        np.ones(2),
        np.zeros(2),
        edge=np.vstack([one.edge, other.edge]),
        slot=SLOT,
    )
    angle = np.interp(data.time, [0.0, 0.1, 0.5, 0.6], [0.0, 0.1, 0.1 + bridge, 0.2 + bridge])
    track = make_track(data, angle)
    assert track.at(np.array([0.5, 0.6])) == pytest.approx([0.1 + taken, 0.2 + taken])
    assert track.run_at(np.array([0.05, 0.55])).tolist() == [0, 1]


@pytest.mark.parametrize("simulated", [0.04, 0.4])
def test_at_a_standstill_it_moves_less_than_a_slot(simulated: float) -> None:
    data = append_standstills(counted([0.0, 0.1], 1.0), (np.array([0.1]), np.array([0.5])), SLOT)
    angle = np.interp(data.time, [0.0, 0.1, 0.5], [0.0, 0.1, 0.1 + simulated])
    assert make_track(data, angle).angle[-1] == pytest.approx(0.1 + min(simulated, SLOT))


def test_slips_move_whole_runs() -> None:
    data = append_standstills(counted([0.0, 0.1, 0.2], 1.0), (np.array([0.2]), np.array([0.5])), SLOT)
    track = make_track(data, data.time)
    slipped = track.slipped(np.array([0.0, 2 * SLOT]))
    assert slipped.angle - track.angle == pytest.approx(np.where(track.run == 0, 0.0, 2 * SLOT))
    assert set(track.run) == {0, 1}
