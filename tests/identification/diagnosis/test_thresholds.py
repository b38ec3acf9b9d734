"""Every threshold of the diagnosis decides: just on one side of it, and just on the other."""

from dataclasses import replace
from math import log, sqrt
from typing import cast

import numpy as np
import pytest
from stub_models import LASTING_FLOOR, STEP, rescored, stub_held, stub_model, stub_test

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import find_lasting_interval
from motor_identification.diagnosis.candidate_test import (
    CandidateTest,
    fits_torque,
    likelihood_threshold,
    pair_threshold,
    predicts_far_worse,
)
from motor_identification.diagnosis.effect_test import choose_finding
from motor_identification.diagnosis.evidence.likeness import find_rivals
from motor_identification.recording import Recording
from motor_model.effects import EFFECTS
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters

BELOW, ABOVE = 0.999, 1.001
SIDES = pytest.mark.parametrize(("times", "passes"), [(BELOW, False), (ABOVE, True)])


def left_after(share: float, before: float, floor: float) -> float:
    """The gap that is left once this share of the excess over the floor is explained."""
    return sqrt(before**2 - share * (before**2 - floor**2))


@SIDES
def test_explained_gap(times: float, passes: bool) -> None:
    model = stub_model(times * thresholds.EXPLAINED_GAP, 0.0)
    assert model.above_floor is passes and model.at_floor is not passes


@SIDES
def test_quiet_gap(times: float, passes: bool) -> None:
    assert stub_model(2.0, times * thresholds.QUIET_GAP * LASTING_FLOOR).quiet is not passes


def test_lasting_interval() -> None:
    """What alternates every 1/16 s is gone in it, what is steady is not."""
    held = stub_held(3.0, 0.0)
    length = find_lasting_interval(held)
    assert length == thresholds.LASTING_INTERVAL  # the paper's motor has a time constant of 0.08 s
    assert held.joined(length).gap < 1e-9 and held.joined(0.5 * length).gap == pytest.approx(3.0)
    assert stub_held(3.0, 3.0).joined(length).gap == pytest.approx(3.0)


@SIDES
def test_lasting_rows(times: float, passes: bool) -> None:
    """A fast motor's fine rows are joined until so many average out, never for longer than the paper's."""
    held = stub_held(3.0)
    (data,) = held.intervals
    short = times * thresholds.LASTING_INTERVAL / thresholds.LASTING_ROWS
    fine = replace(data, time=data.time * short / STEP)
    fast = Parameters({"kv": PAPER_KV, "ka": 1e-3 * PAPER_KA})
    length = find_lasting_interval(replace(held, intervals=(fine,), parameters=fast))
    assert length == pytest.approx(min(times, 1.0) * thresholds.LASTING_INTERVAL)
    assert (length == thresholds.LASTING_INTERVAL) is passes


@pytest.mark.parametrize(("times", "length"), [(1.9, 1.9 * PAPER_KA / PAPER_KV), (2.3, 2.5 / thresholds.LASTING_PARTS)])
def test_lasting_parts(times: float, length: float) -> None:
    """A slow motor's time constant, where the 2.5 s of motion have enough of it."""
    slow = Parameters({"kv": PAPER_KV, "ka": times * PAPER_KA})
    assert find_lasting_interval(replace(stub_held(3.0), parameters=slow)) == pytest.approx(length)


@SIDES
def test_false_alarm_rate(times: float, passes: bool) -> None:
    assert likelihood_threshold() == pytest.approx(log(len(EFFECTS) / thresholds.FALSE_ALARM_RATE))
    assert pair_threshold() == pytest.approx(log(0.5 * len(EFFECTS) * (len(EFFECTS) - 1) / thresholds.FALSE_ALARM_RATE))
    test = stub_test("coulomb_friction", stub_model(5.0), 1.0, times * likelihood_threshold())
    assert (choose_finding([test]) is test) is passes


