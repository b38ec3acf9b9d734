"""Select forward: add effects to a model one after the other, each because held-out motion speaks for it.

Forward selection is the first half of a stepwise selection (M. Efroymson, Multiple regression analysis, 1960);
`backward_elimination` is the other.
"""

from collections.abc import Sequence
from dataclasses import replace

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_fit import refit_without, split_kv
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import CandidateTest
from motor_identification.diagnosis.effect_test import (
    choose_finding,
    count_parameters,
    is_supported,
    list_candidates,
    try_effects,
    try_load_once_a_turn,
)
from motor_identification.diagnosis.evidence.likeness import find_rivals
from motor_identification.diagnosis.evidence.line_evidence import has_few_turns
from motor_identification.diagnosis.fits.score_scan import can_be_scanned
from motor_identification.diagnosis.selection.hidden_pairs import (
    find_closing_pair,
    find_pair,
    may_add_pair,
    may_hide_pair,
)
from motor_identification.diagnosis.selection.promised_pairs import (
    find_promised_pair,
    list_promised,
    promises_anything,
)
from motor_identification.diagnosis.selection.selection import Selection, SelectionStep
from motor_identification.periodic.periodic_fit import LOAD_OVER_ANGLE
from motor_identification.progress import ProgressReporter
from motor_model.effects import EFFECT_BY_NAME


def select_forward(
    selection: Selection, reporter: ProgressReporter, pairs: bool = True, known: frozenset[str] = frozenset()
) -> Selection:
    """Add effects as long as one is found; where none is and a gap is left, two at once if `pairs` are allowed.

    known: effects from which a selection has gone on already; one that comes to them ends there.
    """
    while True:
        reporter.keep(selection)
        if known and set(selection.model.effects) == known:
            return selection
        selection = replace(selection, model=split_kv(selection.model, selection.hold_out))
        selection, tests = verify_findings(selection, _try_all_effects(selection, reporter))
        best = choose_finding(tests)
        if best is not None and not _may_add(best, selection):
            return selection
        if best is not None:
            step = SelectionStep(selection.model, best, tuple(tests), find_rivals(best, tests), best.explains)
            selection = selection.add([step])
            continue
        plain = not selection.model.beside_torque
        refused = any(is_supported(test) and not test.relevant for test in tests)
        refused = refused or (plain and selection.model.at_floor and promises_anything(selection))
        pair = find_pair(selection, tests, reporter) if pairs and may_hide_pair(selection) else []
        if not pair and pairs and not plain and may_add_pair(selection):
            pair = find_promised_pair(selection) or find_closing_pair(selection, tests, reporter)
        selection = replace(selection, refused=refused)
        if not pair:
            return selection
        further = select_forward(selection.add(pair), reporter, pairs=False)
        if not further.model.complete and pair[-1].explains <= thresholds.STAND_IN_SHARE:
            return selection
        selection = further


def _may_add(finding: CandidateTest, selection: Selection) -> bool:
    """Decide whether a finding may be added: to what one response tells alone, only one that explains the rest.

    To as many as any motor has, only one that is likelier than one of those, which stood in for it then.
    """
    count = len(selection.steps)
    least = min((step.found.evidence for step in selection.steps), default=0.0)
    if count >= (thresholds.MOST_FINDINGS if finding.evidence <= least else thresholds.MOST_WITH_STAND_INS):
        return False
    several = count - thresholds.MOST_OF_ONE_RESPONSE
    return (
        selection.model.held.confirms or several < 0 or (several == 0 and finding.explains > thresholds.STAND_IN_SHARE)
    )


def verify_findings(selection: Selection, tests: list[CandidateTest]) -> tuple[Selection, list[CandidateTest]]:
    """Fit the model again from where a finding leads, but without it: as good a chance as the candidate had.

    Beside a random torque a likelihood has many summits (one restart more or less that is met), and whatever is tried
    may lead to a higher one. At the sensor's floor the last digit of a friction does the same. Only there: else least
    squares of speeds are smooth enough.
    """
    for _ in range(thresholds.VERIFICATIONS):
        best = choose_finding(tests)
        if best is None or not (best.model.beside_torque or selection.model.at_floor):
            break
        again = refit_without(best.model, best.effect, selection.hold_out)
        if again.likelihood <= selection.model.likelihood:
            break
        tests = [replace(test, before=again) if test.before is selection.model else test for test in tests]
        selection = replace(selection, model=again)
    return selection, tests


