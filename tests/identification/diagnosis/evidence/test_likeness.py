"""What explains about as much as a finding does is its rival."""

import pytest
from stub_models import stub_model, stub_test

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.evidence.likeness import find_rivals


def test_rivals_are_likely_themselves() -> None:
    before = stub_model(5.0)
    weak = stub_test("load_bias", before, 1.0, 9.0)
    assert find_rivals(weak, [weak, stub_test("dead_zone", before, 1.0, 7.0)]) == ()  # below what chance may do


@pytest.mark.parametrize(
    ("found", "other", "share", "alike"),
    [
        ("dead_zone", "coulomb_friction", 1.0 - 0.99 * thresholds.HOLDING_LEAD, True),
        ("dead_zone", "coulomb_friction", 1.0 - 1.01 * thresholds.HOLDING_LEAD, False),
        ("coulomb_friction", "dead_zone", 0.9, False),  # every motor has friction
        ("dead_zone", "load_bias", 0.9, False),  # which holds nothing
        ("supply_sag", "coulomb_friction", 0.9, False),
    ],
)
def test_a_friction_that_does_most_of_what_a_dead_zone_does_is_its_rival(
    found: str, other: str, share: float, alike: bool
) -> None:
    """Beside a warming-up that had no name, a dead zone was likelier by e^139 than nothing, and a friction by e^132."""
    before = stub_model(5.0)
    best = stub_test(found, before, 1.0, 1000.0)
    rivals = find_rivals(best, [best, stub_test(other, before, 1.5, 1000.0 * share)])
    assert rivals == ((other,) if alike else ())


FOUND = 1.01 * thresholds.LEFT_GAP  # times the floor of 1 rad/s
LITTLE = FOUND**2 + thresholds.LITTLE_OF_LEFT * (FOUND**2 - 1.0)  # (rad/s)², at the limit


@pytest.mark.parametrize(
    ("other", "left", "gap", "share", "alike"),
    [
        ("coast_drive", FOUND, 0.999 * LITTLE**0.5, 0.9, True),
        ("coast_drive", FOUND, 1.001 * LITTLE**0.5, 0.9, False),
        ("coast_drive", FOUND, FOUND, 1.0 - 0.99 * thresholds.LITTLE_OF_LEFT, True),
        ("coast_drive", FOUND, FOUND, 1.0 - 1.01 * thresholds.LITTLE_OF_LEFT, False),
        ("coast_drive", 0.99 * thresholds.LEFT_GAP, 0.99 * thresholds.LEFT_GAP, 0.9, False),  # it is all that is there
        ("dead_zone", FOUND, FOUND, 0.9, False),  # of what holds the motor another rule decides
    ],
)
def test_what_leaves_hardly_more_than_a_finding_that_is_not_all_is_its_rival(
    other: str, left: float, gap: float, share: float, alike: bool
) -> None:
    """Four real runs of one level each had a limit with certainty: what slips or drags left 1.2 and 1.7 % more."""
    before = stub_model(5.0)
    found = "voltage_limit" if other == "coast_drive" else "coulomb_friction"
    best = stub_test(found, before, left, 1000.0)
    assert find_rivals(best, [best, stub_test(other, before, gap, 1000.0 * share)]) == ((other,) if alike else ())
