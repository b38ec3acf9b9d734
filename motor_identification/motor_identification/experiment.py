"""An experiment: a profile as one command per sample, the same for a live plant and for a simulated one."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from math import floor

import numpy as np

from motor_identification.recording import Floats
from motor_model.errors import MotorError
from motor_model.excitation import Profile
from motor_model.parameters import Parameters
from motor_model.sample import Sample
from motor_model.sensing.board import BoardConfig, SimulatedBoard
from motor_model.simulate import simulate

LEAD = 0.1  # [s] at 0 V before the profile: a recording that starts at rest needs no initial speed
_STEP = 1e-3  # [V] a peak that a speed limits is rounded down to
_MOVING = 0.1  # of the limit: a motor that stays slower does not show what the profile is for


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

    def words(self) -> dict[str, str]:
        """The plan as it stands in a bag, for people and programs; numbers are in V and s."""
        return {
            "profile": self.profile.name,
            "shows": self.profile.shows,
            "voltage": repr(float(self.voltage)),
            "lead": repr(LEAD),
            "duration": repr(round(self.duration, 9)),
            "sample_period": repr(float(self.sample_period)),
        }


def announce(plan: Plan, motor: str, max_voltage: float, limit: float | None) -> str:
    """Announce what is about to happen to a motor, and what limits it, in two or three sentences.

    limit: [rad/s] the speed at which the experiment is stopped; None: there is none.
    """
    low, high = float(np.min(plan.commands)), float(np.max(plan.commands))
    span = f"-{-low:.4g} to {high:.4g} V, both ways" if low < 0.0 < high else f"up to {max(high, -low):.4g} V, one way"
    peak = "all that the plant has; less with --voltage" if plan.voltage == max_voltage else f"of {max_voltage:g} V"
    speed = "is not limited (--speed)" if limit is None else f"is limited to {limit:g} rad/s"
    return (
        f"Driving '{motor}' through '{plan.profile.name}' for {plan.duration:.1f} s: {span} ({peak}). "
        f"The speed {speed}. Ctrl-C stops the motor."
    )


def make_plan(profile: Profile, voltage: float | None, max_voltage: float, sample_period: float) -> Plan:
    """Make a plan for a plant; without a voltage it uses all the plant has.

    Raises:
        MotorError: the voltage is not positive or more than the plant has.
    """
    wanted = max_voltage if voltage is None else voltage
    if not 0.0 < wanted <= max_voltage:
        raise MotorError(f"--voltage {wanted:g} is not between 0 and the plant's max_voltage, {max_voltage:g} V.")
    return Plan(profile, wanted, sample_period)


def slowed(plan: Plan, parameters: Parameters, limit: float) -> Plan:
    """Return the plan with the largest peak, at most its own, that keeps a motor within a speed [rad/s] all the time.

    Raises:
        MotorError: no voltage does, or only one that hardly moves the motor (with static friction it stands or runs).
    """
    if _fastest(plan, parameters) <= limit:
        return plan
    low, high = 0.0, plan.voltage
    while high - low > 0.1 * _STEP:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _fastest(replace(plan, voltage=middle), parameters) <= limit else (low, middle)
    slow = replace(plan, voltage=round(floor(low / _STEP) * _STEP, 9))
    if slow.voltage == 0.0 or _fastest(slow, parameters) < _MOVING * limit:
        raise MotorError(
            f"--speed {limit:g} rad/s leaves nothing of '{plan.profile.name}': '{parameters.name}' hardly moves up to "
            f"{low:.3g} V, and goes faster than that with more; allow more speed."
        )
    return slow


def _fastest(plan: Plan, parameters: Parameters) -> float:
    """[rad/s] what the motor reaches in the plan, in either direction."""
    time = np.arange(len(plan.commands), dtype=np.float64) * plan.sample_period
    return float(np.max(np.abs(simulate(parameters, time, plan.commands, time).speed)))


def simulate_plan(plan: Plan, parameters: Parameters, config: BoardConfig) -> Iterator[tuple[float, Sample]]:
    """Return the commands [V] and what a simulated board reports, sample by sample."""
    board = SimulatedBoard(parameters, config)
    for command in plan.commands:
        yield float(command), board.sample(float(command))