@SIDES
def test_common_likelihood(times: float, passes: bool) -> None:
    """Coulomb friction is earlier in the table than a constant load: it is taken unless the other is more likely."""
    before = stub_model(5.0)
    load = stub_test("load_bias", before, 1.0, 100.0)
    friction = stub_test("coulomb_friction", before, 1.0, 100.0 - times * thresholds.COMMON_LIKELIHOOD)
    assert choose_finding([load, friction]) is (load if passes else friction)
    assert choose_finding([stub_test("coulomb_friction", before, 1.0, 100.0), load]) is not load


def of_two_recordings(test: CandidateTest) -> CandidateTest:
    held = replace(test.model.held, recordings=cast(tuple[Recording, ...], (None, None)))
    return replace(test, model=replace(test.model, held=held))


@SIDES
def test_what_needs_an_instant_has_to_be_likelier_than_what_needs_none(times: float, passes: bool) -> None:
    """Where either is so little likely that a share of it is less than that margin."""
    before = stub_model(5.0)
    load = stub_test("load_step", before, 1.0, 20.0)
    friction = stub_test("coulomb_friction", before, 1.0, 20.0 - times * thresholds.RIVAL_MARGIN)
    both = of_two_recordings(load)
    assert (load.has_instants, both.has_instants, of_two_recordings(friction).has_instants) == (False, True, False)
    assert choose_finding([both, friction]) is (both if passes else friction)
    assert choose_finding([load, friction]) is (load if passes else friction)


@SIDES
def test_such_an_instant_explains_as_much_as_near_the_floor(times: float, passes: bool) -> None:
    left = left_after(times * thresholds.RELEVANT_SHARE_NEAR_FLOOR, 2.0, LASTING_FLOOR)
    load = stub_test("load_step", stub_model(5.0, 2.0), 0.99 * 5.0, 100.0, left)
    assert load.relevant and of_two_recordings(load).relevant is passes


@SIDES
def test_rival_margin(times: float, passes: bool) -> None:
    before = stub_model(5.0)
    found = stub_test("load_bias", before, 1.0, 100.0)
    other = stub_test("dead_zone", before, 1.0, 100.0 - times * thresholds.RIVAL_MARGIN)
    assert find_rivals(found, [found, other]) == (() if passes else ("dead_zone",))


LOST = -thresholds.COMMON_LIKELIHOOD


@pytest.mark.parametrize(
    ("gains", "rival"),
    [
        ([50.0, *[LOST / 4.0 * ABOVE] * 4], True),
        ([50.0, *[LOST / 4.0 * BELOW] * 4], False),
        ([50.0, *[LOST / 3.0 * ABOVE] * 3], False),  # too few recordings
        ([50.0, 0.0, 0.0, ABOVE * LOST / 2.0, ABOVE * LOST / 2.0], False),  # most are for it, or say nothing
        ([600.0, 0.0, 0.0, 0.0, 0.0], False),  # one that tells everything
        ([600.0, 600.0, 0.0, 0.0, 0.0], False),
        ([5000.0, 40.0, 30.0, 20.0, 10.0], False),
    ],
)
def test_what_most_of_many_recordings_prefer_is_a_rival(gains: list[float], rival: bool) -> None:
    before = stub_model(5.0)
    found = stub_test("transport_delay", before, 1.0, 100.0)
    other = stub_test("armature_inductance", before, 1.0, 100.0 - 2.0 * thresholds.RIVAL_MARGIN)
    found = replace(found, model=rescored(found.model, by_recording=tuple(np.add(50.0, gains))))
    other = replace(other, model=rescored(other.model, by_recording=(50.0,) * len(gains)))
    assert find_rivals(found, [found, other]) == (("armature_inductance",) if rival else ())


@SIDES
def test_what_all_data_hardly_tell_is_a_rival(times: float, passes: bool) -> None:
    """However unlike they are in the few that are held out."""
    before = stub_model(5.0)
    found = stub_test("transport_delay", before, 1.0, 100.0)
    other = stub_test("armature_inductance", before, 1.0, 80.0)
    other = replace(other, model=rescored(other.model, training=(20.0 - thresholds.RIVAL_MARGIN) * times))
    assert find_rivals(found, [found, other]) == (("armature_inductance",) if passes else ())