def _try_all_effects(selection: Selection, reporter: ProgressReporter) -> list[CandidateTest]:
    """Try every effect that the model lacks, where a finding could be made at all.

    Those that repeat with the angle only where others leave a gap; slots learnt without them hide it.
    """
    number, current = len(selection.steps) + 1, selection.model
    left = list_candidates(current.effects, current.held, current.beside_torque)
    count = 0

    def heard(test: CandidateTest) -> None:
        nonlocal count
        count += 1
        share = 0.1 + 0.8 * (1.0 - 0.5 ** (number - 1)) + 0.8 * 0.5**number * count / len(left)
        gap = min(test.model.held.gap, current.held.gap)
        reporter.report(f"step {number}: {test.effect}", share, test.effect, gap)

    hopeful = _list_promised(selection, left) if current.quiet else left
    plain = [effect for effect in left if effect in hopeful and not _is_periodic(effect)]
    tests = try_effects(current, selection.hold_out, plain, selection.workers, heard)
    best = choose_finding(tests)
    if best is None or best.model.above_floor:
        periodic = filter(_is_periodic, left)
        for effect in sorted(periodic, key=count_parameters):  # an eccentricity is a line in a ripple's spectrum too
            least = max((test.evidence for test in tests if is_supported(test) and test.relevant), default=0.0)
            tests += try_effects(current, selection.hold_out, [effect], selection.workers, heard, least)
        if LOAD_OVER_ANGLE in left and (_has_disc_of_few_turns(tests) or _may_be_load_once_a_turn(tests, current)):
            again = try_load_once_a_turn(current, selection.hold_out)
            if _has_disc_of_few_turns(tests) or _is_seen_in_gap(again):
                tests = _keep_better(tests, again)
    return sorted(tests, key=lambda test: -test.evidence)


def _may_be_load_once_a_turn(tests: Sequence[CandidateTest], current: Model) -> bool:
    """Whether a torque that goes round once a turn is tried, the commonest one, where no line was found to fit.

    A spectrum is of a linear response: where a motor stands or starts such a torque holds or helps. Measured: of
    ripples of 0.15 and 0.72 V beside frictions of 0.3 and 0.5 V lines explained 11 and 26 of chance's 30, and they were
    likelier by 64 and 45. Where nothing counts turns, chance does: times between edges had one of a random torque.
    A log of rows 20 s apart cannot show it, and its simulation of every turn took 50 s a fit.
    """
    fitted = any(test.effect == LOAD_OVER_ANGLE and test.model is not test.before for test in tests)
    return not fitted and any(data.tells_of_disc and data.follows_turns for data in current.held.intervals)


def _has_disc_of_few_turns(tests: Sequence[CandidateTest]) -> bool:
    """Whether a disc of few turns is likely, which has to be likelier than a torque that goes round with it."""
    return any(has_few_turns(test) and is_supported(test) for test in tests)


def _is_seen_in_gap(test: CandidateTest) -> bool:
    """Whether what no spectrum promised makes the gap smaller: else it follows a random torque through the motion.

    Measured: 0.974 and 0.94 of the gap were left of ripples that were there; 0.998 and 1.0 of two that were not,
    likelier by 32 and 11.
    """
    return test.model.held.gap < thresholds.SHRINKING_GAP * test.held_before.gap


def _keep_better(tests: Sequence[CandidateTest], again: CandidateTest) -> list[CandidateTest]:
    """Keep the better of two tests of an effect, of which one is among all tests."""
    same = [test for test in (*tests, again) if test.effect == again.effect]
    others = [test for test in tests if test.effect != again.effect]
    return [*others, max(same, key=lambda test: test.evidence)]


def _list_promised(selection: Selection, left: Sequence[str]) -> list[str]:
    """List what is promised where nothing that lasts is left, which likelihoods beside a torque tell alone.

    Anything else that is found there takes up what is missing: a limit what a friction on a coasting bridge leaves.
    With it what no scan can promise, which may do as well. Measured: a sag was found in the place of a limit at 46 V of
    48, which was likelier and had not been tried.
    """
    promised = list_promised(selection) if selection.model.beside_torque else []
    hopeful = [effect for effect in promised if effect in left]
    return [*hopeful, *(effect for effect in left if hopeful and not can_be_scanned(effect))]


def _is_periodic(effect: str) -> bool:
    return EFFECT_BY_NAME[effect].periodic
