"""An effect is judged by most of the time alone: whatever is left in few moments, of both models, does not count."""

from dataclasses import replace

import numpy as np
import pytest
from stub_models import COUNT, LASTING_FLOOR, STEP, stub_model

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.evidence.calm_evidence import explains_calm, measure_calm_share
from motor_identification.measurement.edit_intervals import exclude_intervals
from motor_identification.validation.held_out import HeldOut

BELOW, ABOVE = 0.999, 1.001
LASTING = COUNT // 2  # intervals that last


def steady(gap: float, wild: float = 0.0, many: int = 1) -> Model:
    """A model off by a steady gap [rad/s], and by more in so many lasting intervals."""
    model = stub_model(gap, gap)
    (angle,) = model.held.angles
    more = np.zeros(COUNT)
    more[: 2 * many] = wild
    return replace(model, held=replace(model.held, angles=(angle + np.append(0.0, np.cumsum(more * STEP)),)))


def exclude(held: HeldOut, few: int) -> HeldOut:
    """The same motion without its first few intervals."""
    (data,), (scored,), kept = held.intervals, held.scored, np.arange(COUNT) >= few
    return replace(held, intervals=(exclude_intervals(data, ~kept),), scored=(scored[kept],))


def test_what_is_left_in_few_moments_does_not_count() -> None:
    """One of 20 lasting intervals is a twentieth of the time."""
    without, model = steady(3.0, 100.0), steady(1.0, 100.0)
    share = (3.0**2 - 1.0) / (3.0**2 - LASTING_FLOOR**2)
    assert measure_calm_share(without, model) == pytest.approx(share)
    gaps = without.held.gap, model.held.gap
    assert (gaps[0] ** 2 - gaps[1] ** 2) / gaps[0] ** 2 < 0.1  # in all of the time
    assert 1.0 / LASTING == thresholds.WILD_TIME
    assert measure_calm_share(steady(3.0, 100.0, 2), steady(1.0, 100.0, 2)) < 0.1


def test_where_a_model_bends_the_motion_instead_it_explains_nothing_there() -> None:
    without = steady(3.0, 100.0)
    assert measure_calm_share(without, steady(3.0, 1.0)) == pytest.approx(0.0, abs=1e-9)


def test_models_that_are_judged_by_other_intervals_are_not_compared() -> None:
    """Directions were read anew, and a block of time has an instant in it, which does not count."""
    without, model = steady(3.0), steady(1.0)
    block = np.arange(COUNT) < 4
    left_out = replace(model, held=replace(model.held, instants=(block,), scored=(~block,)))
    assert measure_calm_share(without, left_out) > 0.9
    shorter = replace(without, held=exclude(without.held, 2))
    assert measure_calm_share(shorter, left_out) == 0.0
    assert measure_calm_share(shorter, model) == 0.0


@pytest.mark.parametrize(("times", "enough"), [(BELOW, False), (ABOVE, True)])
def test_thresholds(times: float, enough: bool) -> None:
    share = times * thresholds.CALM_SHARE
    left = float(np.sqrt(3.0**2 - share * (3.0**2 - LASTING_FLOOR**2)))
    assert explains_calm(steady(3.0, 50.0), steady(left, 50.0)) is enough
    near = times * thresholds.NEAR_FLOOR_SEEN * LASTING_FLOOR
    assert explains_calm(steady(near), steady(0.0)) is enough
