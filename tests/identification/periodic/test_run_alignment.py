"""Each run's slip and the wave that fits all runs; a slip has its price."""

import numpy as np
import pytest

from motor_identification.periodic.run_alignment import MOST_SLIP_STEPS, SLIP_STEP_PRICE, STEPS_PER_SLOT, align_runs

TURN = 0.7  # [rad] of the wave's phase to a slot
WAVE = 0.3 * np.exp(0.5j)


def sums_of(slips: list[float], strength: float = 60.0) -> np.ndarray:
    """What least squares needs to know of runs that saw the wave, each turned by its slip, without noise."""
    rows = []
    for slip in slips:
        here = WAVE * np.exp(1j * TURN * slip)
        rows.append([strength, 0.0, strength, strength * here.real, strength * here.imag])
    return np.array(rows)


@pytest.mark.parametrize("slips", [[0.0, 0.0, 0.0], [0.0, 1.0, 1.0], [0.0, -1.5, 2.0, 2.0], [0.0, 0.25, 0.5]])
def test_every_run_says_how_far_it_is_off(slips: list[float]) -> None:
    found = align_runs(sums_of(slips, 1e4), TURN)
    assert found.slips - found.slips[0] == pytest.approx(slips)
    assert abs(found.weight) == pytest.approx(abs(WAVE), rel=1e-9)
    powers = len(slips) * 1e4 * abs(WAVE) ** 2
    price = SLIP_STEP_PRICE * STEPS_PER_SLOT * np.abs(np.diff([0.0, *found.slips])).sum()
    assert found.explained == pytest.approx(powers - price, rel=1e-6)


@pytest.mark.parametrize(("times", "slipped"), [(0.9, False), (1.1, True)])
def test_a_slip_is_taken_if_it_explains_more_than_its_price(times: float, slipped: bool) -> None:
    """Two slots in one of two runs: it gains 2·A·|w|²·(1 − cos 2·turn), under the wave of the other."""
    price = SLIP_STEP_PRICE * 2 * STEPS_PER_SLOT
    gain = 2.0 * abs(WAVE) ** 2 * (1.0 - np.cos(2.0 * TURN))
    weak = times * price / gain
    sums = np.vstack([sums_of([0.0], 1e6), sums_of([2.0], weak)])
    found = align_runs(sums, TURN)
    assert (found.slips[1] - found.slips[0] > 1.0) == slipped


def test_no_run_slips_further_than_the_farthest() -> None:
    found = align_runs(sums_of([0.0, 30.0], 1e5), 0.01)
    assert np.abs(found.slips).max() <= MOST_SLIP_STEPS / STEPS_PER_SLOT


def test_runs_that_say_nothing_have_no_wave() -> None:
    found = align_runs(np.zeros((3, 5)), TURN)
    assert found.weight == 0.0 and not found.slips.any() and found.explained == 0.0


def test_where_nothing_is_counted_nothing_slips() -> None:
    """A measured speed has no slots: one wave fits all runs, with what least squares of their sums leave."""
    random = np.random.default_rng(2)
    responses, residual = random.normal(size=(3, 50, 2)), random.normal(size=(3, 50))
    sums = np.array(
        [[s @ s, s @ c, c @ c, s @ w, c @ w] for (s, c), w in zip(np.moveaxis(responses, -1, 1), residual, strict=True)]
    )
    found = align_runs(sums, 0.0)
    wave, left, *_ = np.linalg.lstsq(responses.reshape(-1, 2), residual.ravel(), rcond=None)
    assert (found.weight.real, found.weight.imag) == pytest.approx(tuple(wave))
    assert found.explained == pytest.approx(residual.ravel() @ residual.ravel() - left[0])
    assert not found.slips.any() and len(found.slips) == 3
