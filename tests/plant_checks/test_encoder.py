"""The disc and its edges: exact times, the two flanks of a hole, irregularity, eccentricity, missed edges."""

import numpy as np
import pytest
from numpy.typing import NDArray
from plant import record
from plant.encoder import Disc, edges_of
from plant.motor import move

from motor_model.errors import ModelError

KV, KA = 12 / 174.097, 0.0055
BASE = {"kv": KV, "ka": KA}
FREE = {"kv": 0.0, "ka": KA}  # nothing brakes it
Floats = NDArray[np.float64]
TIMES: Floats = np.arange(0.0, 1.0001, 0.005, dtype=np.float64)
PITCH = 2.0 * np.pi / 96
START = 0.0123


@pytest.mark.parametrize("speed", [100.0, -100.0, 3.3, 700.0])
def test_edges_of_constant_speed_come_when_the_flanks_do(speed: float) -> None:
    recording, truth = record(FREE, TIMES, 0.0 * TIMES, start_speed=speed, start_angle=START)
    if speed > 0:
        times = (np.arange(1, 20000) * PITCH - START) / speed  # hole k begins at k
    else:
        times = (np.arange(0, -20000, -1) * PITCH - 0.5 * PITCH - START) / speed  # hole k ends at k + 1/2
    times = times[times <= 1.0]
    assert np.abs(truth.edge_time - times).max() < 1e-11  # what 100,000 roundings add up to
    assert np.all(truth.edge_direction == np.sign(speed))
    stamps = np.floor((1.0 + times) / 4e-6).astype(np.int64) * 4000
    reported = truth.latest_edge >= 0
    assert np.array_equal(recording.edge_time[reported], stamps[truth.latest_edge[reported]])
    assert np.array_equal(recording.edge_count, truth.latest_edge + 1)
    assert recording.edge_count[-1] == len(times)


def test_edges_of_constant_acceleration_are_exact() -> None:
    truth = record(FREE, TIMES, np.full_like(TIMES, 5.0), start_angle=START)[1]
    angles = np.arange(1, len(truth.edge_time) + 1) * PITCH - START
    assert len(angles) > 5000
    assert np.abs(truth.edge_time - np.sqrt(2.0 * angles * KA / 5.0)).max() < 1e-12
    assert np.abs(truth.edge_angle - angles).max() < 1e-12
    assert np.abs(truth.edge_speed - np.sqrt(2.0 * angles * 5.0 / KA)).max() < 1e-7


def test_a_reversal_sees_the_other_flank() -> None:
    volts = np.where(TIMES < 0.3, 2.0, -2.0)
    truth = record(FREE, TIMES, volts, start_angle=START)[1]
    forward = truth.edge_direction > 0
    assert np.count_nonzero(np.diff(truth.edge_direction)) == 1
    assert truth.reversal_time == pytest.approx([0.6], abs=1e-12)
    assert np.all(forward == (truth.edge_time < 0.6))
    place = (truth.edge_angle + START) / PITCH % 1.0
    assert np.abs(place[~forward] - 0.5).max() < 1e-9
    assert np.abs(np.minimum(place[forward], 1.0 - place[forward])).max() < 1e-9
    last, first = (truth.edge_angle[forward][-1] + START) / PITCH, (truth.edge_angle[~forward][0] + START) / PITCH
    assert abs(last - first) == pytest.approx(0.5, abs=1e-9)


def test_rocking_over_a_flank_makes_an_edge_a_forward_pass() -> None:
    period = np.arange(len(TIMES)) // 5 % 4  # accelerate, brake, back, brake: returns to where it began
    volts = np.where((period == 0) | (period == 3), 0.2, -0.2)
    truth = record(FREE, TIMES, volts, start_angle=-0.25 * PITCH)[1]
    swing = 0.2 / KA * 0.025**2 / PITCH
    assert 0.25 < swing < 0.74  # over flank 0 and back, never to where hole -1 ends
    assert len(truth.edge_time) == 10 and np.all(truth.edge_direction == 1) and np.all(truth.edge_flank == 0)


