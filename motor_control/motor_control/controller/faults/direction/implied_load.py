"""Detect a motion against the voltage that only a load could make which no motor may have.

Between two edges t apart, in which the motor has turned by Δθ and its speed has changed by Δω, the voltage that load
and friction take is in the mean

    ∫u dt/t − kv Δθ/t − ka Δω/t

Where the voltage is never along the motion, and this is more against it than `HEAVY` of what the motor may get, a load
drives the motor that is beyond all that are let be: friction would only add to it. With exchanged channels a voltage u
that drives the motor looks like a load of 2 u. A mean over MEAN_OVER lets a random torque be, and slots that are
irregular, by which Δω is uncertain, are allowed for.
"""

from dataclasses import dataclass

from motor_control.controller.faults.evidence import HEAVY, Config, Seen
from motor_model.frozen_record import replace

MEAN_OVER = 0.15  # [s] at least, from edge to edge
SPACING = 0.01  # [s] from one edge that is kept to the next
EDGES = 2  # before the latest, at least: the speed at a first one may be that of a motion that has ended
# Of the speed, by which a period may be off: two to three standard deviations on slots irregular by 5 %; where several
# flanks a period are counted, they are as uneven as the sensor.
UNEVEN, UNEVEN_FLANKS = 0.15, 1.0
AGAINST = 0.1  # of the voltage limit in the mean: at 0 V a stop would give the motor no less
FASTER = 2.0  # times the top speed of the model: a count that jumps, as that of a board which was reset
SENTENCE = (
    "The motor turns at {:.3g} rad/s against {:.3g} V, as if a load drove it with {:.3g} V more than friction takes: "
    "see whether motor and encoder agree on the direction, and what drives the motor."
)


@dataclass(frozen=True, slots=True)
class Edge:
    """What was so at an edge."""

    time: float  # [s]
    impulse: float  # [V s] of the voltage until then
    count: int
    speed: float  # [rad/s] signed


@dataclass(frozen=True)
class State:
    """Edges one way under a voltage that is never along them; time and impulse are counted from any instant."""

    time: float = 0.0  # [s] of the latest sample
    impulse: float = 0.0  # [V s]
    voltage: float = 0.0  # [V] from that sample on
    count: int | None = None
    way: int = 0  # of the latest edges
    edges: tuple[Edge, ...] = ()


NONE = State()


def check(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check one sample: a sentence if the motor has to stop, else ""."""
    if not config.two_channels or config.kv == 0.0 or config.slot == 0.0 or config.stall_time == 0.0:
        return "", NONE
    sample = seen.sample
    turned = 0 if state.count is None else sample.edge_count - state.count
    after = replace(
        state,
        time=state.time + seen.dt,
        impulse=state.impulse + state.voltage * seen.dt,
        voltage=sample.voltage,
        count=sample.edge_count,
        way=(turned > 0) - (turned < 0) or state.way,
    )
    jumps = abs(turned) * config.slot > FASTER * config.fastest * seen.dt + 2.0 * config.slot
    if after.way != state.way or not state.voltage * after.way <= 0.0 or jumps:  # or the voltage is no number
        after = replace(after, time=0.0, impulse=0.0, edges=())
    if turned == 0 or sample.edge_period <= 0.0 or jumps:
        return "", after
    late = min(max((sample.sample_time - sample.edge_time) * 1e-9, 0.0), seen.dt)
    speed = after.way * config.slot / sample.edge_period
    edge = Edge(after.time - late, after.impulse - state.voltage * late, sample.edge_count, speed)
    reason = _judge(config, after.edges, edge, after.way, seen.voltage_limit)
    return reason, replace(after, edges=_keep(after.edges, edge))


def _keep(edges: tuple[Edge, ...], latest: Edge) -> tuple[Edge, ...]:
    """Keep edges that a mean may begin at, and the latest if it does not follow another one closely."""
    while len(edges) > EDGES and latest.time - edges[1].time >= MEAN_OVER:
        edges = edges[1:]
    return (*edges, latest) if not edges or latest.time - edges[-1].time >= SPACING else edges


def _judge(config: Config, edges: tuple[Edge, ...], latest: Edge, way: int, voltage_limit: float) -> str:
    """Say what is wrong if the load that a motion until the latest edge implies is too large."""
    begun = [edge for edge in edges if latest.time - edge.time >= MEAN_OVER]
    if len(edges) < EDGES or not begun:
        return ""
    since, ka = begun[-1], config.kv * config.time_constant
    time = latest.time - since.time
    speed = config.slot * abs(latest.count - since.count) / time
    against = -way * (latest.impulse - since.impulse) / time
    driving = against + config.kv * speed + ka * way * (latest.speed - since.speed) / time
    driving -= (UNEVEN if config.even else UNEVEN_FLANKS) * ka * (abs(latest.speed) + abs(since.speed)) / time
    if against >= AGAINST * voltage_limit and driving >= HEAVY * voltage_limit:
        return SENTENCE.format(speed, against, driving)
    return ""
