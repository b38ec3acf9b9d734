"""The global search: known valleys, a motor with hidden friction from every seed, honest counts, doubts."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from tiers import keep_fast

from motor_identification.estimation.problem import Problem, make_problem
from motor_identification.estimation.request import SearchConfig
from motor_identification.estimation.search.multistart import search
from motor_identification.estimation.search.objective import Objective, make_objective
from motor_identification.experiment import make_plan, simulate_plan
from motor_identification.recording import check, recording_of
from motor_model.errors import MotorError
from motor_model.excitation import profile
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_model.sensing.board import BoardConfig

Floats = NDArray[np.float64]

LOW, HIGH = np.array([-3.0, -2.0]), np.array([4.0, 5.0])
EFFECTS = ("static_friction", "transport_delay")
FRICTION = {"ks": 3.0, "breakaway_voltage": 4.5, "stribeck_speed": 10.0}


def landscape(residuals: Callable[[Floats], Floats], low: Floats = LOW, high: Floats = HIGH) -> Objective:
    """Of two unknowns that have walls, without noise."""
    walls = np.zeros(len(low), dtype=bool)
    return Objective(low, high, walls, lambda x: np.sum(residuals(x) ** 2, axis=1), residuals, negligible=1e-12)


def bowl(x: Floats) -> Floats:
    return x - np.array([1.0, 2.0])


def two_valleys(x: Floats) -> Floats:
    """Minima at x0 = −1, of cost 0.01, and at x0 = 2, of cost 0."""
    depth = 0.1 / (1.0 + np.exp(10.0 * (x[:, 0] - 0.5)))
    return np.column_stack([(x[:, 0] + 1.0) * (x[:, 0] - 2.0), x[:, 1] - 1.0, depth])


def many_valleys(x: Floats) -> Floats:
    """Rastrigin's function as residuals: about 50 valleys in this box, the deepest at 0."""
    return np.column_stack([x, np.sqrt(10.0 * np.maximum(1.0 - np.cos(2.0 * np.pi * x), 0.0))])


def plateau(x: Floats) -> Floats:
    """Flat but for a hole of a hundredth of the box, at (3, 4): where there is no slope, least squares stays."""
    away = np.max(np.abs(x - np.array([3.0, 4.0])), axis=1)
    return np.minimum(away / 0.35, 1.0)[:, None] + np.zeros((1, 2))


@pytest.fixture(scope="module")
def hidden() -> Problem:
    """Six unknowns of a motor that needs 4.5 of its 12 V to start."""
    motor = Parameters({"kv": PAPER_KV, "ka": PAPER_KA, "delay": 0.006, **FRICTION}, EFFECTS)
    config = BoardConfig(slot_irregularity=0.01, seed=1)
    plan = make_plan(profile("staircase"), None, 12.0, 1.0 / config.sample_rate)
    samples = [sample for _, sample in simulate_plan(plan, motor, config)]
    recording = check(recording_of(samples, config.info(motor), "staircase"))
    return make_problem([recording], EFFECTS).coarsen(4.0)


@pytest.mark.parametrize("seed", range(5))
def test_the_deeper_of_two_valleys(seed: int) -> None:
    found = search(landscape(two_valleys), SearchConfig(seed=seed))
    assert found.theta == pytest.approx([2.0, 1.0], abs=1e-3) and found.cost < 1e-6
    assert found.agreed and found.agreeing >= 2 and found.evaluations < 1500
    assert {round(float(descent.theta[0])) for descent in found.descents} <= {-1, 2}


@pytest.mark.parametrize("seed", range(5))
def test_the_deepest_of_fifty_valleys_takes_longer(seed: int) -> None:
    few = search(landscape(bowl), SearchConfig(seed=seed))
    many = search(landscape(many_valleys), SearchConfig(seed=seed))
    assert few.theta == pytest.approx([1.0, 2.0], abs=1e-6) and many.theta == pytest.approx([0.0, 0.0], abs=1e-4)
    assert many.evaluations > 5 * few.evaluations and many.swarms > few.swarms


