"""How to control, and what a run remembers from one sample to the next."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import inf
from typing import TYPE_CHECKING

from motor_control.checks import at_least
from motor_control.controller import pi
from motor_control.controller.faults import detection
from motor_control.controller.faults.evidence import Config as FaultConfig
from motor_control.controller.motion import Motion
from motor_control.controller.reference import position_law
from motor_control.controller.timing.latency import Echo
from motor_model.sample import Sample
from motor_model.sensing.mains_rhythm import Rhythm

if TYPE_CHECKING:  # they compile; who has no model does not wait for that
    from motor_control.controller.feedforward import FeedForward
    from motor_control.controller.observer import Observer
    from motor_control.controller.observer import State as Watched


@dataclass(frozen=True, slots=True)
class Config:
    """How to control.

    Raises:
        MotorError: a value is negative or not finite.
    """

    gains: pi.Config
    voltage_limit: float  # [V]
    sample_timeout: float  # [s] silence after which there is no plant
    reference_rate_limit: float  # [rad/s²] 0: none
    reversal_speed: float  # [rad/s] up to which one channel may be pushed against its motion; 0: found by itself
    single_channel: bool = True  # the encoder does not measure direction
    faults: FaultConfig = FaultConfig()
    observer: Observer | None = None  # None: the law goes by the reported speed
    feedforward: FeedForward | None = None
    note: str = ""  # what was asked for and cannot be had
    plug_limit: float = 2.0  # of voltage_limit: largest difference of voltage and back-EMF against a motion; 2: any
    latency_limit: float = inf  # [s] age of a sample that is too old to act on
    reference_timeout: float = 0.0  # [s] after which a reference is dropped; 0: never
    sample_period: float = 0.0  # [s] 0: not known
    gentle: float = 0.0  # [s] steps that the rate limit does in this time are left to the loop: no slope is fed forward
    position: position_law.Config | None = None  # None: no angle can be approached
    no_position: str = ""  # why not
    joint_timeout: float = 0.0  # [s] after which a command of motor/joint_command is dropped; 0: never
    joint: str = ""  # name of this motor in motor/joint_command
    effort_as_voltage: bool = False  # of motor/joint_command
    unusable: str = ""  # what the plant says of itself and cannot be
    resting: pi.Config = field(init=False, repr=False)  # the gains without the integral's

    def __post_init__(self) -> None:
        at_least(0.0, voltage_limit=self.voltage_limit, sample_timeout=self.sample_timeout)
        at_least(0.0, reference_rate_limit=self.reference_rate_limit, reversal_speed=self.reversal_speed)
        at_least(0.0, plug_limit=self.plug_limit, reference_timeout=self.reference_timeout)
        at_least(0.0, joint_timeout=self.joint_timeout)
        object.__setattr__(self, "resting", replace(self.gains, ki=0.0))


@dataclass(frozen=True)
class Run:
    """What is remembered from one sample to the next while running; a run ends with every stop, gap and restart."""

    config: Config
    sample_time: int  # [ns]
    reference: float  # [rad/s] behind the rate limit
    law: pi.State
    motion: Motion
    reversing: bool = False
    watched: Watched | None = None  # the observer's
    asked: float = 0.0  # [V] the latest answer
    ignored: float = 0.0  # [s] for which the plant has applied nothing of what was asked
    faults: detection.State = detection.State()
    begins: bool = False  # with this sample: the reference has a sample period to start in
    place: position_law.State | None = None  # of an angle that is approached
    rests: bool = False  # it has come to rest at a reference of 0
    rhythm: Rhythm = Rhythm()  # of the edges, this sample's included
    echo: Echo = Echo()  # of what was asked for
    caution: str = ""  # why the voltage stays near what held the speed; "": it need not
    paused: bool = False  # 0 V was sent since this sample, whatever the law said: the integral has no part in the error


def begin(config: Config, sample: Sample, motion: Motion | None = None, faults: detection.State | None = None) -> Run:
    """Begin a run at the motor's own speed; motion, faults: what is known from a run before that ended just now."""
    known = motion or Motion()
    motion = replace(known, edge_count=sample.edge_count, speed=abs(sample.speed), slow_speed=abs(sample.speed))
    volts = abs(sample.voltage)
    motion = replace(motion, steady=0.0, silent=0.0, edges=0, voltage=volts, slow_voltage=volts)
    watched = config.observer.begin(sample, sample.speed) if config.observer else None
    state = detection.begin(sample.speed, faults)
    return Run(config, sample.sample_time, sample.speed, pi.State(), motion, watched=watched, faults=state, begins=True)
