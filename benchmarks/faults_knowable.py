"""When a fault could be known at the earliest: no motion of the motor fits what its encoder says any more.

A perfect observer knows the motor (top speed, time constant, friction), its state at the instant of the fault, and that
a load may change as it likes within a bound. All motions that are left are a set of angle and speed,

    dθ/dt = ω,   τ dω/dt = (u − friction − load)/kv − ω,   |load| <= bound

that spreads with time and is cut where an edge comes, or none: between edges the shaft stays within its slot, at an
edge it is at a flank (of which of its two sides, a single channel does not say). Where nothing is left, the likelihood
of a healthy motor is 0. What such an observer does not know, nobody does; a stop before that would be a guess.

The set is a polygon for each direction of the latest edge (`feasible_states.py`); the load is constant over a sample,
flanks are within 5 % of a slot of where they should be, and of several edges in a sample the latest is looked at.

Written to a page for every row of `faults.py` that is late.
"""

import sys
from dataclasses import dataclass
from math import inf
from pathlib import Path

import numpy as np
from faults_loop import Loop, outcome
from faults_motor import MOTORS, Motor
from faults_rows import FAULTS, MOTION, Fault
from feasible_states import Course, Healthy, Told, follow
from machine import commit, machine

from motor_model.sample import Sample

PAGE = Path(__file__).with_name("results") / "faults_knowable.md"
RATE, AT_REFERENCE, AFTER = 200.0, 1.5, 3.0  # [Hz], [s]
# Of the stall torque: what a load may take (one channel, two), and what one that comes while the motor turns is let be.
LOADS = ((0.15, 0.6), (0.25, 0.6))


@dataclass
class Recorder:
    """What a loop's controller was told, and the true motion."""

    loop: Loop
    told: list[tuple[Sample, float]]  # beside it the true speed [rad/s]


def record(loop: Loop) -> Recorder:
    """Record what the encoder's line says from now on."""
    recorder, line = Recorder(loop, []), loop.line

    def told(sample: Sample) -> Sample:
        said = line(sample)
        recorder.told.append((said, loop.board.speed))
        return said

    loop.line = told
    return recorder


def knowable(recorder: Recorder, load: float) -> float:
    """Find the time [s] after its beginning at which no motion fits a record any more; infinite: one always does."""
    loop = recorder.loop
    slot = 2.0 * np.pi / loop.edges
    lag = loop.motor.parameters().value("ka") / loop.motor.kv
    motor = Healthy(loop.motor.top / slot, lag, load, not loop.single_channel)
    before, speed = recorder.told[0]
    way = -1 if before.speed < 0.0 or (before.speed == 0.0 and speed < 0.0) else 1
    known = abs(speed) / slot  # exchanged channels show it the other way
    courses = [Course(way, np.array([[0.0, known], [1.0, known]]))]  # where in its slot, it does not know
    begin = before.sample_time
    for sample, _ in recorder.told[1:]:
        dt = (sample.sample_time - before.sample_time) * 1e-9
        after = (sample.edge_time - before.sample_time) * 1e-9
        edges = sample.edge_count - before.edge_count
        share = before.voltage / loop.motor.voltage
        courses = follow(motor, courses, Told(sample, dt, edges, share, min(max(after, 0.0), dt)))
        if not courses:
            return (sample.sample_time - begin) * 1e-9
        before = sample
    return inf


@dataclass(frozen=True)
class Answer:
    """When a fault was told, and when it could have been [s]; infinite: never."""

    told: float
    knowable: tuple[float, ...]  # by the bound of the load

    def text(self) -> str:
        """[ms]."""
        words = ["never" if one == inf else f"{1e3 * one:.0f}" for one in (self.told, *self.knowable)]
        return f"{words[0]} ({', '.join(words[1:])})"

    def ours(self, load: int) -> bool:
        """Whether it is late, and could have been known in time, by the bound of the load."""
        return self.told > MOTION >= self.knowable[load]


def ask(fault: Fault, motor: Motor, model: bool) -> Answer:
    """Inject a fault into a motor that runs, and ask both."""
    loop = Loop(motor, RATE, model, not fault.two_channels, edges=fault.edges_for(motor))
    loop.run(0.2)
    loop.reference = fault.reference_for(motor) if fault.controlled else None
    loop.raw = None if fault.controlled else fault.raw * motor.voltage
    loop.run(AT_REFERENCE)
    begin = loop.time
    fault.apply(loop)
    recorder = record(loop)
    loop.run(AFTER)
    after = outcome(loop.moments, begin).after
    return Answer(
        inf if after is None else after, tuple(knowable(recorder, one) for one in LOADS[int(fault.two_channels)])
    )


def is_of_the_line(fault: Fault) -> bool:
    """Whether a fault of line or shaft comes while a motor turns: nothing else tells but motion."""
    return fault.most == MOTION and not (fault.at_start or fault.supply)


def rows() -> tuple[list[str], list[Answer]]:
    """The rows of the faults that only motion tells and that are late in a cell, and all answers."""
    lines, answers = [], []
    for fault in filter(is_of_the_line, FAULTS):
        for model in fault.models if fault.controlled else (False,):
            cells = [ask(fault, motor, model) for motor in MOTORS[:4]]
            answers += cells
            if any(cell.told > MOTION for cell in cells):
                where = f" at {fault.reference:.0%}" if fault.controlled and "%" not in fault.name else ""
                name = fault.name + where + (", with a model" if model else "")
                lines.append(f"| {name} | {' | '.join(cell.text() for cell in cells)} |")
                print(lines[-1], file=sys.stderr)
    return lines, answers


def page() -> str:
    """The page."""
    lines, answers = rows()
    late = [one for one in answers if one.told > MOTION]
    ours, heavy = (sum(one.ours(load) for one in late) for load in (0, 1))
    head = (__doc__ or "").split("\n\nWritten", 1)[0].split("\n", 1)
    names = " | ".join(motor.name for motor in MOTORS[:4])
    return NOTE.format(
        title=head[0],
        text=head[1].strip(),
        commit=commit(),
        machine=machine(),
        late=len(late),
        count=len(answers),
        ours=ours,
        heavy=heavy,
        physics=len(late) - ours,
        table="\n".join([f"| fault | {names} |", "|---|---|---|---|---|", *lines]),
    )


NOTE = """\
# What could be known of a fault

{title}

{text}

`python benchmarks/faults_knowable.py` at {commit}, {machine}.

Of {count} faults of line and shaft on four motors at 200 Hz (one cell each, those that come while the motor turns)
{late} take longer than 0.5 s. Of these {ours} could be known in 0.5 s by such an observer if loads are as small as
they may be ({heavy} if a load that comes may take 0.6), and are late by our doing; {physics} could not.
Nothing contradicts a healthy motion: 48 of 4 s (these motors, at 3, 15 and 50 % of the top speed and reversed, one
channel and two, with a model and without) fit a load of 0.02 all the time.

Cells are times [ms] until 0 V (in brackets: until nothing fits, where a load takes up to 0.15 of the stall torque, of a
motor with two channels 0.25; and up to 0.6, which is what a load that comes while the motor turns is let be). All rows
with a cell over 500 are here. What separates the two numbers is that no model is so good, and that real motors have
play: hum is known after 5 to 20 ms because the speed would have had to jump, and behind a backlash it does. Without a
model, top speed, time constant and friction are known to this observer only.

{table}
"""


def main() -> int:
    """Write the page."""
    PAGE.write_text(page(), encoding="utf-8")
    print(PAGE)
    return 0


if __name__ == "__main__":
    sys.exit(main())
