"""One of two channels lost while a slow motor runs, at 1, 2 and 4 counts a period: a table, and when it could be known.

    python benchmarks/faults_lost_channel.py

A board then counts the flanks of the other channel to and fro: no two are passed one way, and no period is known
(`tests/board/emulation/test_wiring.py`). In brackets, at 200 Hz: when nothing fits any more for an observer that knows
all but the load (`faults_knowable.py`; up to 0.25 of the stall torque), beside a loop that nothing stops.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product
from math import floor, inf, tau

from faults_knowable import LOADS, knowable, record
from faults_loop import Loop, outcome
from faults_motor import MOTORS, Motor

from motor_model.sample import Sample

RATES, SHARES = (200.0, 1000.0), (0.03, 0.05, 0.1, 0.3)  # [Hz], of the top speed
LOSSES = (
    (1, "B"),
    (2, "B"),
    (4, "B"),
    (4, "A"),
)  # counts a period, and what is lost; without A the others count nothing
FLANKS = {1: 2.0, 2: 1.0, 4: 0.5}  # of one channel, a count
AT_REFERENCE, AFTER = 1.5, 4.0  # [s]


@dataclass
class LostChannel:
    """What a board says from the first sample on: the flanks of one channel, to and fro."""

    loop: Loop
    channel: str = "B"  # that is lost
    told: Sample | None = None
    place: float = 0.0  # in flanks of the other one

    def __call__(self, sample: Sample) -> Sample:
        """What the board says instead."""
        ahead = 0.0 if self.channel == "B" else 0.5  # of a flank of the other
        place = self.loop.board.angle / tau * self.loop.edges * FLANKS[self.loop.quadrature] + ahead
        before, passed = self.place, floor(place) - floor(self.place)
        self.place = place
        if self.told is None:
            self.told, passed = sample, 0
        told = replace(self.told, sample_time=sample.sample_time, voltage=sample.voltage, speed=0.0)
        if passed:
            latest = floor(place) + (passed < 0)
            late = (place - latest) / (place - before) / self.loop.rate  # [s]
            way = 1 if self.channel == "B" else -1
            count = told.edge_count + (passed % 2) * (way if floor(before) % 2 == 0 else -way)
            at = sample.sample_time - round(1e9 * late)
            told = replace(told, edge_count=count, edge_time=at, edge_period=0.0)
        self.told = told
        return told


@dataclass(frozen=True)
class Answer:
    """What became of one run; times [s] from the loss on, infinite: never."""

    after: float
    knowable: float
    speed: float  # of the top speed, the largest meanwhile
    said: str

    def text(self) -> str:
        """[ms], and the speed."""
        known = f" ({1e3 * self.knowable:.0f})" if self.knowable < inf else ""
        return f"{'never' if self.after == inf else f'{1e3 * self.after:.0f}'}{known}, {self.speed:.0%}"


def lose(motor: Motor, rate: float, model: bool, share: float, loss: tuple[int, str]) -> Loop:
    """Lose a channel of a motor that runs at a share of its top speed."""
    loop = Loop(motor, rate, model, single_channel=False, quadrature=loss[0])
    loop.run(0.2)
    loop.reference = share * motor.top
    loop.run(AT_REFERENCE)
    loop.line = LostChannel(loop, loss[1])
    return loop


def run(motor: Motor, rate: float, model: bool, share: float, loss: tuple[int, str]) -> Answer:
    """Say what became of it, and when it could have been known."""
    loop = lose(motor, rate, model, share, loss)
    begin = loop.time
    loop.run(AFTER)
    found, known = outcome(loop.moments, begin), inf
    if rate == RATES[0] and loss[0] > 1:
        loop = lose(motor, rate, model, share, loss)
        loop.config = replace(loop.config, faults=replace(loop.config.faults, stall_time=0.0))
        loop.check = replace(loop.check, stall_time=0.0)
        recorder = record(loop)
        loop.run(AFTER)
        known = knowable(recorder, LOADS[1][0])
    return Answer(inf if found.after is None else found.after, known, found.speed / motor.top, found.said)


def table() -> Iterator[str]:
    """The table: [ms] to 0 V for good (to when it could be known), and the largest speed."""
    heads = " | ".join(f"{channel} at ×{counts}" for counts, channel in LOSSES)
    yield f"| motor | rate | model | reference | {heads} |"
    yield "|---|---:|---|---:|" + "---|" * len(LOSSES)
    for rate, motor, model, share in product(RATES, MOTORS[:4], (False, True), SHARES):
        cells = " | ".join(run(motor, rate, model, share, loss).text() for loss in LOSSES)
        yield f"| {motor.top:g} rad/s | {rate:.0f} Hz | {'with' if model else 'without'} | {share:.0%} | {cells} |"


if __name__ == "__main__":
    for line in table():
        print(line, flush=True)
