"""What chance may have given is told from what is there: a size, an instant, a line, a limit."""

from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from diagnosed import fitted, with_effect
from stub_models import same_errors

from motor_identification.diagnosis import candidate_model, thresholds
from motor_identification.diagnosis.candidate_fit import validate_model
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.selection import chance as chance_of
from motor_identification.diagnosis.selection.chance import (
    find_blindness,
    has_vague_instant,
    is_chance_size,
    may_never_limit,
)
from motor_identification.diagnosis.selection.determination import find_undetermined
from motor_identification.estimation.whitened_fit import WhitenedFit
from motor_identification.measurement.time_blocks import TimeBlocks, compute_block_length


@pytest.mark.parametrize(
    ("effect", "values"),
    [
        ("load_step", {"step_voltage": 0.1, "step_time": 0.3}),
        ("coulomb_friction", {"ks": 0.3}),
        ("transport_delay", {"delay": 1.5e-3}),
    ],
)
@pytest.mark.parametrize(("sigma", "chance"), [(0.99, True), (1.01, False)])
def test_a_size_within_its_errors_is_chance(
    monkeypatch: pytest.MonkeyPatch, effect: str, values: dict[str, float], sigma: float, chance: bool
) -> None:
    estimate, hold_out = fitted()
    model = validate_model(hold_out, with_effect(estimate, effect, values))
    at = model.whitened.problem.unknowns.names.index(next(iter(values)))
    errors = np.full(len(model.whitened.theta), abs(model.whitened.theta[at]) / (sigma * thresholds.SURE_SIZE))
    monkeypatch.setattr(candidate_model, "estimate_uncertainty", lambda *_: SimpleNamespace(errors=errors))
    assert is_chance_size(effect, model) == chance


@pytest.mark.parametrize(("sigma", "chance"), [(0.99, True), (1.01, False), (None, True)])
def test_what_a_fit_beside_the_torque_is_sure_of_is_no_chance(sigma: float | None, chance: bool) -> None:
    """By encoders alone its size is one standard error; None: more than a random torque is left."""
    estimate, hold_out = fitted()
    model = validate_model(hold_out, with_effect(estimate, "coulomb_friction", {"ks": 0.3}))
    size = model.whitened.theta[2]
    told = None if sigma is None else (model.whitened, same_errors(size / (sigma * thresholds.SURE_BESIDE_TORQUE)))
    stub = SimpleNamespace(
        whitened=model.whitened, held=model.held, uncertainty=same_errors(size), told_beside_torque=told
    )
    assert is_chance_size("coulomb_friction", cast(Model, stub)) is chance


@pytest.mark.parametrize("block", range(4, 8))
def test_an_instant_in_what_no_fit_may_see_is_placed_no_better(block: int) -> None:
    """A load step came there: no fit sees when, and what was before and after tells its size."""
    estimate, _ = fitted()
    problem = estimate.problem.keeping_out(TimeBlocks(4, stretch=2.0))
    length = compute_block_length(problem.intervals[0], problem.sample_period, 2.0)
    assert length > thresholds.VAGUE_INSTANT * problem.recordings[0].duration
    fit, hidden = (
        with_effect(estimate.on(problem), "load_step", {"step_voltage": 0.3, "step_time": 1.0}),
        block % 4 == 3,
    )
    at = fit.problem.unknowns.names.index("step_time")
    fit.theta[at] = (block + 0.5) * length
    assert find_blindness(cast(WhitenedFit, fit), at) == (length if hidden else 0.0)
    for share, vague in ((0.99, not hidden), (1.01, True)):
        errors = np.full(len(fit.theta), share * length)
        model = cast(Model, SimpleNamespace(whitened=fit, uncertainty=SimpleNamespace(errors=errors)))
        assert has_vague_instant("load_step", model) is vague


def test_an_instant_that_one_of_several_recordings_places_is_one(monkeypatch: pytest.MonkeyPatch) -> None:
    errors = np.array([0.9, 1.1]) * thresholds.VAGUE_INSTANT
    known = SimpleNamespace(errors=errors)
    model = cast(
        Model, SimpleNamespace(whitened=SimpleNamespace(problem=SimpleNamespace(kept_out=None)), uncertainty=known)
    )
    monkeypatch.setattr(chance_of, "list_instant_columns", lambda *_: [(0, 1.0), (1, 1.0)])
    assert not has_vague_instant("load_step", model)
    errors[0] = errors[1]
    assert has_vague_instant("load_step", model)


@pytest.mark.parametrize(
    ("effect", "values", "chance"),
    [
        ("torque_ripple", {"ripple_voltage": 0.4, "ripple_cycles": 34.5, "ripple_phase": 0.5}, True),
        ("load_step", {"step_voltage": 0.1, "step_time": 0.3}, False),  # which all that it has is asked of
    ],
)
def test_a_line_of_unknown_size_is_chance(
    monkeypatch: pytest.MonkeyPatch, effect: str, values: dict[str, float], chance: bool
) -> None:
    """How often it comes back is determined of any line."""
    estimate, hold_out = fitted()
    model = validate_model(hold_out, with_effect(estimate, effect, values))
    errors = np.full(len(model.whitened.theta), np.nan)
    monkeypatch.setattr(candidate_model, "estimate_uncertainty", lambda *_: SimpleNamespace(errors=errors))
    assert is_chance_size(effect, model) == chance


@pytest.mark.parametrize(
    ("effect", "values"),
    [("armature_inductance", {"electrical_time_constant": 1e-6}), ("voltage_limit", {"limit_voltage": 11.0})],
)
def test_what_has_no_size_is_there_or_not(
    monkeypatch: pytest.MonkeyPatch, effect: str, values: dict[str, float]
) -> None:
    estimate, hold_out = fitted()
    model = validate_model(hold_out, with_effect(estimate, effect, values))
    monkeypatch.setattr(candidate_model, "estimate_uncertainty", lambda *_: pytest.fail("its error was asked for"))
    assert not is_chance_size(effect, model)


@pytest.mark.parametrize(
    ("errors", "limits"),  # the standard error, in what is between the limit and the largest command
    [(0.99 / thresholds.SURE_SIZE, True), (1.01 / thresholds.SURE_SIZE, False), (np.nan, True)],
)
def test_a_limit_that_may_lie_beyond_all_commands_is_chance(
    monkeypatch: pytest.MonkeyPatch, errors: float, limits: bool
) -> None:
    """One of 1.46 ± 0.04 V was said to be missing in a motor of 1.5 V that has none."""
    estimate, hold_out = fitted(limit_voltage=10.8)
    model = validate_model(hold_out, with_effect(estimate, "voltage_limit", {"limit_voltage": 10.8}))
    fit, most = model.whitened, max(float(np.abs(one.voltage).max()) for one in estimate.problem.recordings)
    below = most - fit.theta[fit.problem.unknowns.names.index("limit_voltage")]
    known = SimpleNamespace(errors=np.full(len(fit.theta), errors * below), not_identifiable=())
    monkeypatch.setattr(candidate_model, "estimate_uncertainty", lambda *_: known)
    assert may_never_limit("voltage_limit", model) is not limits and not may_never_limit("coulomb_friction", model)
    assert find_undetermined(model) == (() if limits else ("voltage_limit",))
