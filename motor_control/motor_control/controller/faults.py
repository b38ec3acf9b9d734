"""Detect faults that stop the motor for good: edges and voltage cannot belong to one motor that runs as it should.

    stall      full voltage, and fewer edges than can be told from a standstill for `stall_time`
    too few    the motor turns slower than 30 % of what the model predicts, or of what it last did under less voltage,
               while the voltage rises: a line that is lost (whether or not noise still counts), a shaft that is held
    irregular  full voltage, and periods that jump: noise, no motor
    runaway    the voltage is 0 or strongly against the motion, and yet the speed grows: a wrong sign, a bridge that
               stays on, a load
    overspeed  faster than full voltage can drive the motor of the model: edges that are none, or a load

The speed is the one the law uses, or counted edges (`motion`); the voltage is the one the plant says it applies; times
are the plant's. All bounds are shares of the motor's own top speed, slot rate and voltage.
"""

from dataclasses import dataclass, replace
from math import copysign, exp, inf, log

from motor_control.checks import at_least
from motor_control.controller.motion import FAST, Motion
from motor_model.sample import Sample

FULL = 0.98  # of the voltage limit
REPORTABLE = 10.0  # [edges/s] slower than this, every plant reports a standstill
RUNAWAY_TIME = 0.25  # [s] longer than any plant takes to see that a single channel has turned round
RUNAWAY_GROWTH = 1.2  # of the smallest speed since then; and on top
RUNAWAY_SHARE = 0.06  # of the top speed; where that is not known, [edges/s] at 0 V, and in the average's 50 ms else:
RUNAWAY_RATE, RUNAWAY_EDGES, RUNAWAY_UNKNOWN = 150.0, 2.0, 2.0  # the latter: growth, then
STRONG = 0.5  # of the voltage limit; below, and not 0 V, a loop answers a load that drives the motor
OVERSPEED, OVERSPEED_TIME = 1.3, 0.05  # of what the supply gives; [s]: not one period of a doubtful edge
FEW = 0.3  # of the expected speed; a load that slows a motor down to this takes 70 % of its stall torque
FORGET = 0.3  # [s] time constant with which that is forgotten while edges fit
BEHIND = 0.5  # of the reference: a motor that turns as it is told has no fault, whatever its load
GROWING = 1.2  # of the average of the last 0.15 s: a heavy disc that is still being spun up
SPARE = 0.15  # of the voltage limit that a load may take before anything is wrong
MORE = 1.25  # times the friction of the model that may be needed without a fault
KEPT = 0.75  # of the voltage of the last steady motion that may be needed at a standstill: the rest was back-EMF
SILENT = 0.1  # [s] without an edge, and so many slots in which some should have come:
SILENT_SLOTS = 5.0
SILENT_EXCESS, FEW_EXCESS = 0.1, 0.35  # of stall_time that the whole voltage may be in excess: no edge, too few
IRREGULAR, IRREGULAR_EDGES = (
    0.7,
    12.0,
)  # mean |log| of the ratio of successive periods; random edges make 1.2, discs 0.3

STALL = (
    "The motor got {:.3g} V for {:.2g} s, all it may get, and no edge came (or not 10 a second): see whether the shaft "
    "is blocked, the encoder or the motor is not connected, or voltage_limit is too low."
)
TOO_FEW = (
    "Edges do not fit the voltage: {:.3g} V, and {:.1f} rad/s where {:.1f} rad/s are expected. See whether the shaft "
    "is blocked, the encoder is connected, and its line quiet."
)
IRREGULAR_SAID = (
    "Edges do not fit the voltage: their periods jump by a factor of {:.2g} on average at a constant {:.3g} V. See "
    "whether the encoder's line is connected and quiet."
)
RUNAWAY = (
    "The speed grew from {:.3g} to {:.3g} rad/s although the voltage was 0 or against it: see whether motor and encoder"
    " agree on the direction, the bridge obeys, or a load drives the motor."
)
OVERSPEED_SAID = (
    "The motor turns at {:.4g} rad/s, and by its model no more than {:.4g} are possible: see whether the encoder's line"
    " is disturbed, or the model is another motor's."
)


@dataclass(frozen=True, slots=True)
class Config:
    """When to stop, and what the motor is like.

    Raises:
        MotorError: a value is negative or not finite.
    """

    stall_time: float = 0.5  # [s] 0: never
    fastest: float = inf  # [rad/s] by the model; infinite without one
    slot: float = 0.0  # [rad] between edges; 0: they are not counted
    kv: float = 0.0  # [V·s/rad] by the model; 0: there is none
    time_constant: float = 0.0  # [s] ka/kv, and delay
    friction: float = 0.0  # [V] that the model needs to break loose, loads and dead zone included

    def __post_init__(self) -> None:
        at_least(0.0, stall_time=self.stall_time)


@dataclass(frozen=True, slots=True)
class State:
    """For how long each has been so [s], and what it is compared with."""

    stalled: float = 0.0
    stall_edges: int = 0
    undriven: float = 0.0
    slowest: float = inf  # [rad/s] since then; 0 from a standstill on
    too_fast: float = 0.0
    expected: float = 0.0  # [rad/s] signed, of the model without a load
    excess: float = 0.0  # [s] of the whole voltage, while edges were too few
    travel: float = 0.0  # [rad] that is expected since the latest edge
    period: float = 0.0  # [s] of the latest edges
    jumps: float = 0.0  # mean |log| of the ratio of successive periods
    periods: int = 0  # how many came under full voltage


@dataclass(frozen=True, slots=True)
class Seen:
    """What a sample shows."""

    sample: Sample
    speed: float  # [rad/s] that the law uses
    motion: Motion
    reference: float  # [rad/s]
    dt: float  # [s] since the sample before
    voltage_limit: float  # [V]


