"""Recordings of one motor agree; one of a warmer motor does not, and is named."""

from dataclasses import replace

import pytest
from plant import profiles, record
from small import THETA, TRUE

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.whitened_fit import make_whitened
from motor_identification.recording import check
from motor_identification.uncertainty.recording_consistency import (
    INCONSISTENT_RATIO,
    INCONSISTENT_SCORE,
    Dissent,
    compare_recordings,
    describe_worst_dissent,
)

DRIVE = profiles.pieces([9.0, 4.0, -9.0], 0.25)


def compared(*gains: float) -> tuple[Dissent, ...]:
    """Of motors whose kv is so many times the first one's."""
    recordings = [
        check(record(TRUE | {"kv": gain * TRUE["kv"]}, *DRIVE, seed=seed, irregularity=0.003, name=f"{seed}")[0])
        for seed, gain in enumerate(gains)
    ]
    estimate = fit_speeds(Estimate(make_problem(recordings, ("coulomb_friction",)), THETA))
    return compare_recordings(make_whitened(estimate))


def test_one_motor_agrees_with_itself() -> None:
    found = compared(1.0, 1.0, 1.0)
    assert [one.uri for one in found] == ["0", "1", "2"]
    assert not any(one.disagrees for one in found)
    assert all(one.common < INCONSISTENT_RATIO * one.own for one in found)


def test_another_motor_disagrees() -> None:
    found = compared(1.0, 1.0, 1.0, 1.05)
    assert max(found, key=lambda one: one.common / one.own).uri == "3" and found[3].disagrees
    assert found[3].common > 3.0 * found[3].own


@pytest.mark.parametrize(("duration", "values", "tells"), [(0.03, 7, False), (0.05, 15, True)])
def test_a_few_values_are_no_witness(duration: float, values: int, tells: bool) -> None:
    """They fit a motor of their own as well as they like: five rows behind a gap left 10^-14 rad/s."""
    drives, gains = (DRIVE, profiles.pieces([9.0], duration)), (1.0, 1.1)
    recordings = [
        check(record(TRUE | {"kv": gain * TRUE["kv"]}, *drive, seed=seed, irregularity=0.003, name=f"{seed}")[0])
        for seed, (drive, gain) in enumerate(zip(drives, gains, strict=True))
    ]
    fit = make_whitened(fit_speeds(Estimate(make_problem(recordings, ("coulomb_friction",)), THETA)))
    assert len(fit.problem.split(fit.problem.residuals(fit.theta))[1]) == values
    assert compare_recordings(fit)[1].disagrees is tells


def test_a_single_recording_has_nobody_to_disagree_with() -> None:
    assert compared(1.0) == ()


@pytest.mark.parametrize(
    ("score", "ratio", "disagrees"), [(1.01, 1.01, True), (0.99, 1.01, False), (1.01, 0.99, False)]
)
def test_more_than_noise_and_more_than_nobody_would_see(score: float, ratio: float, disagrees: bool) -> None:
    one = Dissent("bag", ratio * INCONSISTENT_RATIO, 1.0, score * INCONSISTENT_SCORE)
    assert one.disagrees is disagrees


def test_the_sentence_has_the_worst_of_those_that_disagree() -> None:
    worst = Dissent("bag", 3.621, 0.09412, 99.0)
    (said,) = describe_worst_dissent([worst])
    assert said.startswith("bag: joint fit 3.62 rad/s RMS, separate fit 0.0941: the recordings disagree. Do not trust")
    assert "fit each recording alone" in said
    other, quiet = replace(worst, uri="other", common=3.0), replace(worst, uri="quiet", score=0.0)
    assert "bag: joint" in describe_worst_dissent([quiet, other, worst])[0]
    assert "disagree, and 1 other does, too. Do" in describe_worst_dissent([other, worst, quiet])[0]
    assert "disagree, and 2 others do, too. Do" in describe_worst_dissent([other, worst, other])[0]
    assert describe_worst_dissent([quiet]) == []
