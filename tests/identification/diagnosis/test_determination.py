"""What a recording determines nothing of is no finding."""

import numpy as np
import pytest
from diagnosed import fitted, with_effect
from plant import profiles, record

from motor_identification.diagnose import diagnose
from motor_identification.diagnosis.candidate_model import CandidateTest, validate_model
from motor_identification.diagnosis.determination import drop_undetermined, find_undetermined, is_undetermined
from motor_identification.diagnosis.forward_selection import Selection, SelectionStep
from motor_identification.diagnosis.result import Verdict
from motor_identification.recording import check
from motor_model.parameters import PAPER_KA, PAPER_KV


@pytest.mark.parametrize(
    ("effect", "unknown", "undetermined"),
    [
        ("load_step", ("step_voltage",), True),  # the instant is the recording's
        ("load_step", ("step_time",), False),
        ("backlash", ("backlash_angle",), False),
        ("backlash", ("backlash_angle", "load_fraction"), False),  # each is unsure because the other is
        ("transport_delay", ("delay",), True),
        ("coulomb_friction", ("kv", "ka"), False),
    ],
)
def test_an_effect_is_undetermined_where_its_one_parameter_is(
    effect: str, unknown: tuple[str, ...], undetermined: bool
) -> None:
    assert is_undetermined(effect, unknown) == undetermined


def test_a_friction_that_motion_both_ways_determines_stays() -> None:
    estimate, hold_out = fitted(ks=0.4)
    after = validate_model(hold_out, with_effect(estimate, "coulomb_friction", {"ks": 0.3}))
    before = validate_model(hold_out, estimate)
    assert find_undetermined(after) == () and find_undetermined(before) == ()
    test = CandidateTest("coulomb_friction", before, after)
    selection = Selection((SelectionStep(before, test, (test,), (), 1.0),), after, hold_out, 1)
    assert drop_undetermined(selection) == (selection, ())


def test_what_a_recording_does_not_determine_is_dropped_and_named() -> None:
    """An inductance that is not there."""
    estimate, hold_out = fitted()
    before = validate_model(hold_out, estimate)
    after = validate_model(hold_out, with_effect(estimate, "armature_inductance", {"electrical_time_constant": 1e-6}))
    test = CandidateTest("armature_inductance", before, after)
    selection = Selection((SelectionStep(before, test, (test,), (), 1.0),), after, hold_out, 1)
    left, names = drop_undetermined(selection)
    assert names == ("armature_inductance",) and left.steps == () and left.model.effects == ()
    assert left.model.held.gap == pytest.approx(before.held.gap, rel=1e-6)


def test_a_single_step_says_what_may_be_missing_and_no_size() -> None:
    """One way, one level, friction and a load that comes: nothing of either can be told from the gain."""
    values = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.5}
    recording = check(record(values, *profiles.step(9.0), seed=3)[0])
    found = diagnose([recording])
    assert found.verdict is Verdict.UNDECIDED
    for finding in found.findings:
        assert any(np.isfinite(sigma) for _, sigma in finding.parameters.values())
