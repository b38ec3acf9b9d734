"""The particle swarm on functions whose minima are known, and what it promises about its box, seed, trace and stop."""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from motor_identification.estimation.search.swarm import SwarmConfig, minimise

Floats = NDArray[np.float64]
Cost = Callable[[Floats], Floats]

LOW, HIGH = np.array([-3.0, -2.0]), np.array([4.0, 5.0])


def config(
    particles: int = 50, epochs: int = 200, seed: int = 0, stall: int = 40, tolerance: float = 1e-9
) -> SwarmConfig:
    return SwarmConfig(particles, epochs, seed, stall=stall, tolerance=tolerance)


def sphere(x: Floats) -> Floats:
    return np.asarray(np.sum((x - np.array([1.0, 2.0])[: x.shape[1]]) ** 2, axis=1))


def rosenbrock(x: Floats) -> Floats:
    return np.asarray(100.0 * (x[:, 1] - x[:, 0] ** 2) ** 2 + (1.0 - x[:, 0]) ** 2)


def rastrigin(x: Floats) -> Floats:
    return np.asarray(20.0 + np.sum(x**2 - 10.0 * np.cos(2.0 * np.pi * x), axis=1))


def slope(x: Floats) -> Floats:
    """Falls towards the wall x0 = low, and has its minimum in x1 inside."""
    return np.asarray(x[:, 0] + (x[:, 1] - 1.0) ** 2)


KNOWN: dict[str, tuple[Cost, tuple[float, float], float]] = {
    "sphere": (sphere, (1.0, 2.0), 1e-6),
    "rosenbrock": (rosenbrock, (1.0, 1.0), 1e-2),
    "rastrigin": (rastrigin, (0.0, 0.0), 1e-4),  # one of about 50 valleys in this box
    "slope": (slope, (-3.0, 1.0), 1e-6),
}


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("name", KNOWN)
def test_finds_the_minimum_in_200_epochs(name: str, seed: int) -> None:
    cost, place, near = KNOWN[name]
    result = minimise(cost, LOW, HIGH, config(epochs=200, seed=seed, stall=0))
    assert np.max(np.abs(result.theta - place)) < near
    assert result.cost == pytest.approx(float(cost(result.theta[None])[0]), abs=1e-15)
    assert result.cost <= float(cost(np.array([place]))[0]) + near**2 * 600.0
    assert result.evaluations == 50 * 201 and len(result.trace) == 201


def test_a_minimum_on_the_wall_is_found_there() -> None:
    result = minimise(slope, LOW, HIGH, config(epochs=150))
    assert result.theta[0] == -3.0
    mirrored = minimise(lambda x: slope(-x), -HIGH, -LOW, config(epochs=150))
    assert mirrored.theta[0] == 3.0


def test_nothing_outside_the_box_is_ever_asked() -> None:
    """The box's walls are such that low + (high − low) is not high in floating point."""
    low, high = np.array([0.1, -0.7, 1e-9]), np.array([0.3, 0.1, 1e-9 + 1e-12])
    assert np.any(low + (high - low) != high)
    asked: list[Floats] = []

    def outwards(x: Floats) -> Floats:
        asked.append(x.copy())
        return np.asarray(-np.sum(x / high, axis=1))

    result = minimise(outwards, low, high, config(epochs=60))
    every = np.concatenate(asked)
    assert np.all(every >= low) and np.all(every <= high)
    assert result.theta == pytest.approx(high, rel=1e-12)
    assert np.mean(np.isclose(every, high, rtol=1e-12)) > 0.3  # strays end on the wall, not thrown back inside


def test_one_call_an_epoch_with_all_particles() -> None:
    shapes = []

    def cost(x: Floats) -> Floats:
        shapes.append(x.shape)
        return sphere(x)

    result = minimise(cost, LOW, HIGH, config(particles=17, epochs=9, stall=0))
    assert shapes == [(17, 2)] * 10 and result.evaluations == 170
    assert result.thetas.shape == (17, 2) and result.costs.shape == (17,)


def test_the_first_epoch_covers_every_axis_evenly() -> None:
    first: list[Floats] = []

    def cost(x: Floats) -> Floats:
        first.append(x.copy())
        return sphere(x)

    minimise(cost, LOW, HIGH, config(particles=40, epochs=1))
    rows = np.floor((first[0] - LOW) / (HIGH - LOW) * 40).astype(int)
    assert all(sorted(rows[:, axis]) == list(range(40)) for axis in range(2))


