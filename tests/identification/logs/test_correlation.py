"""Correlation of columns of any size."""

import numpy as np
import pytest

from motor_identification.logs.correlation import correlate

ONE = np.array([0.0, 1.0, 3.0, 2.0, 5.0, 4.0])
OTHER = np.array([1.0, 0.5, 4.0, 2.0, 3.0, 6.0])


@pytest.mark.parametrize("size", [1.0, -1.0, 1e-300, 1e300])
@pytest.mark.filterwarnings("error")
def test_it_is_pearsons_whatever_the_sizes(size: float) -> None:
    expected = np.sign(size) * np.corrcoef(ONE, OTHER)[0, 1]
    assert correlate(ONE * size, OTHER) == pytest.approx(expected, abs=1e-12)
    assert correlate(ONE, OTHER * size) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("flat", [0.0, 7.0, 1e308, np.inf, np.nan])
@pytest.mark.filterwarnings("error")
def test_what_does_not_change_or_has_no_size_goes_with_nothing(flat: float) -> None:
    assert correlate(np.full(6, flat), OTHER) == correlate(OTHER, np.full(6, flat)) == 0.0
    assert correlate(np.array([flat, *[1e308, -1e308] * 2, 1e308]), OTHER) == pytest.approx(0.0, abs=0.6)
