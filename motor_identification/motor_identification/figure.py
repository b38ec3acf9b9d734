"""Pictures of a fit: what was measured, what the model says, and what is left."""

from pathlib import Path

import numpy as np

from motor_identification.findings import as_table
from motor_identification.identify import Fit
from motor_identification.recording import Recording
from motor_identification.residual import intervals_of, residuals
from motor_model.errors import MotorError
from motor_model.simulate import simulate

MEASURED, SIMULATED, REFERENCE, VOLTAGE = "#9aa5b1", "#c2410c", "#1d4ed8", "#475569"
MOST_POINTS = 20_000  # more than this cannot be told apart in a picture


def draw_fit(recording: Recording, fit: Fit, path: Path) -> None:
    """Draw one recording and the fitted model's motion over it: speed, voltage, residual.

    Raises:
        MotorError: the file cannot be written.
    """
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    data = intervals_of(recording)
    start = fit.start_speeds[fit.uris.index(recording.uri)] if recording.uri in fit.uris else 0.0
    motion = simulate(fit.parameters, recording.time, recording.voltage, data.time, start)
    left = residuals(data, motion.angle)
    middle = 0.5 * (data.time[data.first] + data.time[data.last])
    thin = slice(None, None, -(-len(middle) // MOST_POINTS))

    figure, (speed, voltage, rest) = plt.subplots(
        3, 1, figsize=(10, 7.5), sharex=True, height_ratios=(3, 1, 1.4), constrained_layout=True
    )
    speed.plot(middle[thin], data.speed[thin], ".", color=MEASURED, markersize=3, label="measured (between edges)")
    speed.plot(motion.time[thin], motion.speed[thin], color=SIMULATED, linewidth=1.1, label="simulated")
    speed.set_ylabel("speed [rad/s]")
    speed.legend(loc="upper right", framealpha=0.9, ncols=2)
    speed.set_title(f"{recording.info.name}: residual {fit.residual_rms:.3g} rad/s RMS, R² {fit.r_squared:.5f}")
    speed.text(
        0.01, 0.02, as_table(fit), transform=speed.transAxes, family="monospace", fontsize=8, va="bottom",
        bbox={"facecolor": "white", "alpha": 0.9, "edgecolor": "none"},
    )  # fmt: skip
    voltage.step(recording.time, recording.voltage, where="post", color=VOLTAGE, linewidth=1)
    voltage.set_ylabel("voltage [V]")
    order = np.argsort(middle[thin])
    rest.plot(middle[thin][order], left[thin][order], ".", color=SIMULATED, markersize=2)
    rest.fill_between(
        middle[thin][order], -2 * data.sigma[thin][order], 2 * data.sigma[thin][order], color=MEASURED, alpha=0.5,
        linewidth=0, label="±2 σ of the encoder alone",
    )  # fmt: skip
    rest.set_ylabel("simulated −\nmeasured [rad/s]")
    rest.set_xlabel("time [s]")
    rest.legend(loc="upper right", framealpha=0.9, fontsize=8)
    for axis in (speed, voltage, rest):
        axis.grid(alpha=0.25)
    try:
        figure.savefig(path, dpi=120)
    except OSError as error:
        raise MotorError(f"cannot write {path}: {error.strerror}.") from error
    finally:
        plt.close(figure)
