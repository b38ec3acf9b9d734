"""Find what speaks against running: a latched stop, a setting, a sample or a demand that is none."""

from math import isfinite

from motor_control.controller.output import DISABLED, RUNNING, STOPPED
from motor_control.controller.reference.demand import Demand, Kind
from motor_control.controller.reference.position_law import FARTHEST
from motor_control.controller.run import Config
from motor_control.controller.state import NAMES, State
from motor_model.sample import Sample

NO_REFERENCE = "No reference yet: publish a speed in rad/s on motor/reference."
FRESH = "{} The motor waits for a fresh reference: publish a speed in rad/s on motor/reference."
NO_VOLTAGE = "voltage_limit is 0 V: set it to what the motor may get."
BAD_REFERENCE = "The reference is {}: publish a finite speed in rad/s on motor/reference."
# [rad/s] Any rotor would burst: the rim of one of 1 mm has 1 km/s. A number that is no speed, as of memory that nobody
# has set, or of another unit, is as a rule far beyond, and would be all the voltage for ever.
FASTEST = 1e6
TOO_FAST = "The reference is {:.3g} rad/s, faster than any motor turns: publish one in rad/s on motor/reference."
TOO_FAR = "The angle {:.3g} rad is farther than any motor turns: publish one in rad on motor/position_reference."
BAD_SAMPLE = "A sample on motor/speed says {} = {}: find out what is wrong with the plant."
CALL_RESET = "{} Call motor/reset, then publish a fresh reference, to go on."


def find_obstacle(config: Config, state: State, sample: Sample) -> tuple[str, str]:
    """Find why not to run, as state and reason; (running, "") where nothing speaks against it."""
    if state.latched:
        return STOPPED, explain_stop(state)
    if config.unusable:
        return STOPPED, config.unusable
    for name, value in (("speed", sample.speed), ("voltage", sample.voltage), ("edge_period", sample.edge_period)):
        if not isfinite(value):
            return STOPPED, BAD_SAMPLE.format(name, value)
    if state.demand is None:
        return DISABLED, FRESH.format(state.dropped) if state.dropped else NO_REFERENCE
    if config.voltage_limit == 0.0:  # who stands at 0 V for long has no reference any more: see reference/ending.py
        return STOPPED, NO_VOLTAGE
    return RUNNING, ""


def explain_stop(state: State) -> str:
    """Say why a stop is latched, and what ends it."""
    latched = CALL_RESET.format(state.latched.replace(NAMES, state.speakers))
    return " ".join(filter(None, (latched, state.stops.announce("motor/reset"))))


def is_finite(sample: Sample) -> bool:
    """Tell whether all that a law needs of a sample is a number."""
    return isfinite(sample.speed) and isfinite(sample.voltage) and isfinite(sample.edge_period)


def find_mistake(config: Config, demand: Demand, sample: Sample) -> str:
    """Find why a demand cannot be obeyed, as a sentence; "" if it can."""
    if not isfinite(demand.value - sample.speed):
        return BAD_REFERENCE.format(demand.value)
    if demand.kind is Kind.SPEED and abs(demand.value) > FASTEST:
        return TOO_FAST.format(demand.value)
    if demand.kind is Kind.POSITION and config.position is None:
        return config.no_position
    if demand.kind is Kind.POSITION and config.position and abs(demand.value / config.position.slot) > FARTHEST:
        return TOO_FAR.format(demand.value)
    return ""