def test_two_channels_count_down_backward_and_know_the_sign() -> None:
    volts = np.where(TIMES < 0.3, 5.0, -5.0)
    recording, truth = record(BASE, TIMES, volts, start_angle=START, single_channel=False)
    assert recording.edge_count.max() == np.count_nonzero(truth.edge_direction > 0)
    assert recording.edge_count[-1] == truth.edge_direction[truth.edge_time <= 1.0].sum() < 0
    off = recording.edge_count - (truth.angle + START) / PITCH
    assert np.ptp(off) < 1.5 and np.abs(off).max() < 1.5  # a slot, and half a slot between the two flanks
    moving = recording.speed != 0.0
    assert np.count_nonzero(moving) > 190
    assert np.array_equal(np.sign(recording.speed[moving]), truth.edge_direction[truth.latest_edge[moving]])
    assert not recording.info.single_channel


def test_eccentric_disc_shows_its_own_angle() -> None:
    eccentricity, phase, speed = 0.03, 0.7, 50.0
    wobbly = FREE | {"eccentricity": eccentricity, "eccentricity_phase": phase}
    truth = record(wobbly, TIMES, 0.0 * TIMES, start_speed=speed, start_angle=START)[1]
    angle = speed * truth.edge_time
    shown = (angle + eccentricity * np.sin(angle + phase) + START) / PITCH
    first = np.ceil((eccentricity * np.sin(phase) + START) / PITCH)
    assert np.abs(shown - np.arange(first, first + len(shown))).max() < 1e-8
    periods = np.diff(truth.edge_time) * speed / PITCH
    assert periods.max() == pytest.approx(1.0 / (1.0 - eccentricity), rel=1e-3)
    assert periods.min() == pytest.approx(1.0 / (1.0 + eccentricity), rel=1e-3)


def test_irregular_flanks_repeat_every_turn_and_differ_between_directions() -> None:
    def off(speed: float, disc_seed: int = 0) -> NDArray[np.float64]:
        truth = record(FREE, TIMES, 0.0 * TIMES, start_speed=speed, irregularity=0.01, disc_seed=disc_seed)[1]
        place = (speed * truth.edge_time + truth.start_angle) / PITCH - truth.edge_flank - (0.5 if speed < 0 else 0.0)
        turns = np.array([place[truth.edge_flank % 96 == hole][:3] for hole in range(96)])
        assert np.ptp(turns, axis=1).max() < 1e-9
        return np.asarray(turns[:, 0])

    forward, backward, other = off(60.0), off(-60.0), off(60.0, disc_seed=1)
    for flanks in (forward, backward, other):
        assert 0.008 < flanks.std() < 0.012
        assert abs(flanks.mean()) < 1e-9
    assert abs(np.corrcoef(forward, backward)[0, 1]) < 0.35
    assert abs(np.corrcoef(forward, other)[0, 1]) < 0.35
    assert np.abs(forward - off(60.0)).max() < 1e-9


def test_edges_are_missed_at_their_rate_and_leave_whole_slots() -> None:
    rate, speed = 0.02, 400.0
    parameters = FREE | {"miss_rate": rate}
    recording, truth = record(parameters, TIMES, 0.0 * TIMES, start_speed=speed, seed=4)
    total = len(truth.edge_time) + len(truth.missed_time)
    assert total == pytest.approx(speed / PITCH, abs=1.0)
    assert abs(len(truth.missed_time) - rate * total) < 4.0 * np.sqrt(rate * total)
    slots = np.diff(truth.edge_time) * speed / PITCH
    assert np.abs(slots - np.round(slots)).max() < 1e-9
    assert set(np.round(slots)) >= {1.0, 2.0}
    assert recording.edge_count[-1] == len(truth.edge_time)
    again = record(parameters, TIMES, 0.0 * TIMES, start_speed=speed, seed=4)[1]
    other = record(parameters, TIMES, 0.0 * TIMES, start_speed=speed, seed=5)[1]
    assert np.array_equal(again.missed_time, truth.missed_time)
    assert len(other.missed_time) != len(truth.missed_time) or not np.allclose(other.missed_time, truth.missed_time)


def test_edges_do_not_depend_on_how_densely_the_motion_is_given() -> None:
    volts = np.where(TIMES < 0.5, 9.0, -9.0)
    coarse, fine = (
        edges_of(move(BASE | {"ks": 0.5}, TIMES, volts, step=step), Disc.cut(), start_angle=START)
        for step in (2e-5, 2e-6)
    )
    assert np.array_equal(coarse.flank, fine.flank)
    assert np.abs(coarse.time - fine.time).max() < 1e-11


def test_a_disc_that_cannot_be_is_refused() -> None:
    with pytest.raises(ModelError, match="irregularity"):
        Disc.cut(96, 0.2)
