"""Find two effects that hide each other, where a scan of all pairs promises what neither of them gains alone.

Friction and drag do: a gain and a torque of their own take up either of them, and both only badly. Where the gap is at
the floor of a coarse sensor, that is all that tells; the rest is as where one effect is found.
"""

from collections.abc import Iterable

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_fit import refine_beside_torque, refit_without, validate_model
from motor_identification.diagnosis.candidate_test import CandidateTest, likelihood_threshold, pair_threshold
from motor_identification.diagnosis.effect_test import (
    EFFECT_ORDER,
    choose_finding,
    count_parameters,
    sort_by_table,
)
from motor_identification.diagnosis.fits.effect_fit import fit_promised
from motor_identification.diagnosis.fits.score_scan import Promise
from motor_identification.diagnosis.selection.selection import Selection, SelectionStep


def promises_anything(selection: Selection) -> bool:
    """Decide whether one effect more, or two, are promised to be likely."""
    singles, pairs = selection.promises
    return bool(list_likely(singles, likelihood_threshold()) or list_likely(pairs, pair_threshold()))


def list_promised(selection: Selection) -> list[str]:
    """List the effects that are promised to be likely alone."""
    return [one.effects[0] for one in list_likely(selection.promises[0], likelihood_threshold())]


def list_likely(promises: Iterable[Promise], least: float) -> list[Promise]:
    """List the promises that gain more than so much."""
    return [one for one in promises if one.gain > least]


def list_joint(singles: tuple[Promise, ...], pairs: tuple[Promise, ...]) -> list[Promise]:
    """List the promises of pairs that would be likely, and likelier than either of the two effects alone."""
    alone = {one.effects[0]: one.gain for one in singles}
    least = likelihood_threshold()
    joint = [one for one in pairs if one.gain - max(alone.get(name, 0.0) for name in one.effects) > least]
    return list_likely(joint, pair_threshold())


def find_promised_pair(selection: Selection) -> list[SelectionStep]:
    """Find the two effects of which each is a finding beside the other, as two steps, if there are such."""
    pairs = list_joint(*selection.promises)
    least = max((one.gain for one in pairs), default=0.0) - thresholds.RIVAL_MARGIN
    found = [_try_pair(selection, one) for one in pairs[: thresholds.PROMISES_TRIED] if one.gain >= least]
    likely = [steps for steps in found if steps]
    if not likely:
        return []
    most = max(steps[-1].found.model.likelihood for steps in likely)
    alike = [steps for steps in likely if steps[-1].found.model.likelihood >= most - thresholds.RIVAL_MARGIN]
    best = min(alike, key=_order)
    return [_with_rivals(step, best, alike) for step in best]


def _order(steps: list[SelectionStep]) -> list[int]:
    return sorted(EFFECT_ORDER[step.found.effect] for step in steps)


def _with_rivals(step: SelectionStep, chosen: list[SelectionStep], alike: list[list[SelectionStep]]) -> SelectionStep:
    """Name the rivals of a step: what stands in its place beside the other, and does as well."""
    (other,) = (one.found.effect for one in chosen if one is not step)
    pairs = [{one.found.effect for one in steps} for steps in alike]
    rivals = {name for pair in pairs if other in pair for name in pair - {other, step.found.effect}}
    fewest = [name for name in rivals if count_parameters(name) <= count_parameters(step.found.effect)]
    return SelectionStep(step.before, step.found, step.tests, sort_by_table(fewest), step.explains)


def _try_pair(selection: Selection, promise: Promise) -> list[SelectionStep]:
    """Fit two effects more, and judge each beside the other."""
    current, hold_out = selection.model, selection.hold_out
    assert current.learned is not None
    larger = validate_model(hold_out, fit_promised(current.estimate, promise, current.learned), current)
    both = refine_beside_torque(larger, hold_out)
    if both.likelihood - current.likelihood < pair_threshold():
        return []
    tests = [CandidateTest(effect, refit_without(both, effect, hold_out), both) for effect in promise.effects]
    if any(choose_finding([test]) is None for test in tests):
        return []
    second, first = sorted(tests, key=lambda test: -test.before.likelihood)  # the likelier rest comes first
    begun = CandidateTest(first.effect, current, second.before)
    return [
        SelectionStep(current, begun, (begun,), (), second.explains),
        SelectionStep(second.before, second, (second,), (), second.explains),
    ]
