"""Two effects that hide each other are found together, each needed beside the other, with what does as well."""

import pytest
from one_way import HIDING, noisy_levels

from motor_identification.diagnosis.candidate_test import likelihood_threshold, pair_threshold
from motor_identification.diagnosis.fits.score_scan import Promise
from motor_identification.diagnosis.selection.promised_pairs import (
    find_promised_pair,
    list_joint,
    list_likely,
    list_promised,
    promises_anything,
)
from motor_identification.diagnosis.selection.selection import Selection, begin_beside_torque
from motor_identification.diagnosis.start import begin
from motor_identification.estimation.request import Request

BELOW, ABOVE = 0.99, 1.01


def begun(**hidden: float) -> Selection:
    """The two-coefficient motor beside the torque that it leaves."""
    start = begin([noisy_levels(1, **hidden)], (), Request(), lambda: False).selection
    return begin_beside_torque(start.model, start.hold_out, 1)


def promise(gain: float, *effects: str) -> Promise:
    return Promise(effects, gain, tuple({} for _ in effects))


def test_two_that_hide_each_other_are_found_with_their_rivals() -> None:
    first, second = find_promised_pair(begun(**HIDING))
    assert {first.found.effect, second.found.effect} == {"coulomb_friction", "quadratic_drag"}
    assert second.before is first.found.model and set(second.found.model.effects) == set(first.found.model.effects) | {
        second.found.effect
    }
    (friction,) = (step for step in (first, second) if step.found.effect == "coulomb_friction")
    assert friction.rivals == ("load_bias", "dead_zone")  # of a motor that turns one way
    assert second.found.model.likelihood - first.before.likelihood > 2.0 * likelihood_threshold()


@pytest.mark.parametrize("hidden", [{}, {"ks": 0.5}])
def test_no_pair_is_made_of_one_or_none(hidden: dict[str, float]) -> None:
    assert find_promised_pair(begun(**hidden)) == []


@pytest.mark.parametrize(("hidden", "more"), [({}, False), ({"ks": 0.5}, True), (HIDING, True)])
def test_what_is_missing_is_promised_at_the_floor_too(hidden: dict[str, float], more: bool) -> None:
    assert promises_anything(begun(**hidden)) is more
    alone = {"load_bias", "coulomb_friction", "dead_zone"} if hidden == {"ks": 0.5} else set()
    assert set(list_promised(begun(**hidden))) == alone  # a motor that turns one way does not tell these apart


@pytest.mark.parametrize("least", [likelihood_threshold(), pair_threshold()])
def test_what_is_promised_has_to_be_likely(least: float) -> None:
    above = promise(ABOVE * least, "load_bias")
    assert list_likely((above, promise(BELOW * least, "load_bias")), least) == [above]


def test_two_effects_have_to_be_likely_among_all_pairs() -> None:
    assert likelihood_threshold() < pair_threshold() < 2.0 * likelihood_threshold()
    promises = [promise(times * pair_threshold(), "load_bias", "supply_sag") for times in (ABOVE, BELOW)]
    assert list_joint((), (promises[0], promises[1])) == promises[:1]


@pytest.mark.parametrize(("times", "joint"), [(ABOVE, True), (BELOW, False)])
def test_a_pair_is_likelier_than_either(times: float, joint: bool) -> None:
    alone, both = promise(20.0, "load_bias"), promise(20.0 + times * likelihood_threshold(), "load_bias", "supply_sag")
    assert list_joint((alone,), (both,)) == [both] * joint
    assert list_joint((promise(20.0, "quadratic_drag"),), (both,)) == [both]  # which is another's