@pytest.mark.parametrize("seed", range(3))
def test_a_hole_in_a_plateau_is_fallen_into(seed: int) -> None:
    found = search(landscape(plateau), SearchConfig(seed=seed))
    assert found.cost < 0.01


@pytest.mark.parametrize("seed", keep_fast(range(10), 0, 1, 2))
def test_hidden_friction_is_found_from_every_seed(hidden: Problem, seed: int) -> None:
    """Least squares alone stalls from two of three starts here: a motor that never starts has no derivative."""
    ground = make_objective(hidden)
    found = search(ground, SearchConfig(seed=seed))
    values = hidden.unknowns.parameters(found.theta, "found").values
    truth = {"kv": PAPER_KV, "ka": PAPER_KA, **FRICTION, "delay": 0.006}
    for name, near in dict.fromkeys(truth, 0.02).items() | {"stribeck_speed": 0.1}.items():
        assert values[name] == pytest.approx(truth[name], rel=near), name
    assert found.cost == pytest.approx(float(hidden.costs(found.theta[None])[0]), rel=1e-9)
    assert 0.05 * ground.noise_cost < found.cost < ground.noise_cost
    assert found.agreed and found.agreeing >= 2
    assert 100 < found.evaluations < 3000


def test_every_simulation_is_counted(hidden: Problem) -> None:
    ground, counts = make_objective(hidden), {"costs": 0, "residuals": 0}

    def counting(name: str) -> Callable[[Floats], Floats]:
        def count(x: Floats) -> Floats:
            counts[name] += len(x)
            return np.asarray(getattr(ground, name)(x))

        return count

    found = search(replace(ground, costs=counting("costs"), residuals=counting("residuals")), SearchConfig(seed=3))
    assert found.evaluations == sum(counts.values()) and min(counts.values()) > 10
    assert counts["residuals"] == sum(descent.evaluations for descent in found.descents)
    assert found.spent[-1] == found.evaluations and found.trace[-1] == found.cost
    assert np.all(np.diff(found.spent) > 0) and np.all(np.diff(found.trace) <= 0.0)
    assert found.trace[0] > 1e3 * found.trace[-1]
    assert [d.cost for d in found.descents] == sorted(d.cost for d in found.descents)


def test_a_seed_is_a_search_whatever_the_number_of_threads(hidden: Problem) -> None:
    one, same = (search(make_objective(replace(hidden, workers=n)), SearchConfig(seed=4)) for n in (1, 3))
    other = search(make_objective(hidden), SearchConfig(seed=5))
    assert np.array_equal(one.theta, same.theta) and np.array_equal(one.trace, same.trace)
    assert np.array_equal(one.spent, same.spent) and one.evaluations == same.evaluations
    assert not np.array_equal(one.theta, other.theta) and one.theta == pytest.approx(other.theta, rel=1e-3)
    assert one.trace[0] != other.trace[0]


@pytest.mark.parametrize("residuals", [many_valleys, lambda x: x - HIGH - 1.0, lambda x: x - LOW + 1.0])
def test_nothing_outside_the_box_is_ever_asked(residuals: Callable[[Floats], Floats]) -> None:
    asked: list[Floats] = []

    def watched(x: Floats) -> Floats:
        asked.append(x.copy())
        return residuals(x)

    found = search(landscape(watched), SearchConfig(epochs=20))
    every = np.concatenate(asked)
    assert np.all(every >= LOW) and np.all(every <= HIGH) and len(every) > 50
    assert np.all(found.theta >= LOW) and np.all(found.theta <= HIGH)


def test_a_minimum_on_the_wall_is_found_there() -> None:
    found = search(landscape(lambda x: x - np.array([9.0, 1.0])), SearchConfig())
    assert found.theta == pytest.approx([4.0, 1.0], abs=1e-4) and found.cost == pytest.approx(25.0, rel=1e-4)


