"""Other people's global searches on one compiled cost over the unit box, each with its own default settings.

A peer searches until the meter it is given says that enough was seen, by raising `Enough`; one that stops by itself
before is started again with another seed.
"""

import importlib
import os
import sys
import tempfile
import warnings
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from threading import Lock
from time import perf_counter

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import differential_evolution, least_squares

from motor_identification.estimation.search.objective import Objective

Floats = NDArray[np.float64]

PEERS = Path(__file__).resolve().parents[1] / "build" / "peers"
INSTALL = "pip install --no-deps --target build/peers -r requirements/benchmarks.in"
NEEDED = ("cma", "pymoo", "pyswarms")


class Enough(Exception):
    """The evaluations are used up, or the goal is reached."""


class Meter:
    """Counts every simulation of one motor, from any thread, and notes when the goal was reached."""

    def __init__(self, objective: Objective, goal: float, budget: int, stop_at_goal: bool = True):
        self.dimensions, self.goal, self.budget, self.stop_at_goal = len(objective.low), goal, budget, stop_at_goal
        self._objective, self._lock, self._begun = objective, Lock(), perf_counter()
        self.evaluations, self.best, self.elapsed = 0, np.inf, 0.0
        self.reached: tuple[int, float] | None = None  # evaluations, seconds
        self.improved: list[tuple[int, float]] = []  # evaluations, best cost

    def residuals(self, places: Floats) -> Floats:
        """Places (S, D) of the unit box → (S, I)."""
        found = self._objective.residuals(places)
        self._note(np.einsum("si,si->s", found, found))
        return found

    def costs(self, places: Floats) -> Floats:
        """Places (S, D) of the unit box → (S,)."""
        costs = self._objective.costs(places)
        self._note(costs)
        return costs

    def _note(self, costs: Floats) -> None:
        with self._lock:
            self.evaluations += len(costs)
            self.elapsed = perf_counter() - self._begun
            if costs.min() < self.best:
                self.best = float(costs.min())
                self.improved.append((self.evaluations, self.best))
            if self.reached is None and self.best <= self.goal:
                self.reached = (self.evaluations, self.elapsed)
            over = self.evaluations >= self.budget or (self.stop_at_goal and self.reached is not None)
        if over:
            raise Enough


def in_unit_box(objective: Objective) -> Objective:
    """The same objective with every unknown from 0 to 1: nobody is held up by a box of odd proportions."""
    low, span = objective.low, objective.high - objective.low
    return replace(
        objective,
        low=np.zeros(len(low)),
        high=np.ones(len(low)),
        costs=lambda x: objective.costs(low + span * np.asarray(x)),
        residuals=lambda x: objective.residuals(low + span * np.asarray(x)),
    )


Peer = Callable[[Meter, np.random.Generator], None]


def single_trf(meter: Meter, random: np.random.Generator) -> None:
    """One SciPy least squares (TRF) from one random place."""
    least_squares(lambda x: meter.residuals(x[None])[0], random.random(meter.dimensions), bounds=(0.0, 1.0))
    raise Enough


def multi_start_trf(meter: Meter, random: np.random.Generator) -> None:
    """The same from one random place after the other."""
    least_squares(lambda x: meter.residuals(x[None])[0], random.random(meter.dimensions), bounds=(0.0, 1.0))


def cma_es(meter: Meter, random: np.random.Generator) -> None:
    """CMA-ES from a random place, a third of the box wide as its manual says."""
    import cma

    options = {"bounds": [0.0, 1.0], "verbose": -9, "seed": int(random.integers(1, 2**31))}
    strategy = cma.CMAEvolutionStrategy(random.random(meter.dimensions), 0.3, options)
    while not strategy.stop():
        places = strategy.ask()
        strategy.tell(places, meter.costs(np.array(places)).tolist())


def scipy_de(meter: Meter, random: np.random.Generator) -> None:
    """Differential evolution."""
    differential_evolution(
        lambda x: meter.costs(x.T) if x.ndim == 2 else float(meter.costs(x[None])[0]),
        [(0.0, 1.0)] * meter.dimensions, seed=random, vectorized=True, updating="deferred",
    )  # fmt: skip


def pymoo_pso(meter: Meter, random: np.random.Generator) -> None:
    """Pymoo's particle swarm."""
    from pymoo.algorithms.soo.nonconvex.pso import PSO
    from pymoo.core.problem import Problem
    from pymoo.optimize import minimize

    class Box(Problem):  # type: ignore[misc]
        def __init__(self) -> None:
            super().__init__(n_var=meter.dimensions, n_obj=1, xl=0.0, xu=1.0)

        def _evaluate(self, x: Floats, out: dict[str, Floats], *_: object, **__: object) -> None:
            out["F"] = meter.costs(x)[:, None]

    minimize(Box(), PSO(), ("n_eval", meter.budget), seed=int(random.integers(2**31)), copy_algorithm=False)


def pyswarms_pso(meter: Meter, random: np.random.Generator) -> None:
    """Global-best particle swarm of pyswarms: 50 particles, c1, c2 and w as in its manual (it has no defaults)."""
    from pyswarms.single import GlobalBestPSO

    np.random.seed(int(random.integers(2**31)))  # it knows no other way
    box = (np.zeros(meter.dimensions), np.ones(meter.dimensions))
    swarm = GlobalBestPSO(50, meter.dimensions, {"c1": 0.5, "c2": 0.3, "w": 0.9}, bounds=box)
    swarm.optimize(meter.costs, meter.budget // 50, verbose=False)


def run(peer: Peer, meter: Meter, seed: int) -> None:
    """Search until enough was seen, again from elsewhere where the peer stops by itself."""
    random = np.random.default_rng(seed)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            while True:
                peer(meter, random)
    except Enough:
        return


def missing() -> list[str]:
    """Peers that are not installed; those in build/peers are put on the path, after the workbench's own packages."""
    sys.path.append(str(PEERS))
    lacking, here = [], os.getcwd()
    with tempfile.TemporaryDirectory() as elsewhere:  # pyswarms writes a report.log where it is imported
        os.chdir(elsewhere)
        for name in NEEDED:
            try:
                importlib.import_module(name)
            except ImportError:
                lacking.append(name)
        os.chdir(here)
    return lacking
