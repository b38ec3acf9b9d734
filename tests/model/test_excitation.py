"""The voltage profiles keep what they promise: length, peak, directions, a start from rest, all of them in `rich`."""

import numpy as np
import pytest
from numpy.typing import NDArray

from motor_model.errors import MotorError
from motor_model.excitation import PROFILES, profile

Floats = NDArray[np.float64]

# Duration [s], peak as a share of the largest voltage, share of the time in which it drives backward and not at all.
PROMISED = {
    "step": (1.0, 1.0, 0.0, 0.0),
    "staircase": (5.75, 1.0, 0.4783, 0.0435),
    "ramps": (6.0, 0.35, 0.5, 0.0),
    "reversals": (3.6, 1.0, 0.5, 0.0),
    "coast": (4.0, 1.0, 0.2, 0.6),
    "prbs": (4.0, 0.9, 0.4, 0.0),
    "chirp": (4.0, 1.0, 0.43, 0.0),
}


def sampled(name: str, largest: float = 10.0, rate: float = 200.0) -> Floats:
    """The voltages at a plant's samples, from just before the start to just after the end."""
    duration = PROFILES[name].duration
    return PROFILES[name].voltage(np.arange(-10, round(duration * rate) + 10) / rate, largest)


def test_these_are_the_profiles() -> None:
    assert set(PROFILES) == {*PROMISED, "rich"}
    assert profile("coast") is PROFILES["coast"]
    with pytest.raises(MotorError, match=r"'sweep' is not a profile; the profiles are step, staircase, .*rich\."):
        profile("sweep")


@pytest.mark.parametrize("name", PROMISED)
def test_a_profile_is_as_long_as_it_says_and_reaches_its_peak(name: str) -> None:
    duration, peak, backward, off = PROMISED[name]
    volts = sampled(name)
    assert PROFILES[name].name == name and PROFILES[name].shows
    assert PROFILES[name].duration == duration
    assert np.all(volts[:10] == 0.0) and np.all(volts[-10:] == 0.0)
    inside = volts[10:-10]
    assert len(inside) == round(duration * 200)
    assert np.max(np.abs(inside)) == pytest.approx(10.0 * peak, rel=0.003)
    assert np.mean(inside < 0.0) == pytest.approx(backward, abs=0.01)
    assert np.mean(inside == 0.0) == pytest.approx(off, abs=0.01)


@pytest.mark.parametrize("name", [*PROMISED, "rich"])
def test_a_profile_scales_and_does_not_depend_on_how_it_is_asked(name: str) -> None:
    assert np.allclose(sampled(name, 12.0), 1.2 * sampled(name, 10.0), rtol=1e-14, atol=0.0)
    shape = PROFILES[name]
    one_by_one = [float(shape.voltage(np.array([t]), 10.0)[0]) for t in np.arange(0, 100) / 50.0]
    assert np.array_equal(one_by_one, shape.voltage(np.arange(0, 100) / 50.0, 10.0))


def test_a_sample_on_a_switch_belongs_to_the_new_level_at_any_rate() -> None:
    for rate in (100.0, 200.0, 300.0, 500.0, 1000.0):
        steps = sampled("staircase", 6.0, rate)[10:-10]
        per_level = round(0.25 * rate)
        levels = steps.reshape(23, per_level)
        assert np.all(np.ptp(levels, axis=1) == 0.0)
        expected = [1, 2, 3, 4, 5, 6, 5, 4, 3, 2, 1, 0, -1, -2, -3, -4, -5, -6, -5, -4, -3, -2, -1]
        assert np.allclose(levels[:, 0], expected, atol=1e-12)


def test_reversals_reverse_at_three_levels() -> None:
    volts = sampled("reversals")[10:-10]
    switches = volts[1:] * volts[:-1] < 0.0
    assert np.count_nonzero(switches) == 11
    assert set(np.round(np.abs(volts), 9)) == {10.0, 7.0, 4.0}


def test_ramps_are_slow_and_pass_zero() -> None:
    volts = sampled("ramps")[10:-10]
    assert np.max(np.abs(np.diff(volts))) == pytest.approx(3.5 / 1.5 / 200, rel=1e-6)
    assert volts.max() == pytest.approx(3.5) and volts.min() == pytest.approx(-3.5)


def test_coasting_starts_from_four_speeds() -> None:
    volts = sampled("coast")[10:-10]
    released = np.flatnonzero((volts[1:] == 0.0) & (volts[:-1] != 0.0))
    assert np.array_equal(volts[released], [10.0, -10.0, 5.0, -5.0])


def test_prbs_switches_fast_between_levels_both_ways() -> None:
    volts = sampled("prbs")[10:-10].reshape(100, 8)  # 40 ms each
    assert np.all(np.ptp(volts, axis=1) == 0.0)
    assert set(np.round(np.abs(volts[:, 0]), 9)) == {3.0, 9.0}
    assert 35 < np.count_nonzero(np.diff(np.abs(volts[:, 0]))) < 65
    assert 2 <= np.count_nonzero(volts[1:, 0] * volts[:-1, 0] < 0.0) <= 8


def test_the_chirp_sweeps_from_slow_to_fast() -> None:
    volts = PROFILES["chirp"].voltage(np.arange(4_000) / 1000.0, 1.0)
    crossings = np.flatnonzero(volts[1:] * volts[:-1] < 0.0) / 1000.0
    first, last = 0.5 / np.diff(crossings)[0], 0.5 / np.diff(crossings)[-1]
    assert 0.5 < first < 2.0 and 9.0 < last < 12.5


def test_rich_is_all_of_them_in_turn() -> None:
    volts, start = sampled("rich")[10:], 0
    for name in PROMISED:
        part = sampled(name)[10:-10]
        assert np.allclose(volts[start : start + len(part)], part, atol=1e-9), name
        start += len(part)
    assert np.all(volts[start:] == 0.0)
    assert PROFILES["rich"].duration == pytest.approx(sum(row[0] for row in PROMISED.values()))
