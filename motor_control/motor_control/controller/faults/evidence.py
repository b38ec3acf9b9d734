"""What a fault is told by: what is known of the motor, and what a sample shows."""

from dataclasses import dataclass
from math import inf, nan, sqrt

from motor_control.checks import at_least
from motor_control.controller.motion import Motion
from motor_model.sample import Sample
from motor_model.sensing.mains_rhythm import Rhythm

FULL = 0.98  # of the voltage limit
ALL = 0.93  # of a measured supply below it, which a driver smooths by as much as 5 %: there is no more
# Times a measured supply: a motor that gets more disproves it, as with a divider that has come loose. A driver takes
# the voltage of a smoothed supply: while the measured one falls, it is more by what the noise and the sag have (5 %).
DISPROVED = 1.1
# Of the voltage limit that a load may take before anything is wrong. A motor with two channels may hold a weight, and
# the weight drives it where it falls: of a load of a quarter of the stall torque only the difference is known. With one
# channel friction has to hold 0 rad/s, so that a load is no larger than friction.
SPARE, SPARE_SINGLE = 0.25, 0.15
MORE = 1.25  # times the friction of the model that may be needed without a fault
# Of the voltage limit, that a load takes at most beside friction: no steady motion is learnt to need more. More than
# twice `SPARE`: a random torque, a sagging supply and a model some per cent off have what is left of it.
HEAVY = 0.6
KEPT = 0.75  # of the voltage of the last steady motion that may be needed at a standstill: the rest was back-EMF
USUAL_TIME_CONSTANT = 0.05  # [s] of a motor of which there is no model


@dataclass(frozen=True, slots=True)
class Config:
    """When to stop, and what the motor is like.

    Raises:
        MotorError: a value is negative or not finite.
    """

    stall_time: float = 0.5  # [s] 0: never
    fastest: float = inf  # [rad/s] by the model; infinite without one
    slot: float = 0.0  # [rad] between edges; 0: they are not counted
    even: bool = True  # one flank a period is counted; several are as uneven as the sensor
    few_slots: int = 0  # of the disc, if they are so few that each is known again after a turn; 0: they are many
    tick: float = 0.0  # [s] to which the period between edges is known
    kv: float = 0.0  # [V·s/rad] by the model; 0: there is none
    time_constant: float = 0.0  # [s] ka/kv, and delay
    spare: float = SPARE  # of the voltage limit that a load may take
    two_channels: bool = False  # the encoder measures the direction
    friction: float = 0.0  # [V] that the model needs to break loose, loads and dead zone included

    def __post_init__(self) -> None:
        at_least(0.0, stall_time=self.stall_time)


@dataclass(frozen=True, slots=True)
class Seen:
    """What a sample shows."""

    sample: Sample
    speed: float  # [rad/s] that the law uses
    motion: Motion
    reference: float  # [rad/s]
    dt: float  # [s] since the sample before
    voltage_limit: float  # [V]
    innovation: float = nan  # [rad] angle at the latest edge less the observer's prediction; NaN: no observer
    rhythm: Rhythm = Rhythm()
    asked: float = nan  # [V] the answer to the sample before
    plugs: bool = False  # the law asks for all the voltage against the motion that `plug_limit` leaves
    cautious: bool = False  # the voltage stays near what held the speed, as the controller is held up

    @property
    def full(self) -> bool:
        """Whether the motor gets all that it may."""
        supply, most, given = self.sample.supply_voltage, FULL * self.voltage_limit, abs(self.sample.voltage)
        if supply > 0.0 and given <= DISPROVED * supply:  # false if it is not measured
            most = min(most, ALL * supply)
        return given >= most > 0.0


def find_allowed_voltage(config: Config, motion: Motion, voltage_limit: float, voltage: float) -> float:
    """Find the voltage [V] that a motor of this motion may need without a fault, by the model or by what was learnt.

    voltage [V]: what it gets. The load that may have helped the last steady motion is against one the other way, so
    that twice as much may be needed there.
    """
    if config.kv > 0.0:
        load = max(config.friction, motion.steady_voltage - config.kv * motion.steady_speed)
        load = min(MORE * load + config.spare * voltage_limit, config.friction + HEAVY * voltage_limit)
        return load + config.kv * motion.speed
    loads = 2.0 if voltage * motion.steady_way < 0.0 else 1.0
    return KEPT * motion.steady_voltage + loads * config.spare * voltage_limit


def find_push_time(config: Config, top_speed: float, torque: float, slots: float) -> float:
    """Find the time [s] in which a torque, a share of the stall torque, moves the motor from rest by some slots.

    With a top speed w and a time constant τ it is sqrt(2 slots τ/(torque w)).
    """
    return sqrt(2.0 * slots * config.slot * (config.time_constant or USUAL_TIME_CONSTANT) / (torque * top_speed))
