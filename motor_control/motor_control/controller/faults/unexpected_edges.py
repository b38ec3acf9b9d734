"""Detect edges where the observer does not expect them: they are not those of the model's motor.

An innovation is the angle by which an edge comes earlier or later than predicted. Edges that have nothing to do with
the motor are off by half a slot on average, and each by something else. Those of the motor are off by little; where a
load has changed by much, all edges until the observer has taken it up, but the one by nearly as much as the next. So
what counts of an edge is

    min(|ν|, |ν - ν before|), at most `LARGEST`

and it is summed up less `ORDINARY`; the sum does not fall below 0 (Page, "Continuous inspection schemes", Biometrika
41, 1954). This tells noise where edges are too few for their periods to be judged (`irregular_edges`).

Of a disc with few slots each is as irregular as the others, and an observer that has seen few edges takes that for a
motion: ν of the same slot, a turn before, is taken off like that of the edge before.

An edge that ends a turn or a standstill, or has no period, does not count: where the shaft was before is a guess. Nor
does one after a period in which a random torque may move the motor by `ORDINARY` (`find_push_time`). Nor is anything
known where several flanks a period are counted (`Config.even`): they are off by up to half a slot, in turn,
for the sensor's sake; edges are many there, and have periods.
"""

from dataclasses import dataclass
from math import isfinite, nan

from motor_control.controller.faults.evidence import Config, Seen, find_push_time
from motor_control.controller.faults.irregular_edges import LEAST_VOLTAGE
from motor_model.frozen_record import replace

ORDINARY = 0.25  # of a slot: what edges of a motor stay below, also with a model some per cent off
FEW_SLOTS = 4  # of a disc: with up to 8, 20 stray edges a second are told after 1.9 s where it was 0.9
LARGEST = 1.0  # of a slot: one edge proves little
TORQUE = 0.1  # of the stall torque, that no model knows of: twice the RMS of a random one of 5 % of the supply
# [slots] of the sum. In 680 runs of random motors (3 hours; torque, model, ramps and play of `no_false_stops`) it was
# 1.4 at most, of those without a random torque 0.9. Noise has it after some fifteen edges.
MOST = 2.0
SENTENCE = (
    "Edges do not fit the model: the latest ones came {:.1g} slots from where it expects them. See whether the "
    "encoder's line is connected and quiet, and the model is this motor's."
)


@dataclass(frozen=True)
class State:
    """What the innovations add up to."""

    excess: float = 0.0  # [slots]
    innovation: float = 0.0  # [slots] at the latest edge
    mean: float = 0.0  # [slots] of the magnitudes, over about four edges
    direction: int = 0  # of the speed at the latest edge; 0: it stood
    disc: tuple[float, ...] = ()  # [slots] latest innovation at each slot of a disc with few; NaN: there was none


def check(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check one sample: a sentence if the motor has to stop, else ""."""
    if not (seen.motion.edges and config.slot > 0.0 and config.even and isfinite(seen.innovation)):
        return "", state
    known = 0.0 < seen.sample.edge_period <= longest_period(config)
    slot = seen.sample.edge_count % config.few_slots if config.few_slots else 0
    state = state if len(state.disc) == config.few_slots else replace(state, disc=(nan,) * config.few_slots)
    state = follow_innovation(state, seen.innovation / config.slot, seen.speed, known, slot)
    if seen.motion.slow_voltage < LEAST_VOLTAGE * seen.voltage_limit or config.stall_time == 0.0:
        return "", replace(state, excess=0.0)  # what a hand has shaken is not held against what is driven later
    return (SENTENCE.format(state.mean) if state.excess >= MOST else ""), state


def longest_period(config: Config) -> float:
    """Find the longest period [s] over which the model's motor can be predicted."""
    return find_push_time(config, config.fastest, TORQUE, ORDINARY)


def follow_innovation(state: State, innovation: float, speed: float, known: bool = True, slot: int = 0) -> State:
    """Follow one more innovation [slots], of an edge that was known to be near, at an observed speed [rad/s].

    slot: which of the disc it was, if those are few.
    """
    innovation = min(max(innovation, -LARGEST), LARGEST)
    excess, mean, direction = state.excess, state.mean, (speed > 0.0) - (speed < 0.0)
    if known and direction == state.direction != 0:
        alike = (0.0, state.innovation, *(one for one in state.disc[slot : slot + 1] if isfinite(one)))
        off = min(LARGEST, *(abs(innovation - one) for one in alike))
        excess, mean = max(excess + off - ORDINARY, 0.0), mean + 0.25 * (abs(innovation) - mean)
    disc = (*state.disc[:slot], innovation, *state.disc[slot + 1 :]) if state.disc else ()
    return State(excess, innovation, mean, direction, disc)
