"""The angle is counted within a run, and bridged by a model between two."""

import numpy as np
import pytest

from motor_identification.measurement.edit_intervals import append_standstills
from motor_identification.measurement.intervals import Intervals, index_intervals
from motor_identification.measurement.measured_angle import Track, find_row_step, make_track

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


@pytest.mark.parametrize("both_ways", [True, False])
def test_what_is_counted_both_ways_is_known_beyond_a_gap(both_ways: bool) -> None:
    """Whatever the model turned there; one way only, the model has its say."""
    place = np.array([[0.0, 0.1], [0.75, 0.85]])
    data = index_intervals(
        np.array([0.0, 0.5]), np.array([0.1, 0.6]), np.ones(2), np.zeros(2), place=place if both_ways else None
    )
    track = make_track(data, np.interp(data.time, [0.1, 0.5], [0.1, 5.1]))
    assert data.counts_both_ways is both_ways
    assert track.at(np.array([0.5, 0.6])) == pytest.approx([0.75, 0.85] if both_ways else [5.1, 5.2])


@pytest.mark.parametrize(("rows", "carried"), [(1.4, True), (1.6, False)])
def test_from_one_rows_speed_to_the_next_rows_the_shaft_turns_by_their_mean(rows: float, carried: bool) -> None:
    """Speeds of an instant: windows of a tenth of a row, and one row that is late."""
    begin = np.array([0.0, 1.0, 2.0, 3.0, 3.0 + rows, 4.0 + rows])
    speed = np.array([1.0, 2.0, 2.0, 2.0, 4.0, 4.0])
    data = index_intervals(begin, begin + 0.1, speed, np.full(6, 0.01), independent=True, window=0.1)
    assert find_row_step(data) == pytest.approx(1.4)
    track = make_track(data, 100.0 * data.time)
    assert track.at(np.array([1.0])) == pytest.approx([0.1 + 0.9 * 1.5])
    late = track.at(begin[4:5]) - track.at(np.array([3.1]))
    assert late == pytest.approx([3.0 * (rows - 0.1) if carried else 100.0 * (rows - 0.1)])
    assert len(set(track.run)) == (1 if carried else 2)
    assert find_row_step(counted([0.0, 0.1, 0.2], 1.0)) == 0.0


def test_a_track_is_filled_in_from_where_it_ends() -> None:
    """What another one measured in between is added to what it knows; its own angles stay, and nothing jumps."""
    own = Track(np.array([0.0, 1.0, 5.0, 6.0]), np.array([0.0, 1.0, 7.0, 8.0]), np.array([0, 0, 1, 1]))
    whole = Track(np.arange(8.0), np.array([0.0, 1.0, 2.0, 2.5, 3.0, 5.0, 6.0, 6.5]), np.zeros(8, dtype=np.int64))
    filled = own.fill_in(whole)
    assert filled.time.tolist() == whole.time.tolist()
    assert filled.angle == pytest.approx([0.0, 1.0, 2.5, 3.5, 4.5, 7.0, 8.0, 8.5])
    assert filled.run.tolist() == [0, 0, 0, 0, 0, 1, 1, 1]
