"""Selections of made-up steps: what is done with findings is tested on, without a diagnosis that made them."""

from diagnosed import fitted
from stub_models import stub_model, stub_test

from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import CandidateTest
from motor_identification.diagnosis.selection.selection import Selection, SelectionStep


def selection_of(model: Model, *steps: SelectionStep) -> Selection:
    """A selection that ended with a model, after these steps."""
    _, hold_out = fitted()
    return Selection(steps, model, hold_out, 1)


def stub_selection(gap: float, *steps: SelectionStep) -> Selection:
    """A selection that ended with a model of this gap, of which nothing lasts."""
    return selection_of(stub_model(gap, 0.0), *steps)


def step_of(found: CandidateTest, *others: CandidateTest, explains: float = 0.5) -> SelectionStep:
    """A step that took one of these tests."""
    return SelectionStep(found.before, found, (found, *others), (), explains)


def stub_step(effect: str, explains: float) -> SelectionStep:
    """A step that found an effect, which explains this share of the gap's excess."""
    return step_of(stub_test(effect, stub_model(9.0), 5.0, 100.0), explains=explains)
