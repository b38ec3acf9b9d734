"""An experiment: a profile as one command per sample, the same for a live plant and for a simulated one."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from motor_identification.recording import Floats
from motor_model.board import BoardConfig, SimulatedBoard
from motor_model.errors import MotorError
from motor_model.excitation import Profile
from motor_model.parameters import Parameters
from motor_model.sample import Sample

LEAD = 0.1  # [s] at 0 V before the profile: a recording that starts at rest needs no initial speed


@dataclass(frozen=True)
class Plan:
    """What to apply when: the profile scaled to a voltage, on a plant's sampling grid."""

    profile: Profile
    voltage: float  # [V] its peak
    sample_period: float  # [s]

    @property
    def duration(self) -> float:
        """[s] with the rest before it."""
        return LEAD + self.profile.duration

    @cached_property
    def commands(self) -> Floats:
        """[V] one per sample, shape (K,)."""
        time = np.arange(0.0, self.duration, self.sample_period) - LEAD
        return self.profile.voltage(time, self.voltage)

    def command(self, elapsed: float) -> float | None:
        """[V] at `elapsed` [s] since the start; None when the plan is done."""
        k = round(elapsed / self.sample_period)
        return float(self.commands[k]) if 0 <= k < len(self.commands) else None


def make_plan(profile: Profile, voltage: float | None, max_voltage: float, sample_period: float) -> Plan:
    """A plan for a plant; without a voltage it uses all the plant has.

    Raises:
        MotorError: the voltage is not positive or more than the plant has.
    """
    wanted = max_voltage if voltage is None else voltage
    if not 0.0 < wanted <= max_voltage:
        raise MotorError(f"--voltage {wanted:g} is not between 0 and the plant's max_voltage, {max_voltage:g} V.")
    return Plan(profile, wanted, sample_period)


def simulate_plan(plan: Plan, parameters: Parameters, config: BoardConfig) -> Iterator[tuple[float, Sample]]:
    """The commands [V] and what a simulated board reports, sample by sample."""
    board = SimulatedBoard(parameters, config)
    for command in plan.commands:
        yield float(command), board.sample(float(command))
