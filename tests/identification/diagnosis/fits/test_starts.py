"""Where a fit with one effect more begins: at every combination of its start values, the rest as it was."""

import numpy as np
import pytest
from diagnosed import fitted

from motor_identification.diagnosis.fits.effect_fit import fit_with_effect
from motor_identification.diagnosis.fits.starts import list_starts, start_with
from motor_identification.estimation.estimate import Estimate
from motor_model.effects import EFFECT_BY_NAME


@pytest.mark.parametrize(("effect", "starts"), [("coulomb_friction", 1), ("transport_delay", 4), ("load_step", 10)])
def test_starts_are_every_combination_of_the_tables(effect: str, starts: int) -> None:
    estimate, _ = fitted()
    larger = estimate.problem.with_effects((effect,))
    thetas = [one.theta for one in list_starts(estimate, larger)]
    sizes = [len(spec.starts) for spec in EFFECT_BY_NAME[effect].parameters]
    assert len(thetas) == starts == np.prod(sizes) and len({tuple(theta) for theta in thetas}) == starts
    for theta in thetas:
        assert np.all(theta >= larger.unknowns.low) and np.all(theta <= larger.unknowns.high)
        assert np.array_equal(theta[:2], estimate.theta)  # the motor as it was


def test_a_breakaway_starts_above_the_friction_that_is_there() -> None:
    estimate, _ = fitted(ks=0.4)
    sliding = fit_with_effect(estimate, "coulomb_friction")
    assert sliding is not None
    larger = sliding.problem.with_effects(("coulomb_friction", "static_friction"))
    names = larger.unknowns.names
    for _, theta in list_starts(sliding, larger):
        assert theta[names.index("breakaway_voltage")] > theta[names.index("ks")] + 0.1


def test_sizes_of_ones_own_can_be_said() -> None:
    estimate, _ = fitted()
    larger = estimate.problem.with_effects(("quadratic_drag",))
    begun = Estimate(larger, start_with(estimate, larger, {"drag": 1e-5}))
    assert begun.parameters.values["drag"] == pytest.approx(1e-5) and np.isfinite(begun.theta).all()
