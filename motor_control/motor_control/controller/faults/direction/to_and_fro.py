"""Detect edges that are counted to and fro, and lead nowhere, under a voltage that turns any motor.

One of two channels is lost, as `motor_model.sensing.to_and_fro` says: the motor is reported to stand, and a loop gives
it all the voltage. How soon a motor has moved on follows from what is known of it.

An observer takes such edges for a load that turns, and its loop raises the voltage slowly where edges are few. But to
take each edge back against a voltage u, a load has to exceed u every other time, and fall below it in between. With a
model the edges themselves tell, therefore, of a motor that moved along its voltage just before, and shall: each counts
by what the voltage has beyond a random torque and the load of that motion, as shares of the stall torque,

    Σ max(|u| − TORQUE − load, 0)

One that has not moved yet may hang in the balance, on a bench that trembles.
"""

from dataclasses import dataclass, replace
from math import inf, isfinite

from motor_control.controller.faults.evidence import Config, Seen, find_push_time
from motor_model.sensing.to_and_fro import ToAndFro

HELD = 0.45  # of the voltage limit that friction and a load may take together: no motor is let run that needs more
LEAST = 0.1  # of it, beyond that
SLOTS = 2.0  # that what is left moves the motor by
WAIT = 1.5  # times the time that this takes
# [s] at least, with a model, and without: a flywheel of 5 s takes 0.12 s for two slots of 96 at 174 rad/s.
SHORTEST, SHORTEST_UNKNOWN = 0.05, 0.12
SLOWEST = 90.0  # [edges/s] at the top speed, where nothing is known of it
TORQUE = 0.05  # of the voltage limit: RMS of a random one that no model knows of
# Samples with a new edge, and what they add up to. 58 motors at up to 8 % of the top speed, under loads of up to 0.25
# and another that comes of up to 0.35, beside a random torque of 2.5 or 5 % RMS (19 minutes at 200 Hz), came to no more
# than three of these with a sum of 0.17.
FEW, MOST = 6, 0.5
SENTENCE = (
    "Edges are counted to and fro under {:.3g} V, for {:.2g} s, and lead nowhere: see whether both channels of the "
    "encoder are connected, or what holds the shaft."
)


@dataclass(frozen=True, slots=True)
class State:
    """Edges within one slot of each other, under a voltage one way."""

    edges: ToAndFro = ToAndFro()
    voltage: float = 0.0  # [V] the least
    slow: ToAndFro = ToAndFro()  # those under any voltage one way, while a motion that way is asked for
    latest: float = 0.0  # [V] of the sample before
    reference: float = 0.0  # [rad/s] likewise
    load: float = inf  # of the motion just before, share of the voltage limit; infinite: there was none
    excess: float = 0.0  # shares of the voltage limit, of these


def check(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check one sample: a sentence if the motor has to stop, else ""."""
    sample, limit = seen.sample, seen.voltage_limit
    watches = config.two_channels and config.slot > 0.0 and config.stall_time > 0.0
    drives = limit > 0.0 and abs(sample.voltage) >= (HELD + LEAST) * limit
    anew = not (watches and drives and state.voltage * sample.voltage > 0.0)
    edges = state.edges.see(sample, anew)
    voltage = sample.voltage if edges.edges == 0 else min(state.voltage, sample.voltage, key=abs)
    patience = 0.0 if anew else _find_patience(config, seen, abs(voltage) / limit - HELD)
    lasts = not anew and edges.lasts(sample.sample_time, patience)
    after = _weigh(config, state, seen) if watches else State()
    patient = _find_patience(config, seen, LEAST) if after.slow.edges >= FEW else 0.0
    proven = after.excess >= MOST and after.slow.edges >= FEW and after.slow.passed(sample.sample_time, patient)
    took = (sample.sample_time - (edges if lasts else after.slow).since) * 1e-9
    reason = SENTENCE.format(sample.voltage, took) if lasts or proven else ""
    return reason, replace(after, edges=edges, voltage=voltage)


def _weigh(config: Config, state: State, seen: Seen) -> State:
    """Weigh edges by the voltage that they are counted back against, where a model knows what turns the motor."""
    sample, limit, before = seen.sample, seen.voltage_limit, state.slow
    goes_on = config.kv > 0.0 and limit > 0.0 and seen.reference * state.reference > 0.0  # false of a plain voltage
    anew = not (goes_on and seen.reference * sample.voltage > 0.0 and state.latest * sample.voltage > 0.0)
    edges = before.see(sample, anew)
    after = replace(state, slow=edges, latest=sample.voltage, reference=seen.reference, excess=0.0)
    if anew:
        return replace(after, load=state.load if goes_on else inf)
    if edges.edges == 0 and sample.edge_count != before.low:
        along = (sample.edge_count - before.low) * sample.voltage > 0.0
        return replace(after, load=_find_load(config, seen) if along else inf)
    voltage = min(abs(state.latest), abs(sample.voltage)) / limit
    counts = max(voltage - TORQUE - state.load, 0.0) if edges.edges > before.edges else 0.0
    return replace(after, excess=state.excess + counts)


def _find_load(config: Config, seen: Seen) -> float:
    """Find the load, as a share of the voltage limit, beside friction on a motor that moves along its voltage."""
    load = seen.motion.slow_voltage - config.kv * seen.motion.slow_speed - config.friction
    return min(max(load / seen.voltage_limit, 0.0), HELD)


def _find_patience(config: Config, seen: Seen, torque: float) -> float:
    """Find the time [s] after which a motor has moved on, by a torque as a share of the stall torque."""
    fastest = min(config.fastest, seen.motion.fastest(seen.voltage_limit))
    top = fastest if isfinite(fastest) and fastest > 0.0 else SLOWEST * config.slot
    least = SHORTEST if config.time_constant > 0.0 else SHORTEST_UNKNOWN
    return max(least, WAIT * find_push_time(config, top, max(torque, LEAST), SLOTS))
