"""The worst regions: disjoint, where the excess error is, and chosen by their contrast."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosed import held

from motor_identification.discrepancy.region_text import describe_error, describe_region
from motor_identification.discrepancy.worst_regions import (
    MOMENT,
    choose_thresholds,
    find_worst_regions,
    measure_contrast,
)
from motor_identification.measurement.intervals import index_intervals

SHARE = 0.003  # of a slot: what the disc of `diagnosed` has
FRICTION = {"ks": 0.4}


def test_the_worst_regions_do_not_overlap() -> None:
    one = held(**FRICTION)
    regions = find_worst_regions(one, SHARE)
    assert 1 <= len(regions) <= 3 and f"largest error {describe_region(regions[0])}" == describe_error(one, SHARE)
    assert np.max(np.sum([region.inside for region in regions], axis=0)) == 1
    assert sum(region.excess for region in regions) <= 1.0 + 1e-9
    for region in regions:
        assert region.time == pytest.approx(one.weight[region.inside].sum())
    assert regions[0].excess > regions[-1].excess or len(regions) == 1


def test_contrast_prefers_much_in_little() -> None:
    much = measure_contrast(np.array([0.9, 0.9, 0.3, 0.5, 0.2]), np.array([0.1, 0.5, 0.1, 0.5, 0.4]))
    assert much[0] > much[1] > 0.0 and much[0] > much[2] > 0.0
    assert much[3] == pytest.approx(0.0) and much[4] == 0.0
    assert choose_thresholds(np.array([0.0, 123.4]))[0] == 1.2 and choose_thresholds(np.zeros(2)) == []


def test_a_motor_that_is_measured_to_stand_is_simulated_too_fast_and_not_one_way_too_slow() -> None:
    one = held()
    (data,) = one.intervals
    still = replace(data, speed=np.zeros_like(data.speed), slack=np.zeros_like(data.slack))
    runs = replace(one, intervals=(still,))
    (region,) = find_worst_regions(runs, SHARE, 1)
    errors, weight = np.abs(runs.residuals[region.inside]), runs.weight[region.inside]
    assert region.bias == pytest.approx(np.average(errors, weights=weight)) and region.bias > 10.0
    assert "too fast" in describe_region(region) and "too slow" not in describe_region(region)


@pytest.mark.parametrize(("values", "named"), [(1, False), (2, False), (3, True)])
def test_a_value_or_two_in_a_moment_are_no_condition(values: int, named: bool) -> None:
    """A count more, over the first row of 0.1 ms, was the evidence for a friction: 42 % of the excess."""
    one = held()
    short = 50.0 + 1e-4 * np.arange(1.0, values + 1.0)
    time = np.concatenate([np.arange(51.0), short, np.arange(51.0, 101.0)])
    speed = 9.0 + np.where(np.arange(len(time) - 1) % 7 == 0, 1.0, -1.0)
    speed[50 : 50 + values] += 1e3
    data = index_intervals(time[:-1], time[1:], speed, np.full(len(speed), 1e-3 * np.diff(time).min()))
    off = replace(one, intervals=(data,), angles=(9.0 * time,), instants=(), responses=())
    off = replace(off, scored=(np.ones(len(speed), dtype=bool),))
    (region,) = find_worst_regions(off, SHARE, 1)
    assert (region.time < 1e-3 * MOMENT) is named and region.inside[50]
