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
    found = align_runs(sums_of(slips, 1e4), TURN, False)
    assert (found.slips - found.slips[0]) / TURN == pytest.approx(slips)
    assert abs(found.weight) == pytest.approx(abs(WAVE), rel=1e-9)
    powers = len(slips) * 1e4 * abs(WAVE) ** 2
    price = SLIP_STEP_PRICE * STEPS_PER_SLOT * np.abs(np.diff([0.0, *found.slips])).sum() / TURN
    assert found.explained == pytest.approx(powers - price, rel=1e-6)


@pytest.mark.parametrize(("times", "slipped"), [(0.9, False), (1.1, True)])
def test_a_slip_is_taken_if_it_explains_more_than_its_price(times: float, slipped: bool) -> None:
    """Two slots in one of two runs: it gains 2·A·|w|²·(1 − cos 2·turn), under the wave of the other."""
    price = SLIP_STEP_PRICE * 2 * STEPS_PER_SLOT
    gain = 2.0 * abs(WAVE) ** 2 * (1.0 - np.cos(2.0 * TURN))
    weak = times * price / gain
    sums = np.vstack([sums_of([0.0], 1e6), sums_of([2.0], weak)])
    found = align_runs(sums, TURN, False)
    assert (found.slips[1] - found.slips[0] > TURN) == slipped


def test_no_run_slips_further_than_the_farthest() -> None:
    found = align_runs(sums_of([0.0, 30.0], 1e5), 0.01, False)
    assert np.abs(found.slips).max() <= 0.01 * MOST_SLIP_STEPS / STEPS_PER_SLOT


def test_runs_that_say_nothing_have_no_wave() -> None:
    for turn, told in ((TURN, False), (0.0, True), (0.0, False)):
        found = align_runs(np.zeros((3, 5)), turn, told)
        assert found.weight == 0.0 and not found.slips.any() and found.explained == 0.0


def test_where_all_is_counted_nothing_slips() -> None:
    """One wave fits all runs, with what least squares of their sums leave."""
    random = np.random.default_rng(2)
    responses, residual = random.normal(size=(3, 50, 2)), random.normal(size=(3, 50))
    sums = np.array(
        [[s @ s, s @ c, c @ c, s @ w, c @ w] for (s, c), w in zip(np.moveaxis(responses, -1, 1), residual, strict=True)]
    )
    found = align_runs(sums, 0.0, True)
    wave, left, *_ = np.linalg.lstsq(responses.reshape(-1, 2), residual.ravel(), rcond=None)
    assert (found.weight.real, found.weight.imag) == pytest.approx(tuple(wave))
    assert found.explained == pytest.approx(residual.ravel() @ residual.ravel() - left[0])
    assert not found.slips.any() and len(found.slips) == 3


def test_speeds_have_a_phase_in_every_run() -> None:
    """What was summed up from them is lost from run to run: any turn of the wave, and one size."""
    slips = [0.0, 2.0, -3.1, 1.4]
    found = align_runs(sums_of(slips, 1e4), 0.0, False)
    assert np.exp(1j * (found.slips - found.slips[0])) == pytest.approx(np.exp(1j * TURN * np.array(slips)))
    assert abs(found.weight) == pytest.approx(abs(WAVE), rel=2e-3)  # less what noise would be of it
    assert found.explained == pytest.approx(4e4 * abs(WAVE) ** 2, rel=1e-4)
    assert align_runs(sums_of(slips, 1e4), 0.0, True).explained < 0.3 * found.explained  # had it been told


def test_a_phase_in_every_run_is_no_wave_in_noise() -> None:
    """Of white noise of a variance of 1: every run has its own phase, and together they are hardly a wave."""
    random = np.random.default_rng(4)
    strength = 200.0
    explained = []
    for _ in range(300):
        noise = np.sqrt(strength) * random.standard_normal((6, 2))
        sums = np.column_stack([np.tile([strength, 0.0, strength], (6, 1)), noise])
        explained.append(align_runs(sums, 0.0, False).explained)
    assert 0.0 <= np.median(explained) < 6.0 < np.quantile(explained, 0.9) < 3.0 * 6.0
