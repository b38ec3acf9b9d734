"""Detect edges that stop and go on as if nothing had been: a contact that is loose.

While edges are missing, a loop drives the motor harder. With a contact that is there for a fifth of the time it ran at
two thirds more than it should, for ever: the average says that edges are only a few times too few.

A motor that has nearly stopped has to be spun up again. From rest it reaches sqrt(2 a s) within an angle s and a t
within a time t, under an acceleration a that is twice the one of full voltage at rest (voltage and back-EMF, or a load,
may help one another). If right after a gap it is faster than that by half, and as fast as before, it was never slow,
and the edges have been lost. Of slow motors and coarse discs that cannot be told.

Nor is a light motor that is switched off and on again a loose contact: it may have a tenth of the time constant that is
assumed where no model says it. A loop that misses edges drives; so a gap counts where the motor was driven through it.
"""

from dataclasses import dataclass
from math import exp, inf, sqrt

from motor_control.controller.faults.evidence import USUAL_TIME_CONSTANT, Config, Seen
from motor_model.frozen_record import replace

GAP = 5.0  # periods without an edge: the speed would be down to a fifth
AFTER = 3.0  # slots in which the motor is as fast as before: two edges make a period, and one is on the way
AS_FAST = 0.8  # of the speed before
HELP, MARGIN = 2.0, 1.5
DRIVEN = 0.25  # of the largest voltage in a gap, that the mean one has at least; a loop's may rise from 0
FORGET = 1.0  # [s] time constant
MOST = 2.4  # of them that are not forgotten: three in half a second, or one every half second for long
SENTENCE = (
    "Edges stop for {:.2g} s and go on at {:.3g} rad/s as if nothing had been, again and again: see whether a contact "
    "of the encoder's line is loose."
)


@dataclass(frozen=True)
class State:
    """The motion before a gap, and how many gaps there were."""

    speed: float = 0.0  # [rad/s] by the latest period; 0: not known
    silent: float = 0.0  # [s] since the latest edge
    peak: float = 0.0  # [V] largest magnitude since then
    push: float = 0.0  # [V·s] of the magnitude since then
    gap: float = 0.0  # [s] the latest one, until it is known what comes after
    before: float = 0.0  # [rad/s] before it
    edges: int = 0  # since it has ended
    time: float = 0.0  # [s] likewise
    gaps: float = 0.0  # those that were dropouts, and are not forgotten


def check(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check one sample: a sentence if the motor has to stop, else ""."""
    if config.slot == 0.0 or config.stall_time == 0.0:
        return "", state
    state = replace(state, gaps=state.gaps * exp(-seen.dt / FORGET))
    volts = abs(seen.sample.voltage)
    peak, push = max(state.peak, volts), state.push + volts * seen.dt
    if not seen.motion.edges:
        return "", replace(state, silent=state.silent + seen.dt, peak=peak, push=push)
    driven = push > 0.0 and push >= DRIVEN * peak * (state.silent + seen.dt)
    period, silent = seen.sample.edge_period, state.silent
    speed = config.slot / period if period > 0.0 else 0.0
    if driven and silent > seen.dt and silent * state.speed > GAP * config.slot:
        state = replace(state, gap=silent, before=state.speed, edges=0, time=0.0)
    state = replace(
        state, silent=0.0, peak=0.0, push=0.0, edges=state.edges + seen.motion.edges, time=state.time + seen.dt
    )
    if not state.gap:
        return "", replace(state, speed=speed)
    if speed >= AS_FAST * state.before and speed > MARGIN * find_reachable_speed(config, seen, state):
        told = replace(state, speed=speed, gap=0.0, gaps=state.gaps + 1.0)
        return (SENTENCE.format(state.gap, speed) if told.gaps >= MOST else ""), told
    return "", state if state.edges < AFTER else replace(state, speed=speed, gap=0.0)


def find_reachable_speed(config: Config, seen: Seen, state: State) -> float:
    """Find the speed [rad/s] that the motor may have from the gap's on; infinite: nothing is known of it."""
    top = config.fastest if config.fastest < inf else seen.motion.fastest(seen.voltage_limit)
    acceleration = HELP * top / (config.time_constant or USUAL_TIME_CONSTANT)
    return config.slot / state.gap + min(
        sqrt(2.0 * acceleration * state.edges * config.slot), acceleration * state.time
    )
