"""Select which effects are missing, all steps in their order, or the best so far once the time is used up."""

from dataclasses import dataclass

from motor_identification.diagnosis.candidate_test import predicts_far_worse
from motor_identification.diagnosis.effect_test import sort_by_table
from motor_identification.diagnosis.evidence.static_evidence import find_untold, is_told_alone
from motor_identification.diagnosis.run_gains import find_gap_less_gains
from motor_identification.diagnosis.selection.backward_elimination import eliminate_backward
from motor_identification.diagnosis.selection.determination import drop_undetermined, drop_undetermined_at_once
from motor_identification.diagnosis.selection.forward_selection import select_forward
from motor_identification.diagnosis.selection.restarts import (
    begin_from_kindred,
    retry_with_another_first,
    retry_with_dependent,
    retry_with_pair,
)
from motor_identification.diagnosis.selection.rivals import check_beside_torque
from motor_identification.diagnosis.selection.selection import Selection
from motor_identification.diagnosis.selection.shared_sizes import doubt_shared_sizes
from motor_identification.diagnosis.selection.stand_ins import (
    doubt_instants,
    drop_stand_ins,
    drop_stand_ins_of_either,
    keep_confirmed,
)
from motor_identification.diagnosis.selection.torque_selection import (
    fits_slow_torque,
    list_hidden_by_torque,
    select_beside_torque,
    takes_place_of_motor,
)
from motor_identification.progress import ProgressReporter, Stopped, TimeLimit


@dataclass(frozen=True)
class Selected:
    """What was selected, and whether there was time to finish."""

    selection: Selection
    undetermined: tuple[str, ...]  # effects one of which may be missing
    finished: bool

    @property
    def effects(self) -> tuple[str, ...]:
        """What the model has."""
        return self.selection.model.effects


def select_in_time(start: Selection, reporter: ProgressReporter, limit: TimeLimit[Selection]) -> Selected:
    """Select what is missing, or return the best selection so far once the time is used up."""
    try:
        selected = Selected(*select(start, reporter), finished=True)
    except Stopped:
        return select_best(limit)
    limit.done = True
    return selected


def select_best(limit: TimeLimit[Selection]) -> Selected:
    """Select the best so far, where the time is used up.

    Raises:
        Stopped: it is not, or there is none: the caller wanted an end.
    """
    if not limit.reached or limit.best is None:
        raise Stopped("the diagnosis was stopped.")
    limit.done = True  # what is left is to say it
    return Selected(drop_undetermined_at_once(drop_stand_ins(limit.best)), (), finished=False)


def select(start: Selection, reporter: ProgressReporter) -> tuple[Selection, tuple[str, ...]]:
    """Select what is missing, and what is undetermined; from the first effect's kindred where that leaves structure.

    What is outside the table leaves structure from wherever a selection begins. Measured: of a friction, a dead zone
    and a sag the friction alone did the dead zone's work, and 24 % of what was left could be predicted; begun from the
    dead zone all three were found, beside which the rest was the torque that was there.
    """
    first = select_forward(start, reporter)
    plain = retry_with_pair(retry_with_another_first(first, reporter), reporter)
    plain = retry_with_dependent(plain, reporter)
    selected = _select_from(start, start, first, plain, reporter)
    if selected[1] or not _leaves_structure(selected[0]):
        return selected
    for begun in begin_from_kindred(first):
        other = select_forward(begun, reporter, pairs=False)
        again, undetermined = _select_from(start, begun, other, other, reporter)
        worse = predicts_far_worse(find_gap_less_gains(again.model), first.model.held.gap)
        if again.steps and again.complete and not (undetermined or worse):
            return again, undetermined
    return selected


def _leaves_structure(selection: Selection) -> bool:
    return not selection.complete and any(one.certain for one in selection.structure)


def _select_from(
    start: Selection, begun: Selection, first: Selection, plain: Selection, reporter: ProgressReporter
) -> tuple[Selection, tuple[str, ...]]:
    """Select on from what was found without a random torque, beside one where there is one; and what is undetermined.

    begun: what begins beside the torque where `plain` leads nowhere there. What leaves far more in the end than was
    left without a torque has learned one in the place of the motor, as has a selection on the way.
    """
    reporter.report("checking", 0.9, "", plain.model.held.gap)
    beside = select_beside_torque(begun, plain, reporter)
    selected = _conclude(start, first, plain, beside, reporter)
    if beside is not None and selected[0].steps and takes_place_of_motor(selected[0], plain):
        return _conclude(start, first, plain, None, reporter)
    return selected


def _conclude(
    start: Selection, first: Selection, plain: Selection, beside: Selection | None, reporter: ProgressReporter
) -> tuple[Selection, tuple[str, ...]]:
    """Eliminate backward, and drop what is undetermined: of what was found beside a random torque, if that was."""
    selection = plain
    if beside is None:
        selection = eliminate_backward(drop_stand_ins_of_either(first, selection), reporter)
        if selection.model.complete and selection.model.above_floor:
            selection = check_beside_torque(selection, reporter)
    elif beside.steps and fits_slow_torque(beside, start):
        selection = eliminate_backward(keep_confirmed(selection, beside.model.effects), reporter)
    else:
        selection = beside
    left, undetermined = drop_undetermined(selection, reporter)
    left = doubt_shared_sizes(doubt_instants(left))
    if selection is beside:
        undetermined = undetermined or list_hidden_by_torque(plain, beside)
    if untold := set(find_untold(left.model)) - set(start.model.effects):
        if selection is beside and is_told_alone(plain.model, left.model):
            return drop_undetermined(plain, reporter)
        return start, sort_by_table(untold | set(undetermined))
    # What is left of a model that fits a slow torque instead of the motion tells less than the one to begin with.
    return start if fits_slow_torque(left, start) else left, undetermined
