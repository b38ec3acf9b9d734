"""Detect a motor that is told 0 V and does not slow down: a bridge that stays on, whatever it is told.

Its speed grows at first, as long as the loop still takes its voltage back, and is even from then on, which no check of
growth sees (`runaway`). Any motor of its own coasts down: one whose time constant is 20 s loses 2 % in 0.4 s. What its
edges say in one window after the other is compared with the first one: a window that is slower begins anew. So the
clock stops for no disc, however heavy; six windows of 0.5 s, of which none is slower by 2 %, are a time constant beyond
two minutes. By a model the windows are shorter, but one time constant at least.

With one channel, whose friction has to hold 0 rad/s (`evidence`), no load keeps a motor turning fast: it is stopped
beyond twice the share of its top speed that a load may take. What creeps, or has two channels, a weight may turn, and
so it is where no top speed is known, by a model or a steady motion: there it is said, after two windows, and no more.
"""

from dataclasses import dataclass, replace

from motor_control.controller.faults.evidence import Config, Seen

FASTER = 1.2  # times the reference: no overshoot, or unevenness of a disc
SETTLED = 0.3  # [s] of 0 V before the first window: a bridge and a current obey late
WINDOW, SHORTEST = 0.5, 0.25  # [s] without a model; with one
SLOWER = 0.98  # of the first window's speed
EDGES = 200  # in a window at least: one is less than `SLOWER` leaves; a slow motor's windows are longer
LOADS = 2.0  # times the share of the top speed that a load may take
SAID, MOST = 2, 6  # windows after which it is said, and after which the motor is stopped
SENTENCE = (
    "The motor is told 0 V, and for {:.2g} s has turned at {:.3g} rad/s without slowing down: see whether the bridge "
    "obeys (cut the motor's supply: one that stays on hears nothing), or something else turns the shaft."
)


@dataclass(frozen=True, slots=True)
class State:
    """For how long 0 V have been told, and how far the motor has turned in the windows of that time."""

    settling: float = 0.0  # [s] before the first window
    time: float = 0.0  # [s] in this window
    edges: int = 0  # in it
    first: float = 0.0  # [rad/s] in the first window; 0: it is not over
    windows: int = 0  # that are over, of which none was slower
    lasted: float = 0.0  # [s] all of them
    warning: str = ""


def check(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check one sample: a sentence if the motor has to stop, else "" and maybe a warning in the state."""
    idle = seen.sample.voltage == 0.0 and seen.asked == 0.0 and config.slot > 0.0 and config.stall_time > 0.0
    if not idle or not seen.motion.slow_speed > FASTER * abs(seen.reference):  # of a voltage there is no reference
        return "", State()
    if state.settling < SETTLED:
        return "", State(state.settling + seen.dt)
    length = max(SHORTEST, config.time_constant) if config.kv > 0.0 else WINDOW
    time, edges = state.time + seen.dt, state.edges + seen.motion.edges
    if time < length or edges < EDGES:
        return "", replace(state, time=time, edges=edges)
    speed, windows = edges * config.slot / time, state.windows + 1
    if speed - config.slot / time < SLOWER * state.first:  # one edge more or less is chance
        return "", State(state.settling)
    first = state.first or speed
    lasted = state.lasted + time
    said = SENTENCE.format(lasted, speed) if SAID <= windows <= MOST else state.warning
    top = min(config.fastest, seen.motion.fastest(seen.voltage_limit))
    stops = windows >= MOST and not config.two_channels and speed > LOADS * config.spare * top
    return said if stops else "", State(state.settling, first=first, windows=windows, lasted=lasted, warning=said)
