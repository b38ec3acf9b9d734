"""Detect hum in the place of a motor's edges, by their rhythm and by what they do not answer to.

`insensitive_speed` tells any speed that no voltage changes, and has to let be what a heavy load may do. Two things make
an even rhythm doubtful by itself, so that less is enough:

    mains        it is at a rate of the mains (`Rhythm.hums`)
    jump         it was there from one edge to the next in the place of another one. A load that brakes a motor changes
                 its speed over a time constant, and by the same share from edge to edge; what jumps and is even from
                 then on is no motor that has come to another equilibrium

and then it is hum

    under 0 V    of the mains: a motor that is driven by nothing becomes slower; hum from the start is told before the
                 motor moves
    beside more  they are not at the speed that is wanted, and the voltage is `LOAD` more than a steady motion before,
                 or the model, needed for theirs; a load may have come, but it would have to grow with the voltage, and
                 hold the motor at such a rate just so

A motor that does as it is told at such a rate is none, whatever its load. What brakes a motor on a disc that is more
even than 0.6 % to 50, 60, 100 or 120 edges a second is stopped for hum: it gets more voltage than it needs, and does
not reach its speed.
"""

from dataclasses import dataclass
from math import inf

from motor_control.controller.faults.evidence import USUAL_TIME_CONSTANT, Config, Seen
from motor_control.controller.faults.insensitive_speed import SLOWEST
from motor_model.frozen_record import replace
from motor_model.sensing.mains_rhythm import EDGES, EVEN, WITHIN

AT_REST = 0.5  # [s] of hum under 0 V; and as long as a flywheel that coasts would take to cross the rate of the mains
SOME_REST = 0.1  # [s] of it after which nothing holds this speed
ELSEWHERE = 0.02  # of the reference, from which they are away: a loop with an integral is nearer
# Of the voltage limit, that a load may take beside what is known of it. At a rate of the mains as much as any load may;
# after a jump a little more, because it may be any rate; where both agree, what a steady motion is off.
LOAD, LOAD_JUMP, LOAD_BOTH = 0.25, 0.3, 0.1
EXCESS = 0.15  # of stall_time that the whole voltage may be in excess
JUMP = 0.05  # share by which a rhythm differs from the one before
KEPT = 0.01  # share by which it may drift since then: a motor that spins up has even edges, too
AT_ONCE = 0.5  # of the time constant: in so long a load changes a speed, and there is no jump
SENTENCE = (
    "The encoder's line hums with {:.0f} Hz: {}. See whether the encoder is connected, its line has a pull-up and is "
    "away from the mains."
)
UNDER_NOTHING = "the edges come with the motor at 0 V, and become no fewer"
UNDER_MORE = "{:.3g} V change nothing, and {:.3g} V are enough for such a speed"


@dataclass(frozen=True)
class State:
    """What held the motor before the rhythm began, and what it has had beyond that."""

    edges: int = 0  # in the rhythm
    holding: float = inf  # [V] for the speed of the rhythm; infinite: not known
    excess: float = 0.0  # [s] of the whole voltage
    begun: int = 0  # [ns] when the rhythm began
    jumped: float = 0.0  # [s] its period, if it did so at once in the place of another one, and has kept it since
    period: float = 0.0  # [s] of the latest rhythm that has lasted; 0: there was none
    latest: int = 0  # [ns] its latest edge

    def begin(self, edges: int, holding: float, begun: int) -> "State":
        """Begin another rhythm; what is learnt from now on may be learnt of hum."""
        return State(edges, holding, 0.0, begun, 0.0, self.period, self.latest)


def check(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check one sample: a sentence if the motor has to stop, else ""."""
    rhythm, limit = seen.rhythm, seen.voltage_limit
    if config.slot == 0.0 or config.stall_time == 0.0 or limit <= 0.0:
        return "", State()
    if rhythm.period == 0.0:
        return "", state.begin(0, inf, rhythm.edge_time)
    speed = config.slot / rhythm.period
    if rhythm.edges < max(state.edges, 1):
        return "", state.begin(rhythm.edges, find_holding_voltage(config, seen, speed), rhythm.edge_time)
    state = _follow_rhythm(config, state, seen)
    if not (rhythm.hums or state.jumped > 0.0 and rhythm.even):
        return "", state
    rate, time_constant = 1.0 / rhythm.period, config.time_constant or SLOWEST
    if rhythm.at_rest >= max(AT_REST, 2.0 * WITHIN * time_constant):
        return SENTENCE.format(rate, UNDER_NOTHING), state
    voltage = seen.motion.slow_voltage
    if rhythm.at_rest >= SOME_REST:
        state = replace(state, holding=0.0)
    load = LOAD if state.jumped == 0.0 else LOAD_BOTH if rhythm.hums else LOAD_JUMP
    excess = (voltage - state.holding) / limit - load
    elsewhere = abs(abs(seen.reference) - speed) > ELSEWHERE * abs(seen.reference)  # false under a plain voltage
    state = replace(state, excess=state.excess + excess * seen.dt if elsewhere and excess > 0.0 else 0.0)
    patience = max(EXCESS * config.stall_time, 2.0 * EVEN * time_constant)
    told = state.excess >= patience
    return (SENTENCE.format(rate, UNDER_MORE.format(voltage, state.holding)) if told else ""), state


def _follow_rhythm(config: Config, state: State, seen: Seen) -> State:
    """Follow a rhythm that goes on; once it has lasted, see whether it came in the place of another one."""
    rhythm = seen.rhythm
    if rhythm.edges < EDGES:
        return replace(state, edges=rhythm.edges)
    jumped = state.jumped
    if state.edges < EDGES:
        took = (state.begun - state.latest) * 1e-9 - rhythm.period  # to the edge at which its first period begins
        at_once = took <= AT_ONCE * (config.time_constant or USUAL_TIME_CONSTANT)
        other = state.period > 0.0 and abs(rhythm.period / state.period - 1.0) > JUMP
        jumped = rhythm.period if at_once and other else 0.0
    if abs(rhythm.period - jumped) > KEPT * jumped:
        jumped = 0.0
    return replace(state, edges=rhythm.edges, jumped=jumped, period=rhythm.period, latest=rhythm.edge_time)


def find_holding_voltage(config: Config, seen: Seen, speed: float) -> float:
    """Find the voltage [V] that holds a speed [rad/s], by the model or the last steady motion; infinite: not known."""
    motion, limit = seen.motion, seen.voltage_limit
    kv = config.kv or limit / motion.fastest(limit)
    if motion.steady_voltage > 0.0:
        return max(motion.steady_voltage + kv * (speed - motion.steady_speed), kv * speed)
    return config.friction + kv * speed if config.kv else inf