@SIDES
def test_relevant_gap(times: float, passes: bool) -> None:
    before = stub_model(5.0, times * thresholds.RELEVANT_GAP * LASTING_FLOOR)
    assert stub_test("load_bias", before, 4.9, 100.0, LASTING_FLOOR).relevant is passes


@SIDES
def test_relevant_gap_of_what_the_fit_has_seen(times: float, passes: bool) -> None:
    before = stub_model(5.0, times * thresholds.SEEN_GAP * LASTING_FLOOR)
    seen = replace(before, held=replace(before.held, seen=True))
    assert stub_test("load_bias", seen, 4.9, 100.0, LASTING_FLOOR).relevant is passes


@SIDES
@pytest.mark.parametrize(
    ("gap", "lasting", "share"),
    [
        (5.0, 2.0, thresholds.RELEVANT_SHARE),
        (1.2, 1.01 * thresholds.NEAR_FLOOR * LASTING_FLOOR, thresholds.RELEVANT_SHARE),
        (1.2, 0.99 * thresholds.NEAR_FLOOR * LASTING_FLOOR, thresholds.RELEVANT_SHARE_NEAR_FLOOR),
    ],
    ids=["far above the floor", "above the floor where it lasts", "at the floor"],
)
def test_relevant_share(gap: float, lasting: float, share: float, times: float, passes: bool) -> None:
    left = left_after(times * share, lasting, LASTING_FLOOR)
    assert stub_test("load_bias", stub_model(gap, lasting), 0.99 * gap, 100.0, left).relevant is passes


@SIDES
@pytest.mark.parametrize(
    ("floors", "share"),
    [
        (1.01 * thresholds.NEAR_FLOOR_SEEN, thresholds.RELEVANT_SHARE),
        (0.99 * thresholds.NEAR_FLOOR_SEEN, thresholds.RELEVANT_SHARE_NEAR_FLOOR),
    ],
)
def test_relevant_share_of_what_the_fit_has_seen(floors: float, share: float, times: float, passes: bool) -> None:
    lasting = floors * LASTING_FLOOR
    before = stub_model(5.0, lasting)
    seen = replace(before, held=replace(before.held, seen=True))
    left = left_after(times * share, lasting, LASTING_FLOOR)
    assert stub_test("load_bias", seen, 4.9, 100.0, left).relevant is passes


@SIDES
def test_what_lasts_is_seen_however_small_it_is_in_the_gap(times: float, passes: bool) -> None:
    model = stub_model(1.2, times * thresholds.LASTING_GAP * LASTING_FLOOR)
    assert model.at_floor and model.lasts is passes


def test_a_gap_must_not_grow() -> None:
    before = stub_model(5.0, 2.0)
    assert stub_test("load_bias", before, 4.999, 100.0, LASTING_FLOOR).relevant
    assert not stub_test("load_bias", before, 5.0, 100.0, LASTING_FLOOR).relevant


@SIDES
def test_gap_chance(times: float, passes: bool) -> None:
    """A model beside a random torque that predicts worse than the one to begin with fits the torque."""
    start = stub_held(2.0)
    assert fits_torque(stub_held(times * thresholds.GAP_CHANCE * 2.0), start) is passes
    assert fits_torque(replace(stub_held(times * 2.0), seen=True), start) is passes  # it was fitted to that
    grown = replace(stub_held(times * thresholds.GAP_CHANCE * 2.0), seen=True)
    assert fits_torque(grown, start, lines=True) is passes  # of which the plain fit took up some


@SIDES
def test_worse_gap_of_a_torque(times: float, passes: bool) -> None:
    """A torque without a finding that a model without it predicts was learned of that finding's effect."""
    assert predicts_far_worse(times * thresholds.WORSE_GAP * 2.0, 2.0) is passes
