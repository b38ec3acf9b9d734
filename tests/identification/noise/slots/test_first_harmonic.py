"""Random slots have a first harmonic by chance, of the size that the formula says."""

from math import sqrt, tau

import numpy as np
import pytest

from motor_identification.noise.slots.first_harmonic import CHANCE_HARMONIC, bound_chance_eccentricity


def test_the_bound_is_five_standard_deviations_of_random_discs() -> None:
    """Measured on random discs of 96 slots, the standard deviation of the first harmonic's sine and cosine."""
    slot, share = tau / 96, 0.01
    discs = np.random.default_rng(0).normal(0.0, share * slot, (2000, 96))
    waves = discs @ np.exp(1j * slot * np.arange(96)) * 2.0 / 96
    chance = share * slot * sqrt(2.0 / 96)
    assert np.std([waves.real, waves.imag]) == pytest.approx(chance, rel=0.03)
    assert bound_chance_eccentricity(slot, share) == pytest.approx(CHANCE_HARMONIC * chance)
    assert np.mean(np.abs(waves) > 0.4 * bound_chance_eccentricity(slot, share)) == pytest.approx(
        np.exp(-2.0), abs=0.02
    )
    assert not np.any(np.abs(waves) > bound_chance_eccentricity(slot, share))


@pytest.mark.parametrize(("share", "least"), [(0.0, 1e-4), (0.9e-4, 1e-4), (1.1e-4, 1.1e-4)])
def test_no_disc_is_more_even_than_a_ten_thousandth_of_a_slot(share: float, least: float) -> None:
    """Of six slots what is left beside a first harmonic is little, by chance."""
    slot = tau / 6
    assert bound_chance_eccentricity(slot, share) == pytest.approx(5.0 * least * slot * sqrt(2.0 / 6))
    assert bound_chance_eccentricity(0.0, share) == 0.0