def test_a_seed_is_a_search() -> None:
    one, same, other = (minimise(rastrigin, LOW, HIGH, config(epochs=30, seed=seed)) for seed in (4, 4, 5))
    assert np.array_equal(one.thetas, same.thetas) and np.array_equal(one.trace, same.trace)
    assert not np.array_equal(one.trace, other.trace)
    assert not np.array_equal(one.thetas[0], other.thetas[0])


def test_the_trace_never_rises_and_ends_at_the_result() -> None:
    told: list[tuple[int, float]] = []
    result = minimise(rosenbrock, LOW, HIGH, config(epochs=50), lambda epoch, cost: told.append((epoch, cost)))
    assert np.all(np.diff(result.trace) <= 0.0) and result.trace[0] > 100.0 * result.trace[-1]
    assert result.trace[-1] == result.cost == result.costs[0]
    assert np.all(np.diff(result.costs) >= 0.0)
    assert told == [(epoch, float(result.trace[epoch])) for epoch in range(1, 51)]


def test_a_cost_that_is_no_number_counts_as_no_place() -> None:
    def half(x: Floats) -> Floats:
        costs = sphere(x)
        costs[x[:, 0] < 1.5] = np.nan
        costs[x[:, 1] > 3.0] = np.inf
        return costs

    result = minimise(half, LOW, HIGH, config(epochs=120))
    assert result.theta == pytest.approx([1.5, 2.0], abs=1e-3) and result.theta[0] >= 1.5
    assert np.isfinite(result.cost) and result.cost == pytest.approx(0.25, abs=1e-3)
    minus = minimise(lambda x: np.where(x[:, 0] < 0.0, -np.inf, sphere(x)), LOW, HIGH, config())
    assert minus.theta == pytest.approx([1.0, 2.0], abs=1e-3)


def test_nowhere_a_number_ends_without_one() -> None:
    result = minimise(lambda x: np.full(len(x), np.nan), LOW, HIGH, config(epochs=100, stall=10))
    assert result.cost == np.inf and len(result.trace) == 11
    assert np.all(result.theta >= LOW) and np.all(result.theta <= HIGH)


@pytest.mark.parametrize("offset", [0.0, 7.0, -7.0])
def test_stops_when_it_stalls_whatever_the_sign_of_the_cost(offset: float) -> None:
    long = config(epochs=2000, stall=30, tolerance=1e-6)
    result = minimise(lambda x: sphere(x) + offset, LOW, HIGH, long)
    epochs = len(result.trace) - 1
    assert (40 if offset else 100) < epochs < 1500
    assert result.theta == pytest.approx([1.0, 2.0], abs=0.01)
    if offset:
        small = result.trace[:-1] - result.trace[1:] <= 1e-6 * np.abs(result.trace[:-1])
        assert np.all(small[-30:]) and not small[-31]


def test_a_late_first_number_is_an_improvement() -> None:
    calls = 0

    def late(x: Floats) -> Floats:
        nonlocal calls
        calls += 1
        return sphere(x) + 1.0 if calls > 8 else np.full(len(x), np.inf)

    result = minimise(late, LOW, HIGH, config(epochs=100, stall=10, tolerance=1e-3))
    assert len(result.trace) > 20 and result.cost == pytest.approx(1.0, abs=0.05)


def test_one_dimension_and_two_particles_are_enough() -> None:
    result = minimise(lambda x: np.asarray((x[:, 0] - 1.0) ** 2), LOW[:1], HIGH[:1], config(particles=2, epochs=200))
    assert result.theta.shape == (1,) and abs(result.theta[0] - 1.0) < 0.5


@pytest.mark.parametrize(
    ("low", "high"),
    [([0.0, 1.0], [1.0, 1.0]), ([0.0, 2.0], [1.0, 1.0]), ([0.0, np.nan], [1.0, 1.0]), ([0.0, 0.0], [1.0, np.inf])],
)
def test_a_box_without_room_is_refused(low: list[float], high: list[float]) -> None:
    with pytest.raises(ValueError, match="finite bounds, each low below its high"):
        minimise(sphere, np.array(low), np.array(high), config())


def test_a_swarm_of_one_is_refused() -> None:
    with pytest.raises(ValueError, match="at least two particles"):
        minimise(sphere, LOW, HIGH, config(particles=1))
