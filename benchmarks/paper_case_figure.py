"""The figure of the paper's own case: a reference that can be predicted, and one that cannot."""

from pathlib import Path

import numpy as np
from pi_runs import JUDGE, STARTS, Run, hidden_run, loop_simulated, standing
from plant.encoder import Disc
from plant.motor import move

RESULTS = Path(__file__).with_name("results")
ROWS = (  # name, reference, rate [Hz], the stretch that is magnified [s]
    ("starts 10, 20, 40, 15", STARTS, 1000.0, (5.1, 6.7)),
    ("hunting 2 to 30", JUDGE, 1000.0, (9.0, 11.2)),
)
Values = dict[str, float]


def draw(base: Values, found: Values, disc: np.ndarray, seed: int) -> None:
    """Measured and simulated, before (base) and after (found), on the disc that was seen."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(len(ROWS), 2, figsize=(11, 6), width_ratios=(2, 1))
    for (whole, part), (name, reference, rate, window) in zip(axes, ROWS, strict=True):
        run = hidden_run(reference, seed, rate, 2)
        place = standing(run.recording, found, disc)
        time = run.recording.time
        motions = {
            "hidden motor": (run.truth.speed, "black", 2.5),
            "simulated loop, the paper's model": (simulated(run, base, place), "tab:orange", 1.0),
            "simulated loop, friction added": (simulated(run, found, place), "tab:blue", 1.0),
        }
        for axis in (whole, part):
            for label, (speed, colour, width) in motions.items():
                axis.plot(time, speed, color=colour, lw=width, label=label)
            axis.grid(alpha=0.3)
            axis.set_xlabel("time [s]")
        whole.set_title(f"{name} rad/s, {rate:g} Hz", fontsize=10)
        whole.set_ylabel("shaft speed [rad/s]")
        part.set_xlim(*window)
        inside = (time >= window[0]) & (time <= window[1])
        part.set_ylim(-0.5, 1.1 * max(float(speed[inside].max()) for speed, _, _ in motions.values()))
    axes[0, 0].legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(RESULTS / "paper_case.png", dpi=110)


def simulated(run: Run, values: Values, place: tuple[Disc, float]) -> np.ndarray:
    """[rad/s] at the samples of the loop closed over a motor of these values."""
    motion = move(values, run.recording.time, loop_simulated(run, values, *place))
    return motion.speed[motion.at]