def find_fault(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Find a fault: a sentence if the motor has to stop, else ""."""
    checks = (check_stall, check_too_few, check_irregular, check_runaway, check_overspeed)
    reason = ""
    for check in checks:
        said, state = check(config, state, seen)
        reason = reason or said
    return reason, state


def check_stall(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check for full voltage with fewer edges than can be told from a standstill."""
    voltage = seen.sample.voltage
    stalled, edges = state.stalled + seen.dt, state.stall_edges + seen.motion.edges
    still = edges <= 1.0 + REPORTABLE * stalled if config.slot > 0.0 else seen.sample.speed == 0.0
    if not (abs(voltage) >= FULL * seen.voltage_limit > 0.0 and still):
        stalled, edges = 0.0, 0
    reason = STALL.format(voltage, stalled) if 0.0 < config.stall_time <= stalled else ""
    return reason, replace(state, stalled=stalled, stall_edges=edges)


def check_too_few(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check for edges that are too few for the voltage, by the model or by the last steady motion."""
    motion, voltage, limit = seen.motion, abs(seen.sample.voltage), seen.voltage_limit
    state = replace(state, expected=predict_speed(config, state.expected, seen))
    spare = SPARE * limit
    if config.kv > 0.0:
        load = max(config.friction, motion.steady_voltage - config.kv * motion.steady_speed)
        expected, allowed = abs(state.expected), MORE * load + config.kv * motion.speed + spare
    else:
        expected, allowed = motion.steady_speed, KEPT * motion.steady_voltage + spare
    obeys = motion.speed >= BEHIND * abs(seen.reference) and state.jumps < IRREGULAR
    fits = motion.speed >= FEW * expected or obeys or voltage <= allowed
    if fits or seen.dt <= 0.0:
        return "", replace(state, excess=state.excess * exp(-max(seen.dt, 0.0) / FORGET), travel=0.0)
    growing = motion.speed > GROWING * motion.slow_speed and motion.speed > 2.0 * config.slot / FAST
    excess = state.excess + (0.0 if growing else (voltage - allowed) / limit * seen.dt)
    travel = 0.0 if motion.edges else state.travel + expected * seen.dt
    silent = motion.silent >= SILENT and travel >= SILENT_SLOTS * config.slot
    bound = config.stall_time * (SILENT_EXCESS if silent else FEW_EXCESS)
    reason = TOO_FEW.format(voltage, motion.speed, expected) if excess >= bound > 0.0 else ""
    return reason, replace(state, excess=excess, travel=travel)


def predict_speed(config: Config, expected: float, seen: Seen) -> float:
    """Predict the speed [rad/s] of the model without a load one sample on."""
    if config.kv == 0.0 or seen.dt <= 0.0:
        return expected
    drive = max(abs(seen.sample.voltage) - config.friction, 0.0)
    final = copysign(drive, seen.sample.voltage) / config.kv
    return expected + (final - expected) * (1.0 - exp(-seen.dt / config.time_constant))


def check_irregular(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check for periods that jump while the voltage is constant and full."""
    sample, period = seen.sample, seen.sample.edge_period
    full = abs(sample.voltage) >= FULL * seen.voltage_limit > 0.0
    state = state if full else replace(state, periods=0)
    if seen.motion.edges == 0 or period <= 0.0 or config.slot == 0.0:
        return "", state
    if state.period == 0.0:
        return "", replace(state, period=period)
    jumps = state.jumps + (min(abs(log(period / state.period)), 2.0) - state.jumps) / IRREGULAR_EDGES
    after = replace(state, period=period, jumps=jumps, periods=state.periods + full)
    if after.periods < IRREGULAR_EDGES or jumps < IRREGULAR or config.stall_time == 0.0:
        return "", after
    return IRREGULAR_SAID.format(exp(jumps), abs(sample.voltage)), after


def check_runaway(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check for a speed that grows without a voltage that drives it."""
    fast = seen.motion.speed
    if seen.speed == 0.0:
        return "", replace(state, undriven=0.0, slowest=0.0)
    voltage = seen.sample.voltage
    if voltage * seen.speed > 0.0 or 0.0 < abs(voltage) < STRONG * seen.voltage_limit:
        return "", replace(state, undriven=0.0, slowest=inf)
    undriven = state.undriven + seen.dt
    slowest = min(state.slowest, max(fast, abs(seen.speed)))  # the average is late, the reported speed irregular
    learnt, least = seen.motion.fastest(seen.voltage_limit), RUNAWAY_EDGES / FAST * config.slot
    if config.fastest < inf:
        rise, growth = RUNAWAY_SHARE * config.fastest, RUNAWAY_GROWTH
    elif learnt < inf or voltage:  # a motor that has only been seen under a load may be much faster than that says
        rise, growth = max(RUNAWAY_SHARE * learnt if learnt < inf else 0.0, least), RUNAWAY_UNKNOWN
    else:
        rise, growth = RUNAWAY_RATE * config.slot, RUNAWAY_UNKNOWN
    away = undriven >= RUNAWAY_TIME and fast > growth * slowest + rise
    reason = RUNAWAY.format(slowest, fast) if away else ""
    return reason, replace(state, undriven=undriven, slowest=slowest)


def check_overspeed(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check for a speed that the model cannot reach."""
    fast = abs(seen.speed)
    too_fast = state.too_fast + seen.dt if fast > OVERSPEED * config.fastest else 0.0
    reason = OVERSPEED_SAID.format(fast, config.fastest) if too_fast >= OVERSPEED_TIME else ""
    return reason, replace(state, too_fast=too_fast)
