"""A finding that may stand in for what is outside the table, selected beside a random torque."""

from motor_identification.diagnosis.candidate_fit import refit_without
from motor_identification.diagnosis.candidate_test import CandidateTest
from motor_identification.diagnosis.selection.selection import Selection, SelectionStep, begin_beside_torque
from motor_identification.diagnosis.start import fit_known
from motor_identification.estimation.request import Request
from motor_identification.recording import Recording
from motor_identification.validation.hold_out import make_hold_out


def select_beside_friction(recording: Recording, effect: str) -> Selection:
    """Select one effect beside a friction and a random torque; the step says what the model is without it."""
    hold_out = make_hold_out([recording], [])
    known, _search = fit_known([recording], Request(effects=("coulomb_friction", effect)), hold_out)
    model = begin_beside_torque(known.model, known.hold_out, 1).model
    without = refit_without(model, effect, known.hold_out)
    test = CandidateTest(effect, without, model)
    return Selection((SelectionStep(without, test, (test,), (), 1.0),), model, known.hold_out, 1)


def is_taken_back(selection: Selection) -> bool:
    """Decide whether a selection has nothing left, because its finding stood in for something; else it has all."""
    if selection.steps:
        assert len(selection.steps) == 1 and selection.outside is None
        return False
    assert selection.outside is not None and not selection.complete
    return True
