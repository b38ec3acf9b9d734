"""The figure of `control.py`: true speeds after a step, at 3 rad/s, under a load, and the voltage through zero."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot

from motor_control.tuning.simulated_loop import Rehearsal

if TYPE_CHECKING:
    from control_loop import Loop

STYLES = (
    {"color": "tab:green"},
    {"color": "tab:blue"},
    {"color": "tab:orange", "lw": 0.8},
    {"color": "0.5", "lw": 0.8},
)


def draw(loops: list[Loop], ramp: Rehearsal, path: Path) -> None:
    """Write the figure; `ramp` is a run whose reference passes zero."""
    figure, ((step, slow), (load, zero)) = pyplot.subplots(2, 2, figsize=(11.0, 7.0), layout="constrained")
    for loop, style in zip(loops, STYLES, strict=True):
        run = loop.run(100.0, 0.4, 0)
        step.plot(1e3 * run.time, run.speed, label=loop.name, **style)
        run = loop.run(3.0, 1.4, 0)
        slow.plot(run.time, run.speed, **style)
        run = loop.run(40.0, 0.9, 0, load=0.5)
        load.plot(1e3 * (run.time - 0.6), run.speed, **style)
    step.set(title="0 → 100 rad/s", xlabel="time [ms]", ylabel="true speed [rad/s]", ylim=(0.0, 130.0))
    step.legend(fontsize=7, loc="lower right")
    slow.axhspan(2.7, 3.3, color="0.9")
    slow.set(
        title="3 rad/s, 46 edges a second; grey: ±10 %", xlabel="time [s]", ylabel="true speed [rad/s]", ylim=(-1, 15)
    )
    load.axhspan(39.2, 40.8, color="0.9")
    load.set(
        title="0.5 V of load at 40 rad/s; grey: ±2 %", xlabel="time after the load [ms]", ylabel="true speed [rad/s]"
    )
    load.set(xlim=(-50.0, 300.0), ylim=(34.0, 46.0))
    zero.plot(ramp.time, ramp.speed, color="tab:blue", label="true speed [rad/s]")
    volts = zero.twinx()
    volts.step(ramp.time, ramp.voltage, where="post", color="tab:red", lw=0.8)
    volts.set(ylabel="voltage [V]", ylim=(-6.0, 6.0))
    volts.yaxis.label.set_color("tab:red")
    zero.set(title="the reference ramps through 0, 1 kHz", xlabel="time [s]", ylabel="true speed [rad/s]")
    zero.axhline(0.0, color="0.8", lw=0.5)
    for axes in (step, slow, load):
        axes.grid(alpha=0.3)
    figure.savefig(path, dpi=120)
    pyplot.close(figure)
