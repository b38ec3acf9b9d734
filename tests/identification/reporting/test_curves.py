"""What figures draw: the residual of a fit and of held-out data, and the seconds with most of it."""

import numpy as np
import pytest
from diagnosed import fitted

from motor_identification.diagnosis.result import Diagnosis, Verdict
from motor_identification.discrepancy.worst_regions import find_worst_regions
from motor_identification.reporting.curves import (
    find_largest_change,
    find_largest_error,
    make_fit_curves,
    make_held_out_curves,
)


def test_curves_leave_what_the_fit_leaves(found: Diagnosis) -> None:
    """The time-weighted RMS of what is drawn is the fit's own residual; the seconds with most of it are found."""
    recording = fitted(ks=0.4)[0].problem.recordings[0]
    curves = make_fit_curves(recording, found.model)
    weight = curves.duration / curves.duration.sum()
    assert (weight @ curves.residual**2) ** 0.5 == pytest.approx(found.model.residual_rms, rel=0.05)
    assert (weight @ curves.floor**2) ** 0.5 == pytest.approx(found.model.noise_floor, rel=0.05)
    moving = ~curves.still
    assert curves.residual[moving] == pytest.approx((curves.simulated - curves.measured)[moving])
    start, stop = find_largest_error(curves, recording.duration)
    part = curves.between(start, stop)
    most = part.duration @ part.residual**2
    other = curves.between(start + 5.0, stop + 5.0)
    assert stop - start == 3.0 and most >= other.duration @ other.residual**2


def test_curves_of_held_out_data_leave_the_gap(found: Diagnosis) -> None:
    curves = make_held_out_curves(found.after, found.slot_share, 0, ())
    counted = curves.scored
    weight = curves.duration[counted] / curves.duration[counted].sum()
    assert (weight @ curves.residual[counted] ** 2) ** 0.5 == pytest.approx(found.gap_after)
    assert (weight @ curves.floor[counted] ** 2) ** 0.5 == pytest.approx(found.noise_floor)


def test_worst_regions_are_marked_where_they_are(found: Diagnosis) -> None:
    (region, *_) = find_worst_regions(found.before, found.slot_share)
    curves = make_held_out_curves(found.before, found.slot_share, 0, (region,))
    (marked,) = curves.regions
    assert marked.sum() == region.inside.sum() and not np.any(marked & ~curves.scored)
    weight = curves.duration[marked] / curves.duration[marked].sum()
    assert (weight @ curves.residual[marked] ** 2) ** 0.5 == pytest.approx(region.gap)


def test_the_seconds_that_change_most_are_found(found: Diagnosis, variants: dict[Verdict, Diagnosis]) -> None:
    number, start, stop = find_largest_change(found)
    assert (number, stop - start) == (0, 3.0)
    before, after = (make_held_out_curves(held, 0.0, 0, ()) for held in (found.before, found.after))

    def change(begin: float) -> float:
        sums = []
        for curves in (before, after):
            part = curves.between(begin, begin + 3.0)
            sums.append(float(part.duration[part.scored] @ part.residual[part.scored] ** 2))
        return abs(sums[0] - sums[1])

    assert change(start) >= max(change(begin) for begin in np.arange(0.0, 10.0, 0.5))
    _, worst, _ = find_largest_change(variants[Verdict.UNEXPLAINED])
    assert (
        worst
        == find_largest_error(make_held_out_curves(found.before, 0.0, 0, ()), found.before.recordings[0].duration)[0]
    )
