"""The contaminated density is one, is the mixture that it is called, and trust is its regular part."""

import numpy as np
import pytest
from scipy.integrate import trapezoid
from scipy.stats import cauchy, norm

from motor_identification.noise.contaminated_density import OUTLIERS, WIDTH, compute_log_density, compute_trust

VARIANCE = 4e-6  # [rad²]
SIGMA = VARIANCE**0.5


def parts(off: float) -> tuple[float, float]:
    """The regular and the other part of the mixture."""
    return (1.0 - OUTLIERS) * norm.pdf(off, scale=SIGMA), OUTLIERS * cauchy.pdf(off, scale=WIDTH * SIGMA)


@pytest.mark.parametrize("times", [0.0, 2.9, 3.1, 5.0, 40.0, 1e4])
def test_it_is_the_mixture(times: float) -> None:
    regular, other = parts(times * SIGMA)
    log_density = compute_log_density(times * SIGMA, VARIANCE)
    assert log_density == pytest.approx(np.log(regular + other), abs=1e-3 if times < 3.0 else 1e-12)
    assert compute_log_density(-times * SIGMA, VARIANCE) == log_density


def test_it_adds_up_to_one() -> None:
    off = SIGMA * np.sinh(np.linspace(-14.0, 14.0, 40_001))
    density = np.exp([compute_log_density(each, VARIANCE) for each in off])
    assert trapezoid(density, off) == pytest.approx(1.0, abs=0.3 * OUTLIERS)


@pytest.mark.parametrize("times", [3.1, 4.0, 4.5, 6.0, 100.0])
def test_trust_is_the_share_of_the_regular_part(times: float) -> None:
    regular, other = parts(times * SIGMA)
    assert compute_trust(times * SIGMA, VARIANCE) == pytest.approx(regular / (regular + other), rel=1e-12)


def test_what_is_within_three_standard_deviations_is_trusted_in_full() -> None:
    assert compute_trust(2.999 * SIGMA, VARIANCE) == 1.0 > compute_trust(3.001 * SIGMA, VARIANCE) > 0.99
