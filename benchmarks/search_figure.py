"""The runs of a search beside its peers, and their figure: cost over evaluations."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

COLORS = ("#c2410c", "#1d4ed8", "#15803d", "#7c3aed", "#0891b2", "#737373")
Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Run:
    """One search."""

    reached: bool  # the goal
    evaluations: int  # until then, else all
    seconds: float
    total: int  # evaluations until it stopped
    duration: float  # [s]
    improved: list[tuple[int, float]]  # evaluations, best cost


Table = dict[str, list[Run]]  # search → its runs


def draw(tables: dict[str, tuple[Table, float]], bold: str, aside: str, goal: float, most: int, path: Path) -> None:
    """Cost over evaluations up to `most`, medians with the middle 80 %; one search stands out, one is left out."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(
        1, len(tables), figsize=(6.5 * len(tables), 5), sharey=True, squeeze=False, constrained_layout=True
    )
    grid = np.geomspace(10, most, 200)
    for axis, (motor, (table, least)) in zip(axes[0], tables.items(), strict=True):
        for (name, runs), color in zip([item for item in table.items() if item[0] != aside], COLORS, strict=True):
            excess = np.array([_over(run, grid) for run in runs]) / least - 1.0
            low, middle, high = (np.maximum(np.quantile(excess, q, axis=0), 1e-4) for q in (0.1, 0.5, 0.9))
            axis.loglog(grid, middle, color=color, lw=2 if name == bold else 1.3, label=name)
            axis.fill_between(grid, low, high, color=color, alpha=0.12, lw=0)
        axis.axhline(goal - 1.0, color="black", lw=0.8, ls="--")
        axis.set(title=motor, xlabel="simulations of one motor", ylim=(1e-4, None), xlim=(grid[0], grid[-1]))
        axis.grid(alpha=0.25)
    axes[0, 0].set_ylabel("cost / least cost − 1 (dashed: the goal, 1 %)")
    axes[0, -1].legend(fontsize=8, loc="lower left")
    figure.savefig(path, dpi=120)


def _over(run: Run, grid: Floats) -> Floats:
    """Best cost after so many evaluations."""
    count, best = np.array(run.improved).T
    return np.asarray(best[np.maximum(np.searchsorted(count, grid, side="right") - 1, 0)])
