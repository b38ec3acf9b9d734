"""The controller around `SimulatedBoard`, the true shaft speed beside what it was told; the paper's motor."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from motor_control.configuration import config_of
from motor_control.controller import controller
from motor_control.controller.controller import Config, State
from motor_control.controller.output import Output
from motor_control.parameters import ROWS
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_model.sample import Info, Sample
from motor_model.sensing.board import BoardConfig, SimulatedBoard

Floats = NDArray[np.float64]

TIME_CONSTANT = 0.015  # [s] closed loop
BREAKAWAY = 0.9  # [V]
DEFAULTS = {row.name: row.default for row in ROWS}


def motor(effects: tuple[str, ...] = (), **changes: float) -> Parameters:
    """The paper's motor with 0.4 V of sliding friction, 0.9 V of breakaway, and what else is wanted."""
    values = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.4, "breakaway_voltage": BREAKAWAY, "stribeck_speed": 4.0}
    return Parameters(values | changes, ("static_friction", *effects))


def settings(model: Parameters | None, info: Info, time_constant: float = TIME_CONSTANT, **changes: object) -> Config:
    """Gains by pole placement: the law's zero cancels the pole of the motor; observer and feed-forward on."""
    kp = PAPER_KA / time_constant
    values = {"kp": kp, "ki": kp * PAPER_KV / PAPER_KA, "speed_source": "observer", "feedforward": True}
    return config_of({**DEFAULTS, **values, **changes}, info, model)  # type: ignore[dict-item]


@dataclass(frozen=True)
class Run:
    """What happened at each sample; arrays of shape (K,)."""

    time: Floats  # [s]
    speed: Floats  # [rad/s] true
    voltage: Floats  # [V] latched
    outputs: list[Output]

    def between(self, start: float, stop: float) -> Run:
        keep = np.flatnonzero((self.time >= start) & (self.time < stop))
        return Run(self.time[keep], self.speed[keep], self.voltage[keep], [self.outputs[k] for k in keep])

    def shown(self, name: str) -> Floats:
        """A field of every output, or of its terms."""
        return np.array([getattr(output, name, None) or getattr(output.terms, name, 0.0) for output in self.outputs])

    def settled(self, target: float, share: float = 0.02) -> float:
        """[s] after its start until the true speed stays within a share of the target."""
        outside = self.time[np.abs(self.speed - target) > share * abs(target)]
        return float(outside[-1] - self.time[0]) if len(outside) else 0.0

    def swing(self) -> float:
        """Peak to peak over mean."""
        return float(np.ptp(self.speed) / abs(self.speed.mean()))

    def states(self) -> set[str]:
        return {output.state for output in self.outputs}


Reference = Callable[[float], float]


def drive(
    plant: Parameters,
    reference: float | Reference,
    duration: float,
    *,
    model: Parameters | None = None,
    rate: float = 200.0,
    seed: int = 0,
    single_channel: bool = True,
    configs: Sequence[tuple[float, dict[str, object]]] = (),
    line: Callable[[Sample], Sample] = lambda sample: sample,
    **changes: object,
) -> Run:
    """From rest; `configs`: settings that change at a time [s]; `line`: what becomes of a sample on its way."""
    board = BoardConfig(sample_rate=rate, slot_irregularity=0.01, seed=seed, single_channel=single_channel)
    simulated, info, state, command = SimulatedBoard(plant, board), board.info(plant), State(), 0.0
    known = model or plant
    config, later = settings(known, info, **changes), list(configs)  # type: ignore[arg-type]
    rows, outputs = [], []
    for k in range(round(duration * rate)):
        time = k / rate
        if later and time >= later[0][0] - 1e-9:
            changes = {**changes, **later.pop(0)[1]}
            config = settings(None if changes.get("model") is None and "model" in changes else known, info, **{
                name: value for name, value in changes.items() if name != "model"
            })  # type: ignore[arg-type]  # fmt: skip
        sample = simulated.sample(command)
        wanted = reference(time) if callable(reference) else reference
        output, state = controller.update(config, state, line(sample), wanted, time)
        command = output.terms.voltage
        rows.append((time, simulated.speed, sample.voltage))
        outputs.append(output)
    table = np.array(rows)
    return Run(table[:, 0], table[:, 1], table[:, 2], outputs)