def test_a_phase_has_no_walls() -> None:
    """Downhill leads over the end of the box for half of the starts: they come in again at the other end."""
    low, high = np.array([-np.pi, -1.0]), np.array([np.pi, 1.0])

    def phase(x: Floats) -> Floats:
        return np.column_stack([np.cos(x[:, 0]) + np.cos(0.1), np.sin(x[:, 0]) + np.sin(0.1), x[:, 1]])

    for seed in range(5):
        walls = landscape(phase, low, high)
        found = search(replace(walls, periodic=np.array([True, False])), SearchConfig(seed=seed))
        assert found.theta == pytest.approx([0.1 - np.pi, 0.0], abs=1e-6)
        assert found.agreeing == len(found.descents) == 2
    hindered = [search(walls, SearchConfig(seed=seed)) for seed in range(5)]
    assert sum(found.agreeing < len(found.descents) for found in hindered) >= 2


def test_too_few_evaluations_are_said(hidden: Problem) -> None:
    """Nothing is agreed on after one swarm of four and one or two descents."""
    small = SearchConfig(particles=4, epochs=10)
    rough = [search(make_objective(hidden), replace(small, seed=seed)) for seed in range(8)]
    best = min(found.cost for found in rough)
    lost = [found for found in rough if found.cost > 1.1 * best]
    assert lost and not any(found.agreed for found in lost)
    for found in rough:
        assert found.agreed == (found.agreeing >= 2 and found.cost < make_objective(hidden).noise_cost)
        assert small.budget <= found.evaluations + small.particles
        assert found.evaluations < small.budget + 7 * 61
    valleys = search(landscape(many_valleys), SearchConfig(particles=10, epochs=8))
    assert not valleys.agreed and valleys.evaluations > 70


def test_the_limits_are_limits() -> None:
    sizes: list[int] = []

    def costs(x: Floats) -> Floats:
        sizes.append(len(x))
        return np.asarray(np.sum(many_valleys(x) ** 2, axis=1))

    config = SearchConfig(particles=14, epochs=16)
    told: list[float] = []
    found = search(replace(landscape(many_valleys), costs=costs), config, told.append)
    assert set(sizes) == {10, 14} and config.budget == 14 * 17
    assert sizes[:2] == [10, 10] and 3 <= len(sizes) - 2 <= 17
    assert config.budget - 14 < found.evaluations < config.budget + 50 and not found.agreed
    assert told == sorted(told) and 0.0 < told[0] <= told[-1] == 1.0


def test_a_wrong_model_is_searched_longer_than_one_that_explains_the_data(hidden: Problem) -> None:
    """Without friction nothing comes near the noise, so that only many descents can say that this is the best."""
    recording = hidden.recordings
    poor = make_problem(recording, ("transport_delay",)).coarsen(4.0)
    ground = make_objective(poor)
    found = search(ground, SearchConfig())
    assert found.cost > 1e3 * ground.noise_cost and found.agreed and found.agreeing >= 7
    assert found.swarms >= 3
    assert ground.noise_cost == pytest.approx(make_objective(hidden).noise_cost)


def test_what_the_data_leave_open_is_agreed_in_cost_but_not_in_theta() -> None:
    def spread(residuals: Callable[[Floats], Floats]) -> Floats:
        found = search(landscape(residuals), SearchConfig())
        assert found.agreed and found.cost < 1e-12 and found.agreeing == len(found.descents)
        return np.ptp([descent.theta for descent in found.descents], axis=0) / (HIGH - LOW)

    assert np.all(spread(lambda x: (x[:, :1] + x[:, 1:]) - 1.0) > 0.05)
    assert np.all(spread(bowl) < 1e-6)


def test_nowhere_a_number_is_an_error() -> None:
    nowhere = landscape(lambda x: np.full_like(x, np.nan))
    with pytest.raises(MotorError, match="no parameters in the search range give a finite simulation"):
        search(nowhere, SearchConfig(epochs=5))


def test_a_cliff_without_numbers_is_no_place() -> None:
    def half(x: Floats) -> Floats:
        found = bowl(x)
        found[x[:, 0] < 0.0] = np.nan
        return found

    found = search(landscape(half), SearchConfig())
    assert found.theta == pytest.approx([1.0, 2.0], abs=1e-6) and found.agreed
