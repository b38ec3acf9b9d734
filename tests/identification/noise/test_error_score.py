"""The score of increments: what the filter gives, whatever is in a recording."""

from dataclasses import replace

import numpy as np
import pytest

from motor_identification.noise.error_data import ErrorData
from motor_identification.noise.error_model import ErrorModel, Lag

LAG = Lag(12.0, 0.0055)
MODEL = ErrorModel(0.01, 0.0, 0.15, 0.05)
SLOT = 0.06  # [rad]


def rows(counted: np.ndarray) -> ErrorData:
    """Twenty intervals of 10 ms, then one in which the motor stands, and after pauses twenty more."""
    still, number = np.arange(41) == 20, np.arange(41)
    pause = np.select([number == 0, number == 21, number == 30, number == 35], [np.inf, 0.5, 20.0, 0.0], 0.0)
    return ErrorData(
        fresh=np.isin(number, [0, 20, 21, 30, 35]),
        still=still,
        pause=pause,
        duration=np.where(still, 0.5, 0.01 + 1e-4 * (number % 3)),
        blur=np.full(41, 1e-5),
        slack=np.where(still, SLOT, 0.0),
        unit=SLOT,
        window=0.0,
        increments=1e-3 * np.random.default_rng(3).normal(size=41),
        counted=counted,
        travel=np.where(still, 0.0, 0.09),
    )


@pytest.mark.parametrize("model", [MODEL, ErrorModel(0.01, 0.0, 0.0, 1.0), ErrorModel(0.001, 1e-5, 0.0, 1.0)])
@pytest.mark.parametrize("window", [0.0, 0.01])
def test_a_score_is_the_likelihood_that_the_filter_gives(model: ErrorModel, window: float) -> None:
    """Beside a torque and without one; with outliers, a standstill and a pause; of many intervals, too."""
    outliers = np.where(np.arange(41) % 7 == 3, 0.03, 0.0)
    data = replace(rows(np.arange(41) % 5 != 0), window=window)
    data = replace(data, increments=data.increments + outliers)
    assert data.score(model, LAG) == pytest.approx(data.whiten(model, LAG)[0], rel=1e-12)
    again = 200  # the variances' product leaves the range of a float many times
    many = ErrorData(
        *(np.tile(column, again) for column in (data.fresh, data.still, data.pause, data.duration, data.blur)),
        np.tile(data.slack, again), data.unit, window, np.tile(data.increments, again), np.tile(data.counted, again),
        np.tile(data.travel, again),
    )  # fmt: skip
    assert many.score(model, LAG) == pytest.approx(many.whiten(model, LAG)[0], rel=1e-12)
