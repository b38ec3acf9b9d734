"""Detect edges where the observer does not expect them: they are not those of the model's motor.

An innovation is the angle by which an edge comes earlier or later than predicted. Edges that have nothing to do with
the motor are off by half a slot on average, and each by something else. Those of the motor are off by little; where a
load has changed by much, all edges until the observer has taken it up, but the one by nearly as much as the next. So
what counts of an edge is

    min(|ν|, |ν - ν before|), at most `LARGEST`

and it is summed up less `ORDINARY`; the sum does not fall below 0 (Page, "Continuous inspection schemes", Biometrika
41, 1954). This tells noise where edges are too few for their periods to be judged (`irregular_edges`).

An edge that ends a turn, or has no period, does not count: where the shaft was before is a guess. Nor does one after a
period t in which a random torque T may move a motor of top speed w and time constant τ by `ORDINARY`, T w t²/2τ. Nor is
anything known where several flanks a period are counted (`Config.even`): they are off by up to half a slot, in turn,
for the sensor's sake; edges are many there, and have periods.
"""

from dataclasses import dataclass
from math import isfinite, sqrt

from motor_control.controller.faults.evidence import SPARE_SINGLE, Config, Seen
from motor_control.controller.faults.irregular_edges import LEAST_VOLTAGE

ORDINARY = 0.25  # of a slot: what edges of a motor stay below, also with a model some per cent off
LARGEST = 1.0  # of a slot: one edge proves little
TORQUE = 0.02  # of the stall torque, that no model knows of: 0.05 of it at random stopped one motor of 34, crawling
# [slots] of the sum. Of 860,000 edges of 401 random motors (4 hours) it was at most 1.05 with one channel, and 2.9 with
# two, where a load drags the motor through standstills: by the tail, one false stop in 100 hours each. Noise has it
# after 12 edges as a rule (half of 24 cases): so many are needed for that rate of false stops.
MOST_SINGLE, MOST = 1.4, 4.0
SENTENCE = (
    "Edges do not fit the model: the latest ones came {:.1g} slots from where it expects them. See whether the "
    "encoder's line is connected and quiet, and the model is this motor's."
)


@dataclass(frozen=True, slots=True)
class State:
    """What the innovations add up to."""

    excess: float = 0.0  # [slots]
    innovation: float = 0.0  # [slots] at the latest edge
    mean: float = 0.0  # [slots] of the magnitudes, over about four edges
    backward: bool = False  # the speed at the latest edge


def check(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check one sample: a sentence if the motor has to stop, else ""."""
    if not (seen.motion.edges and config.slot > 0.0 and config.even and isfinite(seen.innovation)):
        return "", state
    state = follow_innovation(
        state,
        seen.innovation / config.slot,
        seen.speed < 0.0,
        known=seen.speed != 0.0 and 0.0 < seen.sample.edge_period <= longest_period(config),
    )
    most = MOST_SINGLE if config.spare == SPARE_SINGLE else MOST
    driven = seen.motion.slow_voltage >= LEAST_VOLTAGE * seen.voltage_limit > 0.0
    wrong = config.stall_time > 0.0 and driven and state.excess >= most
    return (SENTENCE.format(state.mean) if wrong else ""), state


def longest_period(config: Config) -> float:
    """Find the longest period [s] over which the model's motor can be predicted."""
    return sqrt(2.0 * ORDINARY * config.slot * config.time_constant / (TORQUE * config.fastest))


def follow_innovation(state: State, innovation: float, backward: bool, known: bool = True) -> State:
    """Follow one more innovation [slots], of an edge that was known to be near."""
    innovation = min(max(innovation, -LARGEST), LARGEST)
    excess, mean = state.excess, state.mean
    if known and backward == state.backward:
        off = min(abs(innovation), abs(innovation - state.innovation), LARGEST)
        excess, mean = max(excess + off - ORDINARY, 0.0), mean + 0.25 * (abs(innovation) - mean)
    return State(excess, innovation, mean, backward)
