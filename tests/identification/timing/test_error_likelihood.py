"""Errors of speeds are judged with heavy tails, a share of the error before, and a scale that grows with the speed."""

import numpy as np
import pytest
from scipy.stats import t as student

from motor_identification.timing import error_likelihood
from motor_identification.timing.error_likelihood import FREEDOM, measure_log_likelihood

RANDOM = np.random.default_rng(7)
SPEED = RANDOM.uniform(-100.0, 100.0, 2000)


def test_it_is_that_of_students_t() -> None:
    """Up to a constant that depends on their number only, and on the scale that was fitted."""
    errors = student(FREEDOM).rvs(2000, random_state=1)
    constant = student(FREEDOM).logpdf(errors[1:]).sum() - measure_log_likelihood(errors, np.ones(2000))
    other = 3.0 * student(FREEDOM).rvs(2000, random_state=2)
    expected = student(FREEDOM, scale=3.0).logpdf(other[1:]).sum() - constant
    assert measure_log_likelihood(other, np.ones(2000)) == pytest.approx(expected, abs=4.0)


def test_a_few_rows_that_are_far_off_do_not_decide() -> None:
    """In squares, 3 of 2,000 rows that are off by 60 were more than a tenth less noise in all others."""
    better = RANDOM.standard_normal(2000)
    worse = 1.1 * better
    better[[300, 900, 1500]] = 60.0
    assert np.sum(better**2) > 3.0 * np.sum(worse**2)
    assert measure_log_likelihood(better, SPEED) > measure_log_likelihood(worse, SPEED) + 50.0


def test_errors_that_are_a_share_of_the_speed_tell_by_the_slow_ones(monkeypatch: pytest.MonkeyPatch) -> None:
    noise = RANDOM.standard_normal(2000) * np.hypot(0.02, 0.014 * SPEED)
    late = noise + np.where(np.abs(SPEED) < 20.0, 0.3, 0.0)
    gain = measure_log_likelihood(noise, SPEED) - measure_log_likelihood(late, SPEED)
    assert gain > 100.0
    monkeypatch.setattr(error_likelihood, "GROWTHS", (0.0,))
    assert measure_log_likelihood(noise, SPEED) - measure_log_likelihood(late, SPEED) < 0.2 * gain


def test_what_an_error_shares_with_the_one_before_is_no_news() -> None:
    news = RANDOM.standard_normal(2000)
    errors = np.zeros(2000)
    for k in range(1, 2000):
        errors[k] = 0.9 * errors[k - 1] + news[k]
    alike = measure_log_likelihood(news, SPEED)
    assert measure_log_likelihood(errors, SPEED) == pytest.approx(alike, abs=10.0)
    assert measure_log_likelihood(RANDOM.permutation(errors), SPEED) < alike - 500.0


def test_no_errors_are_likelier_than_any_and_a_number() -> None:
    none = measure_log_likelihood(np.zeros(100), SPEED[:100])
    assert np.isfinite(none) and none > measure_log_likelihood(1e-9 * SPEED[:100], SPEED[:100])


def test_what_is_no_number_or_alone_tells_nothing() -> None:
    errors = RANDOM.standard_normal(100)
    for bad in (np.nan, np.inf):
        assert measure_log_likelihood(np.append(errors, bad), SPEED[:101]) == -np.inf
        assert measure_log_likelihood(errors, np.append(SPEED[:99], bad)) == -np.inf
    for few in (0, 1):
        assert measure_log_likelihood(errors[:few], SPEED[:few]) == -np.inf
    assert measure_log_likelihood(errors[:2], SPEED[:2]) > -np.inf
