"""Give the motor a little voltage for a moment: where it breaks away, how fast it turns, that it stops again."""

from collections import deque
from dataclasses import dataclass
from math import nan

from motor_driver.check.look import OFF, Act, Look, Steps
from motor_driver.check.settings import DRIVE_TIME, HOLD_TIME, RAMP_TIME, Settings

MOVED = 3  # samples with a new edge are motion: one or two may be a shaft that gives in its gears
WAIT_FOR_MORE = 0.8  # [s] on one voltage after a first edge
ANEW = 0.06  # of the highest voltage: edges that come so much later are no part of the same motion
SWITCH_TIME = 0.5  # [s] that the board may take to switch its output on
STILL = 0.3  # [s] without an edge: the motor stands
STOP_TIME = 5.0  # [s] in which a motor stops, or at least slows down
SLOWER = 0.5  # of its edge rate that a motor keeps at most after that time if it gets 0 V
WINDOW = 0.25  # [s] of which two in turn are compared
STEADY = 0.01  # by which they may differ: what 8 slots, irregular by 1 %, leave is a fifth of it
LEAST_EDGES = 8  # in a window


class OutputStaysOff(Exception):
    """The board does not switch its output on."""


@dataclass(frozen=True)
class Breakaway:
    """How the motor began to move."""

    voltage: float | None = None  # [V] at its first edge; None: it did not
    count: int = 0  # edges since then, signed with two channels
    span: int = 0
    current: float = nan  # [A] just before, with the shaft at rest

    @property
    def to_and_fro(self) -> bool:
        """Whether edges came and the count got nowhere."""
        return self.voltage is not None and self.span < MOVED - 1


def _switch_on(voltage: float = 0.0) -> Steps[Look]:
    look = yield Act(on=True)
    begun = look.time
    while not look.on:
        if look.time - begun > SWITCH_TIME:
            raise OutputStaysOff
        look = yield Act(voltage if look.on else 0.0, on=True)
    return look


def break_away(settings: Settings, way: int) -> Steps[Breakaway]:
    """Raise the voltage slowly in one direction until the motor moves, to the highest at most."""
    look = yield from _switch_on()
    begun = zero = look.time
    first, held, edges, current = None, None, 0, nan  # first: the sample before the first edge
    while look.time - begun < DRIVE_TIME:
        if held is None and look.time - zero > RAMP_TIME + WAIT_FOR_MORE:
            break
        share = min((look.time - zero) / RAMP_TIME, 1.0) if held is None else held
        before, look = look, (yield Act(way * share * settings.highest, on=True))
        if look.edge_time != before.edge_time:
            if held is None and (first is None or share > abs(first.voltage) / settings.highest + ANEW):
                first, held, edges, low, high = before, share, 0, before.count, before.count
            edges, low, high = edges + 1, min(low, look.count), max(high, look.count)
            if edges >= MOVED and first is not None:
                return Breakaway(abs(first.voltage), look.count - first.count, high - low, current)
        elif held is None:
            current = current if first else abs(look.current)
        elif first is not None and look.time - first.time > WAIT_FOR_MORE:  # it stands again, or is slow: go on
            zero, held = look.time - share * RAMP_TIME, None
    return Breakaway(None, current=current)


@dataclass(frozen=True)
class Pace:
    """How fast the motor turns at a voltage."""

    voltage: float  # [V]
    rate: float = 0.0  # [1/s] edges, signed with two channels
    edges: int = 0  # of which that is the mean
    steady: bool = False


def hold(voltage: float) -> Steps[Pace]:
    """Hold a voltage until the speed is steady, or for HOLD_TIME."""
    look, given = (yield from _switch_on(voltage)), voltage
    begun, edges = look.time, deque([(look.edge_time, look.count)])
    while look.time - begun < HOLD_TIME:
        look = yield Act(voltage, on=True)
        given = look.voltage or voltage  # duty comes in steps
        if look.edge_time != edges[-1][0]:
            edges.append((look.edge_time, look.count))
        while len(edges) > 2 and edges[1][0] < look.time - 2.0 * WINDOW and _enough(edges):
            edges.popleft()
        if look.time - begun > 2.0 * WINDOW and _is_steady(edges):
            return Pace(given, *_rate(list(edges)), steady=True)
    return Pace(given, *_rate(list(edges)[len(edges) // 2 :]))


def _enough(edges: "deque[tuple[float, int]]") -> bool:
    return abs(edges[-1][1] - edges[1][1]) >= 2 * LEAST_EDGES


def _is_steady(edges: "deque[tuple[float, int]]") -> bool:
    middle = len(edges) // 2
    early, late = _rate(list(edges)[: middle + 1]), _rate(list(edges)[middle:])
    return min(early[1], late[1]) >= LEAST_EDGES and abs(late[0] - early[0]) <= STEADY * abs(late[0])


def _rate(edges: list[tuple[float, int]]) -> tuple[float, int]:
    """[1/s] and of how many edges."""
    if len(edges) < 2:
        return 0.0, 0
    (first, low), (last, high) = edges[0], edges[-1]
    return (high - low) / (last - first), abs(high - low)


def stop_motor() -> Steps[float]:
    """Switch off and wait until the motor stands; the edge rate [1/s] at which it turns on, 0 if it does not."""
    look = yield OFF
    begun, latest, seen = look.time, look.time, [look]
    while look.time - latest < STILL:
        look = yield OFF
        if look.edge_time != seen[-1].edge_time:
            latest = look.time
        seen.append(look)
        if look.time - begun > STOP_TIME:
            early, late = _mean_rate(seen, begun, begun + STILL), _mean_rate(seen, look.time - STILL, look.time)
            return late if late > SLOWER * early else 0.0
    return 0.0


def _mean_rate(seen: list[Look], start: float, stop: float) -> float:
    """[1/s] edges between two times, to and fro alike."""
    kept = [look for look in seen if start <= look.time <= stop]
    passed = abs(kept[-1].count - kept[0].count)
    return passed / (stop - start)
