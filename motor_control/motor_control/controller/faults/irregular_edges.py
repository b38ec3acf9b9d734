"""Detect edges that no motor makes: their periods jump back and forth, as those of random edges do.

A motor's speed is continuous. It may grow or fall by a large factor from edge to edge where edges are few, but it goes
on doing so: with the logarithms of three successive periods a, b, c, the middle one is at an extreme only by what the
slots are irregular, or in a swing that takes no longer than two edges. So the jump is

    min(|b - a|, |c - b|)   where b is the largest or the smallest of the three, else 0,

cut off at `LARGEST`: its mean over the latest edges is 0.45 for random edges whatever their rate, below 0.1 for a disc
whose slots are irregular by 5 %, and up to 0.4 where a loop makes a slow motor swing: edge by edge, at a rate below
`LEAST_RATE`. After a standstill or a turn the mean begins anew.

Edges of four flanks a period are as uneven as the encoder's sensor, by a fifth or more, and so is a disc of four slots:
every fourth period is alike there. So a second mean is taken over periods whose counts leave the same rest by 4: where
it is that of ordinary motion, the jumps are the sensor's. Of random edges both means are the same.

Nor is a motor's speed continuous where edges are so far apart that the loop's voltage and a random torque start and
stop it between two of them: a motor that crawls, on a disc of many slots. Nor where several edges come between two
samples, of which one period is told, and the motor is so quick that a loop starts and stops it from sample to sample.
Such edges are a fault only under a voltage that no crawl needs.

A timer that ticks hardly faster than edges come makes steps of its own: a period is known to one tick, and a step
counts as far as it is larger than what that makes of it.
"""

from dataclasses import dataclass
from math import copysign, exp, inf, log

from motor_control.controller.faults.evidence import (
    USUAL_TIME_CONSTANT,
    Config,
    Seen,
    find_allowed_voltage,
    find_push_time,
)
from motor_model.frozen_record import replace

FLANKS = 4
EDGES = 10.0  # over which the jumps are averaged
LARGEST = 1.0  # jump that counts: an edge that is one too many makes two such jumps, and is no lost line
IRREGULAR = 0.3  # mean jump; 50 random edges a second have it after 0.3 s, and after 0.6 s in 95 of 100 cases
REGULAR = 0.15  # what ordinary motion has nearly always
STANDSTILL = 0.1  # [s] without an edge
# [edges/s] A plant reports a standstill after 0.1 s without an edge, and a loop answers that with a push: below this
# rate the swing of an ordinary loop has mean jumps of up to 0.4, above it none of 400 random motors passes 0.2.
LEAST_RATE = 35.0
# Of the stall torque, that may start and stop a motor within a slot: at random, and as pulses of a loop that holds a
# speed near 0. The quickest of 8 such motors of 900 (4000 edges a turn) had a mean period in which 0.26 do so.
PUSH = 0.5
RATE_EDGES = 5.0  # over which the periods are averaged for that: counted edges alone tell of a faster motion before
LEAST_VOLTAGE = 0.02  # of the voltage limit, on average: without a voltage nothing is driven, and a hand may shake it
SENTENCE = (
    "Edges do not fit a motor: their periods jump back and forth by a factor of {:.2g} on average. See whether the "
    "encoder's line is connected and quiet."
)


@dataclass(frozen=True)
class State:
    """The latest periods."""

    period: float = 0.0  # [s] 0: none yet
    step: float = 0.0  # log of its ratio to the one before
    jump: float = 0.0  # mean
    patterned: float = 0.0  # mean over periods of the same flank
    flanks: tuple[tuple[float, float], ...] = ((0.0, 0.0),) * FLANKS  # period and step of each
    mean_period: float = 0.0  # [s] over the latest few
    count: int = 0  # of edges
    backward: bool = False  # a second channel counts down
    steps: int = 0  # periods since it began anew
    voltage: float = 0.0  # [V] largest magnitude from edge to edge, averaged over a few of them
    peak: float = 0.0  # [V] since the latest edge

    @property
    def regular(self) -> bool:
        """Whether the edges are a motor's beyond doubt, so that one may learn from them."""
        return min(self.jump, self.patterned) < REGULAR and self.steps >= EDGES

    @property
    def irregular(self) -> bool:
        """Whether the edges are no motor's: their periods jump, and no pattern of flanks explains it."""
        return self.jump >= IRREGULAR and self.patterned >= REGULAR


