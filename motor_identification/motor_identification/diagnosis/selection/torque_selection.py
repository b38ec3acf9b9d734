"""Select effects beside a random torque, where more is left than the sensor leaves: what was found is judged again.

Forward selection and backward elimination as without a torque, on models that are fitted and judged beside one.
"""

import numpy as np

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import (
    fits_torque,
    likelihood_threshold,
    pair_threshold,
    predicts_far_worse,
    takes_away_more,
)
from motor_identification.diagnosis.effect_test import is_static, sort_by_table
from motor_identification.diagnosis.evidence.line_evidence import adds_only_lines, count_waves
from motor_identification.diagnosis.run_gains import find_gap_less_gains, may_be_of_gains
from motor_identification.diagnosis.selection.backward_elimination import eliminate_backward
from motor_identification.diagnosis.selection.determination import is_of_no_motor
from motor_identification.diagnosis.selection.forward_selection import select_forward
from motor_identification.diagnosis.selection.selection import Selection, begin_beside_torque
from motor_identification.diagnosis.selection.stand_ins import drop_stand_ins_of_either
from motor_identification.noise.error_model import ErrorModel
from motor_identification.progress import ProgressReporter
from motor_identification.validation.held_out import HeldOut
from motor_model.effects import EFFECT_BY_NAME


def select_beside_torque(start: Selection, plain: Selection, reporter: ProgressReporter) -> Selection | None:
    """Select on beside a random torque, where more is left than the sensor leaves; None if that leaves structure.

    Unless nothing certain was found without one, and what was found beside it halves the gap on unseen motion: two
    effects that hide each other, and more that is missing.
    From what was found without it, and where that leads nowhere from the beginning, or to a torque that leaves less
    than it should, which is taken if the beginning leads nowhere. Where only something likely was refused, that is
    looked for beside a torque that is there, and nothing that was found is judged again.
    """
    disturbed = _may_be_disturbed(plain) or any(may_be_of_gains(step, plain.hold_out) for step in plain.steps)
    if not (disturbed or plain.refused):
        return None
    doubtful: list[Selection] = []
    incomplete: list[Selection] = []
    for begin in (plain, start) if plain.steps and disturbed else (plain,):
        selection = _go_on_from(begin, plain, bool(doubtful), reporter)
        if selection is None or _is_too_much(selection.model, plain.model):
            continue
        if not selection.model.complete:
            incomplete.append(selection)
        elif selection.model.fills_floor:
            return _choose_more(selection, plain, disturbed)
        else:
            doubtful.append(selection)
    if doubtful:
        return _choose_more(doubtful[0], plain, disturbed)
    return _choose_incomplete(incomplete, plain)


def _go_on_from(begin: Selection, plain: Selection, explained: bool, reporter: ProgressReporter) -> Selection | None:
    """Select on beside a random torque; None if that predicts far worse than what was found without one.

    Or if it comes from the beginning to what was found, from which it was gone on already, unless only now nothing is
    left that can be predicted; or begins beside a torque that no motor has. Measured: beside a limit that was found
    alone a torque was learned four times too strong, and left structure; from the beginning 0.283 V of 0.3, and none.
    explained: whether what was gone on from left none.
    """
    reporter.report("beside a random torque", 0.5, "", begin.model.held.gap)
    begun = begin_beside_torque(begin.model, begin.hold_out, begin.workers, begin.steps)
    if _is_beyond_drive(begun.model):
        return None
    known = frozenset() if begin is plain else frozenset(plain.model.effects)
    selection = select_forward(begun, reporter, known=known)
    if known and set(selection.model.effects) == known and (explained or not selection.model.complete):
        return None
    selection = _select_both_ways(selection, reporter)
    gap = find_gap_less_gains(selection.model)
    worse = predicts_far_worse(gap, plain.model.held.gap)
    beyond = gap > thresholds.TORQUE_AS_MOTOR_GAP * plain.model.held.gap
    if worse and not begin.model.held.seen:
        worse = predicts_far_worse(gap, _find_gap_of_kept(plain))
    if worse and begin.model.held.seen and not beyond:  # a gap that was fitted is no prediction
        worse = begun.model.likelihood - selection.model.likelihood > likelihood_threshold()
    return None if worse else selection


def takes_place_of_motor(selection: Selection, plain: Selection) -> bool:
    """Decide whether what is left beside a torque leaves more than any torque should, where all was explained alone.

    Measured: of five stairs of a real motor a friction on a coasting bridge and a step of the load left 0.061 rad/s,
    and a drag 0.31 beside a torque that was left of a dead zone and a sag whose sizes were not determined.
    """
    gap = find_gap_less_gains(selection.model)
    return plain.complete and gap > thresholds.TORQUE_AS_MOTOR_GAP * plain.model.held.gap


def _find_gap_of_kept(plain: Selection) -> float:
    """Find the gap [rad/s] that findings leave which do not only stand in for something.

    Measured: a load and a coasting bridge left a third of the gap that a dead time and a limit left beside a torque,
    and stood in for those and a step of a load: neither was kept then, nor anything named.
    """
    return drop_stand_ins_of_either(plain, plain).model.held.gap


def _is_beyond_drive(model: Model) -> bool:
    """Decide whether a torque that was learned of seen motion is beyond all that was applied: it has lost the motion.

    Beside it anything is likelier. Measured: 20 V of 7.9 in four runs of one level each, beside which a load was
    likelier by 26; it left as much as there had been.
    """
    largest = max((float(np.max(np.abs(one.voltage))) for one in model.held.recordings), default=np.inf)
    return model.held.seen and model.errors.rms_voltage > largest


