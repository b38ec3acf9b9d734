"""Detect edges that are too few for the voltage, by the model or by the last steady motion."""

from dataclasses import dataclass
from math import copysign, exp, inf

from motor_control.controller.faults.evidence import (
    HEAVY,
    KEPT,
    USUAL_TIME_CONSTANT,
    Config,
    Seen,
    find_allowed_voltage,
    find_push_time,
)
from motor_control.controller.motion import FAST

FEW = 0.3  # of the expected speed; a load that slows a motor down to this takes 70 % of its stall torque
SPIN_UP = 0.3  # [s] time constant that a motor may have of which there is no model
# [s] time constant with which what is expected falls meanwhile: stray edges close together make a loop take its voltage
# back for a sample or two, and the motor does not stand by that.
SPIN_DOWN = 0.05
FORGET = 0.3  # [s] time constant with which that is forgotten while edges fit
BEHIND = 0.5  # of the reference: a motor that turns as it is told has no fault, whatever its load up to `HEAVY`
GROWING = 1.2  # of the average of the last 0.15 s: a heavy disc that is still being spun up
SILENT = 0.1  # [s] without an edge, and so many slots in which some should have come:
SILENT_SLOTS = 5.0
# Slots by which what the voltage has in excess alone moves it: from one edge to the next, and half a slot of play.
PUSHED_SLOTS = 1.5
MOST_PUSH = 1e9  # [rad/s] where the top speed is not known: any voltage will do
SILENT_EXCESS, FEW_EXCESS = 0.07, 0.35  # of stall_time that the whole voltage may be in excess: no edge, too few
SENTENCE = (
    "Edges do not fit the voltage: {:.3g} V, and {:.1f} rad/s where {:.1f} rad/s are expected. See whether the shaft "
    "is blocked, the encoder is connected, and its line quiet."
)


@dataclass(frozen=True, slots=True)
class State:
    """What the motor should have done."""

    expected: float = 0.0  # [rad/s] signed, of the model without a load
    excess: float = 0.0  # [s] of the whole voltage, while edges were too few
    travel: float = 0.0  # [rad] that is expected since the latest edge
    pushed: float = 0.0  # [rad/s] from a standstill, by what the voltage has in excess since then
    moved: float = 0.0  # [rad] likewise


def check(config: Config, state: State, seen: Seen, regular: bool) -> tuple[str, State]:
    """Check one sample, whose edges are regular or not: a sentence if the motor has to stop, else ""."""
    motion, voltage, limit = seen.motion, abs(seen.sample.voltage), seen.voltage_limit
    if seen.dt <= 0.0:
        return "", state
    braking = seen.sample.speed * seen.sample.voltage < 0.0
    allowed = find_allowed_voltage(config, motion, limit, seen.sample.voltage)
    if config.kv > 0.0:
        foreseen = predict_speed(config, state.expected, seen)
    else:
        foreseen = extrapolate_speed(config, state.expected, seen, braking)
    expected = abs(foreseen)
    obeys = regular and min(motion.speed, motion.slow_speed) >= BEHIND * abs(seen.reference)
    if config.kv > 0.0:
        obeys &= voltage <= config.kv * motion.speed + config.friction + HEAVY * limit
    kept = state.excess * exp(-seen.dt / FORGET)
    if motion.speed >= FEW * expected or obeys:
        return "", State(foreseen, kept, 0.0)
    if voltage <= allowed:  # for now: a voltage that comes and goes is no other motion
        return "", State(foreseen, kept) if motion.edges else State(foreseen, kept, state.travel, 0.0, state.moved)
    growing = motion.speed > GROWING * motion.slow_speed and motion.speed > 2.0 * config.slot / FAST
    excess = state.excess + (0.0 if growing or braking else (voltage - allowed) / limit * seen.dt)
    travel, pushed, moved = state.travel + expected * seen.dt, state.pushed, state.moved
    if not braking:
        pushed, moved = push_motor(config, seen, voltage - allowed, pushed, moved)
    if motion.edges:
        travel = pushed = moved = 0.0
    silent = travel >= SILENT_SLOTS * config.slot and moved >= PUSHED_SLOTS * config.slot
    silent &= motion.silent >= max(SILENT, find_turn_time(config, seen, voltage - allowed))
    bound = config.stall_time * (SILENT_EXCESS if silent else FEW_EXCESS)
    reason = SENTENCE.format(voltage, motion.speed, expected) if excess >= bound > 0.0 else ""
    return reason, State(foreseen, excess, travel, pushed, moved)


def push_motor(config: Config, seen: Seen, voltage: float, speed: float, angle: float) -> tuple[float, float]:
    """Push a motor, without friction, at a speed [rad/s] and an angle [rad] by a voltage [V] for one more sample.

    A motor that crawls has been without an edge for long when its voltage rises, and only begins to turn.
    """
    lag = config.time_constant or USUAL_TIME_CONSTANT
    faster = min(voltage / seen.voltage_limit * find_top_speed(config, seen) / lag * seen.dt, MOST_PUSH)
    return speed + faster, angle + (speed + 0.5 * faster) * seen.dt


def find_top_speed(config: Config, seen: Seen) -> float:
    """Find the top speed [rad/s] by the model, or the least one that the motion proves; infinite: not known."""
    return config.fastest if config.fastest < inf else seen.motion.fastest(seen.voltage_limit)


def find_turn_time(config: Config, seen: Seen, voltage: float) -> float:
    """Find the time [s] without an edge in which a voltage [V] turns a motor round: within a slot, and out of it.

    It is what is left beyond a load that is allowed; a heavy motor takes long.
    """
    return 2.0 * find_push_time(config, find_top_speed(config, seen), voltage / seen.voltage_limit, 1.0)


def extrapolate_speed(config: Config, expected: float, seen: Seen, braking: bool) -> float:
    """Extrapolate the last steady speed [rad/s] to a voltage, of which a load takes `spare`, or helped by it."""
    motion, voltage = seen.motion, abs(seen.sample.voltage)
    if motion.steady_voltage == 0.0:
        return 0.0
    if braking or voltage <= KEPT * motion.steady_voltage:
        return expected * exp(-seen.dt / SPIN_DOWN)
    spare = config.spare * seen.voltage_limit
    final = motion.steady_speed * max((voltage - spare) / (motion.steady_voltage + spare), 1.0)
    return min(final, expected + (final - expected) * (1.0 - exp(-seen.dt / SPIN_UP)))


def predict_speed(config: Config, expected: float, seen: Seen) -> float:
    """Predict the speed [rad/s] of the model without a load one sample on."""
    if config.kv == 0.0 or seen.dt <= 0.0:
        return expected
    drive = max(abs(seen.sample.voltage) - config.friction, 0.0)
    final = copysign(drive, seen.sample.voltage) / config.kv
    return expected + (final - expected) * (1.0 - exp(-seen.dt / config.time_constant))
