"""The loop with a model that was identified: on the tests' own plant, which shares no formula with the library.

The plant is driven through a rich recording, `identify` finds a model of it, and observer, feed-forward and gains are
made of that. Beside it the same loop with the plant's true parameters. Judged on the plant's true speed.
"""

import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from control_loop import FRICTION, TAU

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "support"))

from plant import profiles, record
from plant.loop import close_loop

from motor_control.configuration import config_of
from motor_control.controller import controller
from motor_control.parameters import ROWS
from motor_identification.estimation.request import Request
from motor_identification.identify import identify
from motor_identification.recording import check
from motor_model.parameters import Parameters
from motor_model.sample import Info, Sample
from motor_model.sensing.board import BoardConfig

EFFECTS = ("static_friction",)
SEEDS, SPEEDS = range(3), (3.0, 10.0, 40.0, 100.0, -3.0, -40.0)  # discs; [rad/s]
BAND = 0.02  # of the reference


def identified(seed: int) -> Parameters:
    """Identify the plant from half a minute of its motion, on a disc of its own."""
    recording, _ = record(FRICTION, *profiles.rich(), seed=seed, irregularity=0.01, disc_seed=seed)
    return identify([check(recording)], Request(EFFECTS)).parameters


@dataclass(frozen=True)
class Law:
    """The controller as the plant's law, towards one speed [rad/s]."""

    model: Parameters
    info: Info
    reference: float

    def begin(self):  # type: ignore[no-untyped-def]
        """A fresh controller: samples in, voltages [V] out."""
        gains = {"kp": self.model.value("ka") / TAU, "ki": self.model.value("kv") / TAU}
        values = {row.name: row.default for row in ROWS} | gains | {"speed_source": "observer", "feedforward": True}
        config, state = config_of(values, self.info, self.model), controller.State()  # type: ignore[arg-type]
        reference: float | None = self.reference

        def answer(sample: Sample) -> float:
            nonlocal state, reference
            now = sample.sample_time * 1e-9
            output, state = controller.update(config, state, sample, reference, now)
            reference = None
            return output.terms.voltage

        return answer


def run(model: Parameters, rate: float, reference: float, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Time [s] and true speed [rad/s] of a run from rest; shape (K,) each."""
    info = BoardConfig(sample_rate=rate).info(model)
    how = {"sample_rate": rate, "irregularity": 0.01, "disc_seed": 10 + seed, "start_angle": 0.1 * seed}
    _, truth = close_loop(FRICTION, Law(model, info, reference).begin(), 1.4, **how)  # type: ignore[arg-type]
    return truth.time, truth.speed


def row(name: str, models: list[Parameters], rate: float) -> str:
    """A line of the table: the worst disc."""
    settled, over, worst = [], [], dict.fromkeys(SPEEDS, 0.0)
    for seed, model in zip(SEEDS, models, strict=True):
        for reference in SPEEDS:
            time, speed = run(model, rate, reference, seed)
            worst[reference] = max(worst[reference], float(np.abs(speed[time >= 0.7] / reference - 1.0).max()))
            if reference == 100.0:
                outside = time[np.abs(speed - reference) > BAND * reference]
                settled.append(float(outside[-1]))
                over.append(float(speed.max() / reference - 1.0))
    errors = " | ".join(f"{worst[speed]:.1%}" for speed in SPEEDS)
    return f"| {name}, {rate:.0f} Hz | {1e3 * max(settled):.0f} ms | {max(over):.2%} | {errors} |"


def table() -> list[str]:
    """The section of the page."""
    found = [identified(seed) for seed in SEEDS]
    true = [Parameters(FRICTION, EFFECTS)] * len(SEEDS)
    names = ("kv", "ka", "ks", "breakaway_voltage")
    off = {name: 100.0 * max(abs(model.value(name) / FRICTION[name] - 1.0) for model in found) for name in names}
    heads = " | ".join(f"{speed:+g} rad/s" for speed in SPEEDS)
    said = ", ".join(f"{name} {share:.4f} %" for name, share in off.items())
    return [
        "",
        "## With an identified model, on the tests' own plant",
        "",
        f"The worst of {len(SEEDS)} discs and of as many models, each from half a minute on another disc (at most off",
        f"by {said}); largest error of the true speed from 0.7 to 1.4 s.",
        "",
        f"| observer and feed-forward | 0 → 100 rad/s into ±2 % | overshoot | {heads} |",
        "|---|---:|---:|" + "---:|" * len(SPEEDS),
        *[
            row(name, models, rate)
            for rate in (200.0, 1000.0)
            for name, models in (("identified", found), ("true", true))
        ],
    ]


if __name__ == "__main__":
    print("\n".join(table()))
