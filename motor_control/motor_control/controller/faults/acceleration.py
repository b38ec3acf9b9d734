"""Detect a motor that gains speed as none of its model could: the model is of another motor, which makes a loop swing.

With a model of a motor five times as slow a feed-forward is five times too strong, and an observer expects the motor
where it was: the loop swings for ever, to two and a half times what is asked for and as far the other way. But no motor
of the model gains more than

    d|ω|/dt = (|voltage| - kv |ω| + the load that helps)/ka

The speed is smoothed over a share of the time constant, for a disc is irregular, and the right side with it; what the
speed gains beyond that adds up. It is the mean over some edges, for a tick makes more of a period than of that; while
no edge comes, what the motor may gain adds up, too. A mean is of the middle of its time, so that what may have been
gained from one to the next is half of what was possible in each.
"""

from dataclasses import dataclass
from math import exp, inf

from motor_control.controller.faults.evidence import HEAVY, Config, Seen
from motor_model.frozen_record import replace

MODEL = 1.2  # times what a motor of the model gains: a model is off, a motor is cold
SMOOTH = 0.05  # of the time constant
IRREGULAR = 0.2  # of a speed from one edge to the next, by a disc whose flanks are off by 5 % of a slot, up and down
EXCESS = 0.03  # of the top speed, that is gained too much
# Edges of a mean: as few as tell, and more where several flanks a period are counted, as uneven as the sensor is.
LEAST, UNEVEN = 4, 8
MOST = 1e6  # [V] that a sample may say: what is infinite would be remembered
SENTENCE = (
    "The motor gains speed, to {:.3g} rad/s, as its model could not with all its voltage and a load that helps: see "
    "whether the model is this motor's, edges_per_revolution is right, and the encoder's line is quiet."
)


@dataclass(frozen=True)
class State:
    """What the motor has gained lately, and might have; speeds in rad/s."""

    count: int = 0  # at the latest mean
    edge: int = 0  # [ns] the latest edge then; 0: there was none yet
    mean: float = 0.0
    speed: float = 0.0  # the same, smoothed
    may: float = 0.0  # [rad/s²] smoothed
    voltage: float = 0.0  # [V] since the sample before
    time: float = 0.0  # [s] since the latest mean
    bank: float = 0.0  # that the motor may have gained since then
    before: float = 0.0  # the same from the mean before to that one
    excess: float = 0.0


def check(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check one sample: a sentence if the motor has to stop, else ""."""
    ka, sample = config.kv * config.time_constant, seen.sample
    if not (ka > 0.0 and config.slot > 0.0 and config.fastest < inf):
        return "", State()
    voltage, load = min(abs(sample.voltage), MOST), HEAVY * max(seen.voltage_limit, config.kv * config.fastest)
    back_emf = config.kv * min(state.mean, abs(sample.speed))
    most = MODEL * (max(max(voltage, state.voltage) - back_emf, 0.0) + load) / ka
    may = state.may + _share(config, seen.dt) * (most - state.may) if state.edge else most
    state = replace(state, may=may, voltage=voltage, time=state.time + seen.dt, bank=state.bank + may * seen.dt)
    edges, time = abs(sample.edge_count - state.count), (sample.edge_time - state.edge) * 1e-9
    if not state.edge or time < 0.0:
        speed = abs(sample.speed)
        return "", State(sample.edge_count, sample.edge_time, speed, speed, may, voltage, before=inf)
    if time == 0.0 or edges < (LEAST if config.even else UNEVEN):
        return "", state
    mean = edges * config.slot / time
    gained = _share(config, state.time) * (mean - state.speed)
    bank = state.bank * max(time / max(state.time, 1e-9), 1.0)  # edges are not where samples are
    excess = max(state.excess + gained - max(bank, 0.5 * (state.before + bank)), 0.0)
    after = State(
        *(sample.edge_count, sample.edge_time, mean, state.speed + gained, may, voltage), before=bank, excess=excess
    )
    most_excess = EXCESS * config.fastest + IRREGULAR * mean / edges
    told = config.stall_time > 0.0 and excess > most_excess
    return (SENTENCE.format(mean) if told else ""), after


def _share(config: Config, time: float) -> float:
    """Compute how much of a change is seen after a time [s]."""
    return 1.0 - exp(-time / (SMOOTH * config.time_constant))
