"""The spectrum of many numbers of cycles in one pass is what each of them alone makes."""

import numpy as np
from periodic_course import course

from motor_identification.periodic.response_products import CYCLES_TOGETHER, sum_products


def test_a_spectrum_is_the_products_with_every_response() -> None:
    seen, random = course(400, 1), np.random.default_rng(2)
    cycles = np.arange(1.0, 5.0, 1.0 / 32.0)[: 2 * CYCLES_TOGETHER + 5]
    pull, block = random.normal(size=400), random.integers(0, 6, 400)
    along, across = (np.concatenate(parts) for parts in zip(*sum_products(seen, pull, cycles, block), strict=True))
    assert along.shape == across.shape == (len(cycles), 6)
    for i, number in enumerate(cycles):
        for found, response in zip((along[i], across[i]), seen.response(float(number)), strict=True):
            expected = np.bincount(block, pull * response, 6)
            assert np.abs(found - expected).max() < 1e-10 * np.abs(expected).max() + 1e-15
