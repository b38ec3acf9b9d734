"""The encoder as a tuning sees it: where its edges are, how certain that is, and who makes a speed of them."""

from dataclasses import dataclass
from math import sqrt, tau
from typing import Protocol

from motor_control.checks import at_least
from motor_control.tuning.linear_loop import Gains, Plant
from motor_control.tuning.margins import Loop
from motor_model.errors import MotorError

MEASURED, OBSERVER = "measured", "observer"  # the controller's `speed_source`
PEAK_TO_PEAK = 5.0  # σ, of a noise over half a second with some tens of independent values


@dataclass(frozen=True, slots=True)
class Encoder:
    """The disc and the timer that stamps its edges.

    Raises:
        MotorError: a number is not finite or below what makes sense.
    """

    edges_per_revolution: int = 96
    slot_irregularity: float = 0.01  # standard deviation of an edge's place, as a share of a slot
    edge_resolution: float = 4e-6  # [s]
    gear_ratio: float = 1.0  # encoder turns per turn of the output, which speeds are of

    def __post_init__(self) -> None:
        at_least(0.0, slot_irregularity=self.slot_irregularity, edge_resolution=self.edge_resolution)
        if self.edges_per_revolution < 1:
            raise MotorError(f"edges_per_revolution = {self.edges_per_revolution} does not work: give at least 1.")

    @property
    def slot(self) -> float:
        """[rad] of the output between two edges."""
        return tau / (self.edges_per_revolution * self.gear_ratio)

    def edge_noise(self, speed: float) -> float:
        """[rad] standard deviation of the angle that an edge stands for, at a speed [rad/s]."""
        return sqrt((self.slot_irregularity * self.slot) ** 2 + (speed * self.edge_resolution) ** 2 / 12.0)


@dataclass(frozen=True, slots=True)
class Ripple:
    """Swings at a constant reference, peak to peak."""

    speed: float  # share of the reference, of the shaft
    reported: float  # share of the reference, of the speed the law sees
    voltage: float  # [V]


class Sight(Protocol):
    """How the law sees the speed; each says what that makes of the loop at a constant speed [rad/s]."""

    @property
    def encoder(self) -> Encoder:
        """What the speed is made of."""

    @property
    def name(self) -> str:
        """The controller's `speed_source`."""

    @property
    def bound(self) -> str:
        """What bounds the loop beyond sampling and bridge; {} stands for the lowest speed [rad/s]."""

    def plant(self, bare: Plant, speed: float) -> Plant:
        """The motor as the law sees it."""

    def law(self, gains: Gains) -> Gains:
        """The gains that act: with an observer's load in the feed-forward the integral does not."""

    def forward(self, plant: Plant, reference: float) -> float:
        """[V] that the feed-forward adds."""

    def fastest(self, bare: Plant, speeds: tuple[float, ...]) -> float:
        """The largest kp [V/(rad/s)] that keeps the loop calm at these speeds."""

    def loop(self, bare: Plant, gains: Gains, speed: float) -> Loop:
        """L(z), cut open at the voltage."""

    def ripple(self, bare: Plant, gains: Gains, speed: float) -> Ripple:
        """What the encoder makes of a constant reference."""


def cancelling(plant: Plant, kp: float) -> Gains:
    """ki/kp = kv/ka: the zero of the law cancels the pole of the motor."""
    return Gains(kp, kp * plant.kv / plant.ka)
