"""A made-up disc errs as one of the same share does, turn by turn."""

from math import tau
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from motor_identification.discrepancy.motion_history import MotionHistory
from motor_identification.discrepancy.rest import Rest, make_up_disc
from motor_identification.noise.error_data import ErrorData
from motor_identification.noise.error_model import ErrorModel
from motor_identification.noise.slots.first_harmonic import bound_chance_eccentricity


@pytest.mark.parametrize("slot", [tau / 96, 0.0])
def test_a_made_up_disc_errs_by_its_share_turn_by_turn(slot: float) -> None:
    count, share = 960, 0.01
    angle = (np.arange(count) + 0.2) * tau / 96
    history = SimpleNamespace(angle=angle, at_start=np.arange(count), at_end=np.arange(1, count + 1))
    errors = ErrorData(
        *(np.zeros(count),) * 6, tau / 96, 0.0, np.ones(count), np.ones(count, dtype=bool), np.ones(count)
    )  # type: ignore[arg-type]
    rest = Rest(
        errors, cast(MotionHistory, history), lambda: cast(MotionHistory, history), *(np.ones(1, bool),) * 2, slot
    )
    made = make_up_disc(rest, ErrorModel(share, 0.0, 0.0, 1.0)).errors.increments
    if slot == 0.0:
        assert not np.any(made)
        return
    assert made[:96] == pytest.approx(made[96:192], abs=1e-12)
    assert 0.8 < np.std(made) / (np.sqrt(2.0) * share * slot) < 1.2
    wave = 2.0 / 96 * abs(np.cumsum(made[:96]) @ np.exp(1j * angle[:96]))
    assert 0.3 < wave / bound_chance_eccentricity(slot, share) < 1.7
