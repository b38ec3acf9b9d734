"""Find two effects that hide each other: each is tried beside one that is likely, but is no finding alone."""

from collections.abc import Sequence

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import CandidateTest, likelihood_threshold, share_explained
from motor_identification.diagnosis.effect_test import (
    EFFECT_ORDER,
    choose_finding,
    is_supported,
    list_candidates,
    try_effects,
)
from motor_identification.diagnosis.evidence.likeness import find_rivals
from motor_identification.diagnosis.selection.selection import Selection, SelectionStep
from motor_identification.progress import ProgressReporter
from motor_model.effects import EFFECT_BY_NAME


def may_hide_pair(selection: Selection) -> bool:
    """Decide whether a gap is left in which two effects may hide each other, and not too much was found before.

    One response tells no two. The noise of coarse counts may hide the gap from row to row.
    """
    return may_add_pair(selection) and (not selection.model.complete or _is_hidden_by_counts(selection.model))


def _is_hidden_by_counts(model: Model) -> bool:
    """Decide whether what lasts is more than the sensor leaves, though from row to row it leaves all of it."""
    return not (model.beside_torque or model.above_floor) and model.lasts


def may_add_pair(selection: Selection) -> bool:
    """Decide whether two effects may be added at once: not too much was found before, and unseen motion confirms."""
    return len(selection.steps) < thresholds.PAIR_MOST_STEPS and selection.model.held.confirms


def list_partners(tests: Sequence[CandidateTest]) -> list[CandidateTest]:
    """List the tests, best first, whose effects are tried together with any other: likely, if not relevant alone."""
    plain = [test for test in tests if not EFFECT_BY_NAME[test.effect].periodic]
    likely = [test for test in plain if test.evidence > likelihood_threshold()]
    likely.sort(key=lambda test: (-round(test.evidence / thresholds.TIE_LIKELIHOOD), EFFECT_ORDER[test.effect]))
    return likely[: thresholds.PAIR_PARTNERS]


def list_compromises(tests: Sequence[CandidateTest]) -> list[CandidateTest]:
    """List the tests of what another effect comes with only: unlikely alone, though the gap falls.

    So is the Coulomb friction of a motor that breaks away, which holds it too little and slows it too much.
    """
    falling = [test for test in tests if test.explains > thresholds.COMPROMISE_SHARE]
    return [test for test in falling if test.evidence <= likelihood_threshold() and _list_dependent(test.effect)]


def _list_dependent(effect: str) -> list[str]:
    """List the effects that come with another one only."""
    return [one.name for one in EFFECT_BY_NAME.values() if one.implies == effect]


def find_pair(selection: Selection, tests: Sequence[CandidateTest], reporter: ProgressReporter) -> list[SelectionStep]:
    """Find the two effects that explain most together where neither does alone, as two steps, if there are such."""
    current, found = selection.model, []
    alone = [(test, _list_dependent(test.effect)) for test in list_compromises(tests)]
    for i, (first, only) in enumerate([*((test, None) for test in list_partners(tests)), *alone]):
        others = list_candidates(first.model.effects, current.held, current.beside_torque)
        tried = [effect for effect in others if only is None or effect in only]
        left = [effect for effect in tried if not EFFECT_BY_NAME[effect].periodic]

        def heard(test: CandidateTest, first: CandidateTest = first) -> None:
            reporter.report(f"{first.effect} with {test.effect}", 0.5, test.effect, test.model.held.gap)

        seconds = try_effects(first.model, selection.hold_out, left, selection.workers, heard)
        second = choose_finding(seconds)
        # Else it is a torque that lasts, beside which both are looked for again. Measured: of a friction and a limit of
        # the voltage, in speeds of 3.4 counts a row at most, 2.2 times the floor lasted, 1.9 with one, 1.1 with both.
        if second is None or (_is_hidden_by_counts(current) and second.model.lasts):
            continue
        together = share_explained(current.held.gap, second.model.held.gap, second.model.unpredictable_gap)
        steps = [
            SelectionStep(current, first, tuple(tests), (), together),
            SelectionStep(first.model, second, tuple(seconds), find_rivals(second, seconds), together),
        ]
        found.append((round(second.model.likelihood / thresholds.TIE_LIKELIHOOD), -i, steps))  # of equals the first
    return max(found)[2] if found else []


def find_closing_pair(
    selection: Selection, tests: Sequence[CandidateTest], reporter: ProgressReporter
) -> list[SelectionStep]:
    """Find the two effects of which one is likely beside a random torque, but opens the gap that the other closes.

    A torque is learned of what a model lacks, and large enough to make it complete: of friction on a coasting bridge.
    """
    opening = [test for test in tests if is_supported(test) and test.model.held.gap > test.held_before.gap]
    pair = find_pair(selection, opening, reporter) if opening else []
    closed = thresholds.CLOSED_GAP * selection.model.held.gap
    return pair if pair and pair[-1].found.model.held.gap < closed else []
