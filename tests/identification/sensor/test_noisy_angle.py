"""Angles with noise are told from counts of edges, and are fitted as what they are."""

import numpy as np
import pytest
from recorded import as_counts
from servo import AXIS, record_servo
from swinging import recorded

from motor_identification.identify import Request, identify
from motor_identification.measurement.build_intervals import make_intervals
from motor_identification.sensor.noisy_angle import find_angle_noise


@pytest.mark.parametrize(("noise", "scale"), [(1e-6, 5e-8), (1e-4, 1e-4), (3e-5, 1e-5)])
def test_the_noise_is_found_and_the_motor_with_it(noise: float, scale: float) -> None:
    recording, _ = record_servo(duration=10.0, noise=noise, scale=scale)
    expected = np.hypot(noise / scale, 12.0**-0.5)
    assert find_angle_noise(recording) == pytest.approx(expected, rel=0.1)
    data = make_intervals(recording)
    assert len(data.first) == len(recording) - 1 and data.blur == pytest.approx(expected * scale, rel=0.1)
    fit = identify([recording], Request(("coulomb_friction", "load_bias")))
    for name, value in AXIS.items():
        error = fit.standard_errors[name]
        assert abs(fit.parameters.values[name] - value) < max(4.0 * error, 0.02 * value)
        assert error < 0.15 * value


def test_counts_of_edges_have_none() -> None:
    assert find_angle_noise(record_servo(duration=10.0)[0]) == 0.0
    for edges in (96, 960):
        assert find_angle_noise(as_counts(recorded(edges=edges, sample_rate=200.0))) == 0.0


def test_a_shaft_that_trembles_on_an_edge_has_none() -> None:
    counted = as_counts(recorded(sample_rate=200.0))
    trembling = counted.at_rows(np.arange(1000))
    count = np.arange(1000) % 2
    assert find_angle_noise(type(trembling)(**{**trembling.__dict__, "edge_count": count})) == 0.0
    many = np.random.default_rng(0).normal(0.0, 3.0, 1000).round().astype(np.int64)
    assert find_angle_noise(type(trembling)(**{**trembling.__dict__, "edge_count": many})) > 2.5
