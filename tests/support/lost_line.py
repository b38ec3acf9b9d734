"""A simulated motor whose encoder line is lost at some time, with stray edges or without, under the controller."""

from dataclasses import dataclass, replace
from math import copysign, tau

import numpy as np
from bench_board import DEFAULTS, settings

from motor_control.configuration import config_of
from motor_control.controller import controller
from motor_model.parameters import Parameters
from motor_model.sample import Sample
from motor_model.sensing.board import BoardConfig, SimulatedBoard


@dataclass
class LostLine:
    """Reports the board's samples until the line is lost, then edges at random times, or regular ones."""

    strays: float  # [edges/s]
    slot: float  # [rad]
    reference: float  # [rad/s] whose sign the report has
    seed: int = 0
    regular: bool = False  # the mains' hum in place of random edges

    def __post_init__(self) -> None:
        self._random, self._next, self._last = np.random.default_rng(self.seed), 0.0, Sample(0, 0.0, 0.0)

    def report(self, sample: Sample, lost: bool) -> Sample:
        """What the controller is told of a sample."""
        if not lost:
            self._last, self._next = sample, sample.sample_time * 1e-9
            return sample
        count, edge, period = self._last.edge_count, self._last.edge_time, self._last.edge_period
        while self.strays and self._next <= sample.sample_time * 1e-9:
            stamp = int(self._next * 1e9)
            if stamp > edge:
                count, edge, period = count + 1, stamp, (stamp - edge) * 1e-9
            self._next += 1.0 / self.strays if self.regular else float(self._random.exponential(1.0 / self.strays))
        age = (sample.sample_time - edge) * 1e-9
        speed = copysign(self.slot / max(period, age), self.reference) if age < 0.1 and period > 0.0 else 0.0
        self._last = replace(sample, speed=speed, edge_count=count, edge_time=edge, edge_period=period)
        return self._last


@dataclass(frozen=True)
class Loss:
    """What became of it."""

    stopped: float | None  # [s] after the loss
    fastest: float  # [rad/s] true, since then
    reason: str


def lose_line(
    plant: Parameters,
    reference: float,
    strays: float,
    *,
    rate: float = 200.0,
    source: str = "measured",
    model: Parameters | None = None,
    edges: int = 96,
    lost: float = 0.8,
    duration: float = 3.0,
    single_channel: bool = True,
    hum: bool = False,
    asked: float = 0.0,
    **changes: object,
) -> Loss:
    """From rest to a reference [rad/s], which comes after `asked` [s]; after `lost` [s] the line is, too.

    Strays a second are left, at random or as hum.
    """
    board = BoardConfig(
        sample_rate=rate, slot_irregularity=0.01, edges_per_revolution=edges, single_channel=single_channel
    )
    simulated, info = SimulatedBoard(plant, board), board.info(plant)
    if source == "observer":
        config = settings(model or plant, info, **changes)  # type: ignore[arg-type]
    else:
        config = config_of({**DEFAULTS, **changes}, info, model)  # type: ignore[dict-item]
    line = LostLine(strays, tau / edges, reference, regular=hum)
    state, voltage, fastest = controller.State(), 0.0, 0.0
    for k in range(round(duration * rate)):
        time = k / rate
        sample = line.report(simulated.sample(voltage), time >= lost)
        fastest = max(fastest, abs(simulated.speed)) if time >= lost else 0.0
        output, state = controller.update(config, state, sample, reference if k == round(asked * rate) else None, time)
        voltage = output.terms.voltage
        if state.latched:
            return Loss(time - lost, fastest, output.reason)
    return Loss(None, fastest, output.reason)
