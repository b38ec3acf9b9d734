"""By how much a command swings: a step by its size, a sine by its ways, and what a controller holds by nothing."""

import itertools

import numpy as np
import pytest
from plant import profiles, record
from tiers import keep_fast

from motor_identification.measurement.command_swing import (
    PLAY,
    RESPONSE,
    SWEPT,
    count_levels,
    count_responses,
    has_one_size,
    is_sweep,
    measure_swings,
)
from motor_identification.recording import Floats, Recording, check


def measure(volts: Floats) -> Floats:
    driven, _ = record({"kv": 0.07, "ka": 0.006}, 0.005 * np.arange(len(volts)), volts, seed=1, name="driven")
    return measure_swings(check(driven))


def test_a_step_swings_by_its_size_when_it_comes() -> None:
    swings = measure(np.repeat([0.0, 8.0, -4.0], 100))
    assert np.flatnonzero(swings).tolist() == [100, 200] and swings[[100, 200]] == pytest.approx([1.0, 1.5])


def test_one_that_is_on_from_the_beginning_counts() -> None:
    assert measure(np.repeat([8.0, 4.0], 100)).sum() == pytest.approx(1.5)


def test_a_sine_swings_by_four_amplitudes_a_period() -> None:
    swing = measure(6.0 * np.sin(np.linspace(0.0, 10 * np.pi, 1000))).sum()
    assert swing == pytest.approx(20.0, rel=0.1)  # what is within the play is not followed at once


@pytest.mark.parametrize(("share", "moves"), [(0.49, False), (0.53, True)])
def test_what_moves_to_and_fro_within_the_play_does_not(share: float, moves: bool) -> None:
    held = np.where(np.arange(400) % 2 == 0, 1.0 + share * PLAY, 1.0 - share * PLAY) * 5.0
    assert (measure(held)[1:].sum() > 1.0) == moves


def test_no_voltage_swings_by_nothing() -> None:
    driven, _ = record({"kv": 0.07, "ka": 0.006}, *profiles.pieces([0.0], 1.0), seed=1, name="at rest")
    assert not measure_swings(driven).any()


@pytest.mark.parametrize(("samples", "levels"), [(9, 1), (11, 2)])
def test_at_a_level_a_recording_stays(samples: int, levels: int) -> None:
    volts = np.concatenate([np.zeros(100 - samples), np.full(100, 8.0), np.full(samples, -4.0)])
    driven, _ = record({"kv": 0.07, "ka": 0.006}, 0.005 * np.arange(len(volts)), volts, seed=1, name="driven")
    assert count_levels([driven]) == levels and count_levels([driven] * 2) == levels


def driven(*parts: Floats) -> Recording:
    volts = np.concatenate(parts)
    recording, _ = record({"kv": 0.07, "ka": 0.006}, 0.005 * np.arange(len(volts)), volts, seed=1, name="driven")
    return recording


@pytest.mark.parametrize(("side", "responses"), [(0.99, 1), (1.01, 4)])
def test_a_response_is_a_step_that_is_plain(side: float, responses: int) -> None:
    high, low = np.full(50, 8.0), np.full(50, 8.0 * (1.0 - side * RESPONSE))
    assert count_responses([driven(high, low, high, low)]) == responses


@pytest.mark.parametrize(("samples", "responses"), [(9, 1), (11, 2)])
def test_a_response_lasts(samples: int, responses: int) -> None:
    one = driven(np.zeros(100 - samples), np.full(100, 8.0), np.full(samples, -4.0))
    assert count_responses([one]) == responses and count_responses([one] * 3) == 3 * responses


def test_what_a_controller_moves_slowly_is_no_step() -> None:
    assert count_responses([driven(8.0 - np.linspace(0.0, 4.0, 400))]) <= 1
    at_rest, _ = record({"kv": 0.07, "ka": 0.006}, *profiles.pieces([0.0], 1.0), seed=1, name="at rest")
    assert count_responses([at_rest]) == 0


def sine(rate: Floats, offset: float = 0.0, noise: float = 0.0) -> Recording:
    """A sine whose frequency [Hz] is this at every sample."""
    phase = np.cumsum(2.0 * np.pi * rate * 0.005)
    return driven(offset + 5.0 * np.sin(phase) + noise * np.random.default_rng(1).standard_normal(len(phase)))


@pytest.mark.parametrize(("offset", "noise"), keep_fast(itertools.product([0.0, 7.0], [0.0, 0.1]), (7.0, 0.1)))
def test_a_frequency_that_goes_one_way_is_a_sweep(offset: float, noise: float) -> None:
    up = np.geomspace(0.5, 4.0, 2000)
    assert is_sweep(sine(up, offset, noise)) and is_sweep(sine(up[::-1], offset, noise))
    assert not is_sweep(sine(np.concatenate([up, up]), offset, noise))  # twice
    assert not is_sweep(sine(np.full(2000, 2.0), offset, noise))


@pytest.mark.parametrize(("side", "swept"), [(0.9, False), (1.2, True)])
def test_a_sweep_goes_far(side: float, swept: bool) -> None:
    """The median halves of the first and the last quarter are an eighth of the way from either end."""
    assert is_sweep(sine(np.geomspace(1.0, (side * SWEPT) ** (4.0 / 3.0), 4000))) is swept


def test_few_steps_random_ones_and_none_are_no_sweep() -> None:
    assert not is_sweep(driven(*(np.full(100 - 10 * k, 8.0 * (-1.0) ** k) for k in range(8))))
    lengths = np.random.default_rng(2).integers(10, 100, 60)
    assert not is_sweep(driven(*(np.full(n, 8.0 * (-1.0) ** k) for k, n in enumerate(lengths))))
    assert not is_sweep(driven(np.zeros(100))) and not is_sweep(driven(np.full(100, 8.0)))


@pytest.mark.parametrize(
    ("volts", "one"),
    [
        ([0.0] * 50 + [9.6] * 50, True),
        ([0.0] * 50 + [9.6] * 40 + [9.2] * 10, True),  # as a supply sags
        ([-9.6] * 50 + [9.6] * 49 + [0.0], True),
        ([0.0] * 50 + [9.6] * 48 + [5.0] * 2, False),
        ([0.0] * 50 + [3.14] * 25 + [3.53] * 25, False),
    ],
)
def test_a_command_of_one_size_has_none_between(volts: list[float], one: bool) -> None:
    driven, _ = record({"kv": 0.07, "ka": 0.006}, 0.005 * np.arange(len(volts)), np.array(volts), seed=1, name="driven")
    assert has_one_size([check(driven)]) is one
    assert not has_one_size([])


def test_what_a_command_passes_on_the_way_is_no_size() -> None:
    volts = np.array([0.0] * 150 + [4.8] + [9.6] * 150)
    driven, _ = record({"kv": 0.07, "ka": 0.006}, 0.005 * np.arange(len(volts)), volts, seed=1, name="driven")
    assert has_one_size([check(driven)])
