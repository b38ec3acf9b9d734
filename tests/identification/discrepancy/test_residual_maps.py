"""Maps of the residual, held against plain recomputation."""

import numpy as np
import pytest
from diagnosed import held

from motor_identification.discrepancy.operating_conditions import find_conditions
from motor_identification.discrepancy.residual_maps import AXES, map_residuals

SHARE = 0.003  # of a slot: what the disc of `diagnosed` has
FRICTION = {"ks": 0.4}


def test_maps_add_up_to_the_gap() -> None:
    one = held(**FRICTION)
    drawn = map_residuals(one, SHARE)
    assert {each.axis.name for each in drawn} == {axis.name for axis in AXES}
    whole = float(np.concatenate([data.duration for data in one.intervals])[one.counted].sum())
    for each in drawn:
        known = each.seconds > 0.0
        assert np.array_equal(known, np.isfinite(each.gap)) and len(each.edges) == len(each.gap) + 1
        if each.axis.name in ("acceleration", "since"):  # a standstill is on neither
            assert 0.8 * whole < each.seconds.sum() < whole
            continue
        assert each.seconds.sum() == pytest.approx(whole)
        for bins, total in ((each.gap, one.gap), (each.floor, one.floor(SHARE))):
            assert np.sqrt(np.average(bins[known] ** 2, weights=each.seconds[known])) == pytest.approx(total)


def test_a_bin_is_what_it_says() -> None:
    one = held(**FRICTION)
    seen = find_conditions(one)
    speed = next(each for each in map_residuals(one, SHARE) if each.axis.name == "speed")
    k = int(np.searchsorted(speed.edges, 30.0)) - 1
    inside = (seen.speed >= speed.edges[k]) & (seen.speed < speed.edges[k + 1])
    weight = seen.duration[inside] / seen.duration[inside].sum()
    assert speed.gap[k] == pytest.approx(np.sqrt(weight @ one.residuals[inside] ** 2))
    assert speed.mean[k] == pytest.approx(weight @ one.residuals[inside])
    assert speed.floor[k] == pytest.approx(np.sqrt(weight @ one.floors(SHARE)[inside] ** 2))
    assert speed.gap[k] > 10.0 * speed.floor[k] and speed.mean[k] > 0.7 * speed.gap[k]  # without friction: too fast
    k = int(np.searchsorted(speed.edges, -30.0)) - 1
    assert speed.mean[k] < -0.7 * speed.gap[k]


def test_a_complete_model_is_at_the_floor_everywhere() -> None:
    for each in map_residuals(held(), SHARE):
        full = (each.seconds > 0.5) & (each.floor > 0.05)
        ratio = each.gap[full] / each.floor[full]
        assert len(ratio) >= 2 and ratio.min() > 0.6 and ratio.max() < 1.4