def check(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check one sample: a sentence if the motor has to stop, else ""."""
    state = replace(state, peak=max(state.peak, abs(seen.sample.voltage)))
    if seen.motion.edges and config.slot > 0.0:
        state = _follow_edge(config, state, seen)
    if not state.irregular or config.stall_time == 0.0:
        return "", state
    driven = seen.motion.slow_voltage >= LEAST_VOLTAGE * seen.voltage_limit > 0.0
    if not driven:
        return "", state
    if _crawls(config, state, seen):  # which is not held against the motion that follows
        return "", replace(state, jump=min(state.jump, REGULAR), patterned=min(state.patterned, REGULAR))
    if seen.motion.slow_speed < LEAST_RATE * config.slot or state.mean_period > 1.0 / LEAST_RATE:
        return "", state
    return SENTENCE.format(exp(state.jump)), state


def _follow_edge(config: Config, state: State, seen: Seen) -> State:
    """Follow the latest edge, its period and the voltage since the one before."""
    count, voltage = seen.sample.edge_count, state.voltage + (state.peak - state.voltage) / RATE_EDGES
    state = follow_period(state, seen.sample.edge_period, count < state.count, count, config.tick)
    return replace(state, count=count, voltage=voltage, peak=0.0)


def _crawls(config: Config, state: State, seen: Seen) -> bool:
    """Whether these may be the edges of a motor that starts and stops between them, as far as it is known."""
    top_speed = config.fastest if config.fastest < inf else seen.motion.fastest(seen.voltage_limit)
    if top_speed == inf:
        return False
    slowly = state.mean_period > find_push_time(config, top_speed, PUSH, 1.0)
    if not (slowly or _swings_between_samples(config, state, seen.dt, top_speed)):
        return False
    return state.voltage <= find_allowed_voltage(config, seen.motion, seen.voltage_limit, seen.sample.voltage)


def _swings_between_samples(config: Config, state: State, dt: float, top_speed: float) -> bool:
    """Whether `PUSH` starts or stops such a motion within dt [s], of whose edges only the latest period is told."""
    reached = PUSH * top_speed * dt / (config.time_constant or USUAL_TIME_CONSTANT)
    return dt > state.mean_period > 0.0 and reached >= config.slot / state.mean_period


def follow_period(state: State, period: float, backward: bool = False, count: int = 0, tick: float = 0.0) -> State:
    """Follow one more period [s], known to a tick, up to a count; 0 is one that is not known.

    A standstill and a turn begin anew.
    """
    if period >= STANDSTILL or backward != state.backward:
        return State(backward=backward)
    if period <= 0.0 or state.period <= 0.0:
        return replace(state, period=max(period, 0.0), step=0.0)
    step, jump = _find_jump((state.period, state.step), period, tick)
    flank = state.flanks[count % FLANKS]
    flank_step, flank_jump = _find_jump(flank, period, tick) if flank[0] else (0.0, jump)
    return State(
        period,
        step,
        state.jump + (jump - state.jump) / EDGES,
        state.patterned + (flank_jump - state.patterned) / EDGES,
        (*state.flanks[: count % FLANKS], (period, flank_step), *state.flanks[count % FLANKS + 1 :]),
        state.mean_period + (period - state.mean_period) / RATE_EDGES,
        state.count,
        backward,
        state.steps + 1,
    )


def _find_jump(before: tuple[float, float], period: float, tick: float) -> tuple[float, float]:
    """The step [log] from a period, itself reached by a step, to the next, and the jump that both are."""
    step = log(period / before[0])
    step = copysign(max(abs(step) - tick / period - tick / before[0], 0.0), step)
    return step, min(abs(step), abs(before[1]), LARGEST) if step * before[1] < 0.0 else 0.0
