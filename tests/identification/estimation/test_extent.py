"""How far recordings reach: no false edge and no single count is a speed, no ripple finer than disc and samples."""

from dataclasses import replace

import numpy as np
import pytest
from small import small_recording

from motor_identification.estimation.extent import TURNING_SPEED, measure_extent
from motor_model.effects import SPEC_BY_NAME
from motor_model.sample import Measurement


@pytest.mark.parametrize(
    ("edges", "rate", "cycles"), [(6, 200.0, 3.0), (2880, 200.0, 1), (0, 200.0, 1), (2880, 1e5, 1440.0)]
)
def test_a_ripple_is_as_fine_as_disc_and_samples_show(edges: int, rate: float, cycles: float) -> None:
    """Half a cycle a slot, and, where the motor turns slowly, half a cycle a stamp."""
    recording = small_recording()
    info = replace(recording.info, edges_per_revolution=edges, sample_period=1.0 / rate)
    extent = measure_extent([replace(recording, info=info)])
    expected = cycles if cycles != 1 else 2.0 * np.pi / (TURNING_SPEED * extent.speed / rate)
    assert extent.cycles == pytest.approx(expected)


def test_steady_states_are_as_quick_as_what_each_is_the_mean_over() -> None:
    """The box of what they do not show is next to nothing; beside a recording of motion it is that one's."""
    moving = small_recording()
    info = replace(moving.info, sample_period=20.0, speed_window=1.0, measurement=Measurement.SPEED)
    steady = replace(moving, info=info)
    alone, both = measure_extent([steady]), measure_extent([steady, moving])
    assert (alone.sample, alone.steady) == (1.0, True) and (both.sample, both.steady) == (moving.sample_period, False)
    (low, high), (least, most) = SPEC_BY_NAME["ka"].box(alone), SPEC_BY_NAME["ka"].box(both)
    assert low == pytest.approx(0.04 * alone.voltage / alone.speed) and high == pytest.approx(2.0 * low)
    assert most > 1e5 * least
    assert SPEC_BY_NAME["kv"].box(alone) == SPEC_BY_NAME["kv"].box(both)


@pytest.mark.parametrize("top", [3.0, 14.0, 30.0, 100.0, 500.0])
def test_the_largest_speed_is_no_single_count(top: float) -> None:
    """96 counts a turn, read every millisecond: a count is 65 rad/s, however slowly the motor turns."""
    speed = top * np.clip(np.sin(np.linspace(0.0, 6.0, 8000)) * 1.2, -1.0, 1.0)
    count = 2.0 * np.pi / 96
    seen = np.diff(np.floor(np.cumsum(speed * 1e-3) / count), prepend=0.0) * count / 1e-3
    recording = replace(small_recording().at_rows(np.zeros(8000, dtype=np.int64)), speed=seen)
    assert 0.9 * top < measure_extent([recording]).speed < 2.0 * top
    false = replace(recording, speed=np.where(np.arange(8000) == 4000, 1e5, seen))
    assert measure_extent([false]).speed < 2.0 * top or top < 65.0  # where no two samples in a row have a count


@pytest.mark.parametrize(("share", "believed"), [(0.02, False), (0.05, True)])
def test_bursts_of_false_speeds_move_the_box_only_so_far_that_it_holds_both(share: float, believed: bool) -> None:
    """What a filter makes of a potentiometer's gap: eight times the speed, over many rows, now and then."""
    row = np.arange(5000)
    speed = np.where(row % 1000 < 1000 * share, 320.0, 0.4 * (row % 100 + 1))
    recording = replace(small_recording().at_rows(np.zeros(5000, dtype=np.int64)), speed=speed)
    extent = measure_extent([recording])
    assert extent.speed == pytest.approx(320.0 if believed else 40.0)
    low, high = SPEC_BY_NAME["kv"].box(extent)
    assert low < extent.voltage / 320.0
    assert (high > extent.voltage / 40.0) is not believed
    wilder = measure_extent([replace(recording, speed=np.where(speed > 40.0, 4000.0, speed))])
    assert wilder.speed == pytest.approx(4000.0 if believed else 500.0)  # an eighth: kv is in the box if it was motion
