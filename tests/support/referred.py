"""Samples of a plant, one by one, for a controller that has a reference: what the tests of references share."""

from dataclasses import replace
from math import nan

from bench_board import DEFAULTS

from motor_control.configuration import config_of
from motor_control.controller import controller
from motor_control.controller.controller import Config, State
from motor_control.controller.output import RUNNING, Output
from motor_model.sample import Info, Sample

CONFIG = config_of(DEFAULTS, Info())
MS = 1_000_000


def feed(
    state: State,
    times: list[int],
    fresh: float | None = None,
    config: Config = CONFIG,
    later: float = 0.0,
    on: bool = True,
) -> tuple[Output, State]:
    """Samples at these times [ms] on the plant's clock, `later` [s] on ours; a reference may come with the first."""
    for k, time in enumerate(times):
        voltage = state.run.asked if state.run and on else 0.0
        sample = Sample(time * MS, 50.0, voltage, 4 * time // 5 + 1, time * MS - 9, 1.3e-3)
        output, state = controller.update(config, state, sample, fresh if k == 0 else None, time * 1e-3 + later)
    return output, state


def running() -> State:
    output, state = feed(State(), list(range(0, 200, 5)), 60.0)
    assert output.state == RUNNING and output.terms.voltage > 0.0
    return state


OBSTACLES: dict[str, tuple[Config, float, float]] = {  # config, speed that is said, age [s] of the samples
    "speed = nan": (CONFIG, nan, 0.0),
    "sample_period = 0": (replace(CONFIG, unusable="motor/info says sample_period = 0."), 0.0, 0.0),
    "The sample is": (CONFIG, 0.0, 0.1),
    "voltage_limit is 0 V": (replace(CONFIG, voltage_limit=0.0), 0.0, 0.0),
}