def _is_too_much(beside: Model, plain: Model) -> bool:
    """Decide whether a torque would leave more than is left, and stands for what was found down to the sensor's floor.

    Measured: 2.2 times as much, of half the supply over a third of a row, for a drag beside edges that were missed.
    """
    stands_in = set(beside.effects) < set(plain.effects)
    at_floor = plain.complete and not plain.above_floor
    return stands_in and at_floor and beside.held.gap < thresholds.RANDOM_GAP[0] * beside.noise_floor


def fits_slow_torque(selection: Selection, start: Selection) -> bool:
    """Decide whether a selection fits a slow torque instead of the motion.

    Of what both have seen, least squares leave the smallest gap, whatever the torque: there a model beside it is no
    worse for more than that, and is compared with the one to begin with beside it.
    """
    model, plain = selection.model, start.model
    lines = adds_only_lines(model, plain)
    if not fits_torque(model.held, plain.held, lines):
        return False
    if not (model.held.seen and model.beside_torque and not plain.beside_torque):
        return True
    if set(model.effects) == set(plain.effects):
        return False
    alike = begin_beside_torque(plain, start.hold_out, start.workers).model
    return fits_torque(model.held, alike.held, lines)


def list_hidden_by_torque(plain: Selection, beside: Selection) -> tuple[str, ...]:
    """List what was found alone, and its rivals, where a torque or gains that may be none take its place.

    Where the fits have seen all, a torque of which few courses fit into the motion follows what a friction or a load
    does between two levels of the command; and one that is faster than rows is what rows that are stamped wrong make.
    Gains of runs at one level each scatter as a friction makes them.
    """
    learned, held = beside.model.learned, plain.model.held
    if learned is None or beside.steps or not (plain.steps and held.seen):
        return ()
    if learned.gain > 0.0:  # what it leaves besides are the gains, however many were found
        names = {name for step in plain.steps for name in (step.found.effect, *step.rivals)}
        return sort_by_table(name for name in names if is_static(name))
    if not plain.model.complete or len(plain.steps) != 1 or _is_told(learned, held):
        return ()
    found = plain.steps[0]
    return (found.found.effect, *found.rivals)


def _is_told(torque: ErrorModel, held: HeldOut) -> bool:
    """Decide whether held-out motion tells a random torque: it is neither slower nor faster than that can show."""
    longest = max(float(np.ptp(data.time)) for data in held.intervals)
    row = float(np.median(np.concatenate([data.duration for data in held.intervals])))
    return row <= torque.correlation_time <= longest / thresholds.FEW_COURSES


def _choose_incomplete(found: list[Selection], plain: Selection) -> Selection | None:
    """Choose what was found beside a torque though structure is left, from wherever that was begun; None for the rest.

    Where what was found without one only stands in, if anything was, and unseen motion says that much is gone; or where
    no motor is found without one. Measured: one step between two levels of a bridge that coasts, after which a motor
    was 9 % slower by 20 % less, had a kv at the limit of the search; a coasting of 0.73 left a fifth of its gap.
    """
    if not found or not all(_have_same_effects(found[0], other) for other in found):
        return None
    if is_of_no_motor(plain.model) and not is_of_no_motor(found[0].model):
        return found[0]
    if plain.model.held.seen:
        return None
    halved = found[0].model.held.gap < thresholds.HALVED_GAP * plain.model.held.gap
    return found[0] if halved and not drop_stand_ins_of_either(plain, plain).steps else None


def _may_be_disturbed(plain: Selection) -> bool:
    """Decide whether a random torque may be in what was found, or left.

    A line of many waves is its own evidence; what comes back a few times, or happens once, slow torques do by chance.
    """
    effects = [EFFECT_BY_NAME[step.found.effect] for step in plain.steps]
    lines = [effect.name for effect in effects if effect.periodic and not effect.on_disc]
    line = any(count_waves(plain.model, name) > thresholds.MANY_WAVES for name in lines)
    once = any(effect.anywhere for effect in effects)
    return plain.model.above_floor or once or (plain.model.lasts and not line)


def _choose_more(selection: Selection, plain: Selection, disturbed: bool) -> Selection | None:
    """Choose what was selected beside a torque; where none disturbs, only if it takes away more than was found.

    Or takes its place, and is far likelier. Measured: of coarse speeds of a friction and a drag a limit of the voltage
    was found, at the floor, and both hid each other beside it; in its place they were likelier by 106.
    """
    if disturbed:
        return selection
    more = set(selection.model.effects) > set(plain.model.effects)
    takes = takes_away_more(selection.model, plain.model)
    return selection if takes and (more or _is_far_likelier(selection, plain)) else None


def _is_far_likelier(selection: Selection, plain: Selection) -> bool:
    """Decide whether what was selected beside a torque leaves less than what was found, and is likelier beside one."""
    if selection.model.held.gap >= plain.model.held.gap or not selection.steps:
        return False
    alike = begin_beside_torque(plain.model, plain.hold_out, plain.workers, plain.steps).model
    return selection.model.likelihood - alike.likelihood > pair_threshold()


def _select_both_ways(selection: Selection, reporter: ProgressReporter) -> Selection:
    """Eliminate backward what was selected beside a random torque, and select again where that changed what there is.

    What stood in for two effects hides both; what is found in its place may be one of them. What is added and taken
    away again goes round in a circle: what it was added to is left, with the rivals that were tried for it.
    """
    before = None
    for _ in range(thresholds.ROUNDS):
        left = eliminate_backward(selection, reporter)
        if _have_same_effects(left, selection):
            return left
        if before is not None and _have_same_effects(left, before):
            return before
        before, selection = left, select_forward(left, reporter)
        if _have_same_effects(selection, left):
            return selection
    return eliminate_backward(selection, reporter)


def _have_same_effects(one: Selection, other: Selection) -> bool:
    return set(one.model.effects) == set(other.model.effects)
