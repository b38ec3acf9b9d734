"""Draw a tuning: the step as predicted and as simulated, its voltage, and the ripple over the speed."""

from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from motor_control.tuning.design import Tuning
from motor_control.tuning.simulated_loop import Rehearsal
from motor_model.errors import MotorError
from motor_model.regular_file import say_refusal, write_bytes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

PREDICTED, REFERENCE, FAINT = "#1d4ed8", "#475569", "#9aa5b1"
# Two curves that should lie on each other: a broad one, and a thin dashed one on top of it.
SIMULATED: dict[str, Any] = {"color": "#f4a582", "linewidth": 3.5}
BESIDE: dict[str, Any] = {"color": PREDICTED, "linewidth": 1.3, "linestyle": (0, (4, 2))}


def draw_tuning(tuning: Tuning, rehearsal: Rehearsal, title: str, path: Path) -> None:
    """Draw a tuning and a rehearsal of its large step.

    Raises:
        MotorError: the file cannot be written.
    """
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams["text.parse_math"] = False  # a name may have $ in it
    from matplotlib import pyplot as plt

    figure, ((speed, small), (voltage, swing)) = plt.subplots(
        2, 2, figsize=(10, 6.2), height_ratios=(3, 2), constrained_layout=True
    )
    figure.suptitle(f"{title}: kp {tuning.gains.kp:.4g} V/(rad/s), ki {tuning.gains.ki:.4g} V/rad", fontsize=11)
    _draw_large(speed, voltage, tuning, rehearsal)
    _draw_small(small, tuning)
    _draw_ripple(swing, tuning)
    for axes in (speed, voltage, small, swing):
        axes.grid(alpha=0.25)
        axes.spines[["top", "right"]].set_visible(False)
    try:
        figure.savefig(drawn := BytesIO(), format=path.suffix[1:] or "png", dpi=120)
        write_bytes(path, drawn.getvalue())
    except (OSError, ValueError) as error:
        why = (
            say_refusal(error)
            if isinstance(error, OSError)
            else "(its name must end in .png, .pdf or .svg): correct it"
        )
        raise MotorError(f"cannot write {path} {why}.") from error
    finally:
        plt.close(figure)


def _draw_large(speed: "Axes", voltage: "Axes", tuning: Tuning, rehearsal: Rehearsal) -> None:
    step = tuning.large_step
    speed.axhline(step.reference, color=REFERENCE, linewidth=0.8, linestyle="--")
    speed.plot(1e3 * rehearsal.time, rehearsal.speed, **SIMULATED, label="simulated: full model, disc, controller")
    speed.plot(1e3 * step.time, step.speed, **BESIDE, label="predicted: linear model")
    speed.set_title(f"step from 0 to {step.reference:.3g} rad/s, with the voltage limit", fontsize=10)
    speed.set_ylabel("shaft speed [rad/s]")
    speed.legend(frameon=False, loc="lower right", fontsize=8)
    speed.sharex(voltage)
    speed.tick_params(labelbottom=False)
    voltage.step(1e3 * rehearsal.time, rehearsal.voltage, where="post", **SIMULATED)
    voltage.step(1e3 * step.time, step.voltage, where="post", **BESIDE)
    voltage.set_ylabel("voltage [V]")
    voltage.set_xlabel("time [ms]")
    voltage.set_xlim(0.0, 1e3 * float(step.time[-1]))


def _draw_small(axes: "Axes", tuning: Tuning) -> None:
    step, risen = tuning.step, 1e3 * tuning.time_constant
    axes.axhline(100.0, color=REFERENCE, linewidth=0.8, linestyle="--")
    axes.plot(1e3 * step.time, 100.0 * step.speed / step.reference, color=PREDICTED)
    axes.axvline(risen, color=FAINT, linewidth=0.9)
    axes.annotate(f" time constant\n {risen:.3g} ms", (risen, 8.0), color=REFERENCE, fontsize=8)
    axes.set_xlim(0.0, 1e3 * min(float(step.time[-1]), 8.0 * tuning.time_constant))
    axes.set_ylim(0.0, None)
    margins = tuning.margins
    axes.set_title("small step, below the voltage limit", fontsize=10)
    axes.text(
        0.97,
        0.06,
        f"gain margin {margins.gain_db:.1f} dB\nphase margin {margins.phase:.0f}°\n"
        f"delay margin {1e3 * margins.delay:.3g} ms\novershoot {100 * step.overshoot:.1f} %",
        transform=axes.transAxes,
        ha="right",
        fontsize=8,
    )
    axes.set_ylabel("share of the step [%]")
    axes.set_xlabel("time [ms]")


def _draw_ripple(axes: "Axes", tuning: Tuning) -> None:
    speeds = np.array([speed for speed, _ in tuning.ripples])
    swings = np.array([ripple.speed for _, ripple in tuning.ripples])
    axes.semilogx(speeds, 100.0 * swings, "o-", color=PREDICTED, markersize=4)
    axes.axhline(100.0 * tuning.wish.oscillation, color=REFERENCE, linewidth=0.8, linestyle="--")
    axes.set_xticks(speeds, [f"{speed:.3g}" for speed in speeds])
    axes.minorticks_off()
    axes.set_ylim(0.0, None)
    axes.set_title("speed ripple from the disc (dashed: allowed)", fontsize=10)
    axes.set_ylabel("peak to peak [%]")
    axes.set_xlabel("speed [rad/s]")
