"""List where the fit of a motor with more effects begins: the start values of each effect, the rest as it is."""

from collections.abc import Mapping
from itertools import product
from typing import NamedTuple

import numpy as np

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.parameter_space import map_theta
from motor_identification.estimation.problem import Problem
from motor_identification.recording import Floats


class Start(NamedTuple):
    """Where a fit begins."""

    sizes: dict[str, float]  # of the parameters that are new
    theta: Floats  # (D,) of the larger problem


def list_starts(estimate: Estimate, larger: Problem) -> list[Start]:
    """List all combinations of the start values of what a larger problem has more than an estimate's own."""
    old = estimate.problem.unknowns
    added = [spec for spec in larger.unknowns.specs if spec.name not in old.names]
    starts = []
    for shares in product(*(spec.starts for spec in added)):
        sizes: dict[str, float] = {}
        for spec, share in zip(added, shares, strict=True):
            sizes[spec.name] = share * spec.scale.of(larger.unknowns.extent)
            if spec.at_least is not None:
                least = spec.at_least
                sizes[spec.name] += sizes[least] if least in sizes else float(estimate.theta[old.names.index(least)])
        starts.append(Start(sizes, start_with(estimate, larger, sizes)))
    return starts


def start_with(estimate: Estimate, larger: Problem, sizes: Mapping[str, float]) -> Floats:
    """Make the θ (D,) of a larger problem with sizes of what is new in it."""
    values = {name: np.array(size) for name, size in sizes.items()}
    return map_theta(estimate.problem.unknowns, estimate.theta, larger.unknowns, values)
