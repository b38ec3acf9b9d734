"""Every fault that has to stop the motor, injected: time to 0 V at the pins, largest speed and voltage until then.

On the simulated plant with motors of 6, 30, 174 and 600 rad/s at 12 V and of 174 rad/s at 1.2 and 48 V, at 200 Hz and
1 kHz, with the controller's measured speed and with a model; and on the emulated board with the real firmware.
"""

import sys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from faults_board import BOARD_FAULTS, run_on_board
from faults_encoders import encoders
from faults_limits import limits
from faults_loop import Loop, Outcome, outcome
from faults_motor import MOTORS, Motor
from faults_rows import FAULTS, Fault
from machine import commit, machine

RESULTS = Path(__file__).with_name("results")
RATES = (200.0, 1000.0)  # [Hz]
AT_REFERENCE, AFTER = 1.5, 3.0  # [s]
BEFORE = 1.0  # [s] that a fault of the line is there before the reference comes
BOARD_MOTORS = (MOTORS[0], MOTORS[2], MOTORS[3])


NOTE = """\
Not within their time, and why: at 3 % of the top speed the 6 and 30 rad/s motors make 2.8 and 14 edges a second, and a
loop as slow as that needs up to 0.72 s to raise its voltage to one that any motor would turn at; only a model knows
earlier. The information is not there: under the voltage of that loop (from a quarter of the limit, 13 V/s) the slowest
motor that is let run (90 edges a second at its top speed, a time constant of 1 s, friction and load of 45 % of the
voltage) has shown half an edge after 0.5 s. Tried: to stop where the voltage without an edge has pushed as much as the
0.4 s at half of it do that are a stop now. That takes 475 to 573 ms, and stops a slow ramp through a friction of 40 to
50 % of the voltage, and one of 530 ordinary motors (seed 50020 of `no_false_stops.py`).

5 and 20 stray edges a second are about what is wanted there (at 174 rad/s 80), and too few for their periods to be
judged (from 35 a second on; ten edges tell). With a model they are judged by where the observer expects them. So
that no motor of 680 is stopped that has a random torque, a wrong model, play or an irregular disc, that takes some
fifteen edges: 0.3 s at 50 a second, 0.9 s at 20, and 3 s at 5, of which two or three come in half a second, and in 8
of 100 half seconds none. Twelve sequences of strays at 20 a second, on the 6 and 30 rad/s motors at 3 and 15 % of
their top speed, stopped them after 1.2, 1.1, 0.9 and 0.3 s in the median. Fewer edges would do (1.0, 0.9, 0.7 and 0.3
s), and then a random torque of 5 % of the supply stops a motor that crawls: it shows the same edges. Without a model
nothing tells them from a motor of 12 edges a second at its top speed under a load, which is let run: such a motor turns
as it likes, at up to 97 % of its top speed, and stops late or never. From 50 a second on stray edges stop it in time
(but for one run of the 6 rad/s motor), and at half of the top speed at any rate.

Exchanged channels at 5 % of 6 rad/s with a model: 4.6 edges a second, and a load of a quarter of the voltage may drive
a motor with two channels backward, so that only a voltage beyond that tells, which a gentle loop takes its time to
reach. Without a model they are told from 3 % of the top speed on, by more than 0.27 of the voltage that presses against
a motion and does not slow it down. At 1 to 2.5 % the 174 and 600 rad/s motors come to a steady 12 to 24 % of their
top speed: nearly nothing but friction has been learnt of them, by which the plug limit leaves 0.23 of the voltage, and
up to a quarter may be what a load of 25 % is held by. But such a load would be braked; that the motion does not become
slower tells, 0.9 to 1.2 s after the exchange.

Without an encoder on 0.48 V, measured, of a 1.2 V motor: the plant's own check takes less than 3 V for a supply that is
off, and the controller's `stall_time` of 0.5 s is what remains.

Hum that is a little slower than what is wanted (100 Hz at 5 % of 174 rad/s) looks like a motor that nearly does as
told: a loop raises its voltage at the rate of its integral, and the motor runs away meanwhile. That no voltage changes
the speed by a fiftieth is known once the voltage has grown by half of all there is, and with a model that it has grown
beyond what 0.6 of the stall torque asks for. Before these rules it was 97 % of the top speed for ever. The 6 and 30
rad/s motors are slower there than the hum of any mains; of theirs (3 and 17 edges a second, with a model) the faster
one is stopped after 6.3 s, and the slower one turns at up to 35 %. A motor that ran before the line was
lost is judged by what that motion needed: 8 edges a turn, 50 Hz (39 rad/s of 174) and 60 rad/s wanted was the top speed
for ever, and is a stop after 1.4 s; too late not to reach it, for a time constant of 60 ms takes 0.2 s. It has to be
more than a load of 0.65 of the voltage that has come: hum from about 0.3 of the top speed on is let be, as is a motor
that a heavy load has slowed down so far (the table's rows of 35 and 50 %: 0.75 and 0.9 of the edges). With a bound of
0.5 most of those rows stop after 0.7 to 1.7 s (from 0.45 of the top speed on none), and so does a motor that a load of
0.63 of the stall torque brakes from 100 to 60 rad/s. Wanted at several times its speed, hum that was there from the
start is let be without a model, and from 0.3 of the top speed on with one: the loop gets all the voltage within 0.2 s,
and it is taken for a motor that is as slow as that. A flywheel of 5 s that coasts near its top speed shows the same.

Hum of the mains itself is told by more (the rows "of the mains"): its rhythm. Ten edges whose periods scatter by less
than 0.6 %, within 1.5 % of 50, 60, 100 or 120 a second, are hum, or a motor on a very even disc that happens to turn
so. Under 0 V for 0.5 s they are hum, for a motor would become slower: hum that was there from the start is told before
the motor moves. Beside more voltage than the last steady motion, or the model, needs for that speed and a load of 0.25,
and 2 % and more off what is wanted, they are hum as well. It was the top speed for ever at 0.75 and 0.9 of the edges
that are wanted, with a model too, and is a stop after 0.4 to 0.8 s at half of the top speed (1.0 s in one cell whose
crossings tremble unluckily; to 1.4 s at 70 % of it, where all the voltage is little more than a load of 0.25, and at
0.9 of the edges with a model at 1 kHz of the 6 and 30 rad/s motors not within 3 s). The other side, measured: 0 stops
of 160 random motors (3 to 600 edges a turn, irregular by 0 to 1 %, time constants of 0.02 to 5 s) that are wanted at
exactly such a rate, under loads of 0.3 of the voltage that come slowly or at once, are 4 % off it, are asked for three
times of it, or coast through it and are asked again; and 17 of 40 that a load of 0.47 to 0.76 of the stall torque
brakes to within 0.4 % of such a rate, and holds there under all the voltage. Hum of 1.3 times the edges that are wanted
lets a motor stand without a model, and with one turn at 0.75 of its top speed at most (0.7 wanted): that is let be. Hum
of other sources (a bridge's PWM) is judged as above.

A contact that is there for 20 of every 100 ms showed a fifth of the edges, and the loop made up for the rest (77 % of
the top speed for ever in place of 50). The third gap that no motor could have come out of so fast is the end of it; at
6 rad/s and 1 kHz other checks have to tell. Below 3 % of the top speed of the 6 rad/s motor (2.7 edges a second) a
driver that repeats one sample says, as true ones do, that the motor stands.

A shaft that is blocked while the voltage turns to and fro at every sample is stopped after 1.9 s (it was 0.5 s): a
healthy motor that oscillates within one slot, as in a chirp on a coarse disc, shows and gets the same, so that the mean
square counts over 16 stall times there. A push one way that has brought an edge before, and a voltage that does not
turn its sign, count over 4 as before.

Tried, and let be: two channels whose direction flips now and then (at 0.5 to 50 % of the samples, at half of the top
speed: 50 % without a model, 61 % with one, and stopped after 0.5 s where it flips seldom); 40 % of the edges lost,
which is a stop after 1.2 to 7 s at up to 84 %; a plant that reports half of its speed, and edges to match: nothing but
another sensor could tell.

Somebody who answers every stop at once with `motor/reset`, `motor/enable` and a fresh reference got the motor each
time, for as long as it takes to tell the fault: with exchanged channels half of the voltage on average for ever, with a
blocked shaft 95 %. Now the second stop within a minute of the one before is followed by a rest of 1 s, in which both
services refuse and say so, and each further one by twice that, up to 32 s; a minute without a stop forgets (the last
table's two rows of a minute). A plant or a controller that is started anew has forgotten, too. A link that was lost and
a board that was reset do not count: they heat no motor.

Not in the table: the cable lost at a reference of 0 rad/s. A motor of one channel that has come to rest gets 0 V there,
whatever edges come, and stands: 5, 20 and 50 stray edges a second, four sequences each, on motors of 6 to 600 rad/s.
Under the observer each stray edge used to be pushed back as if a hand turned the shaft, at up to 60 % of the top speed,
and mostly for ever: no check could tell, for the shaft turned to and fro by as many slots as stray edges came (7 to 68
in 5 s beside 25). With two channels a load may be larger than friction, and the observer has half of the voltage
there. On the same motors with 96 and 960 edges a turn 20 and 50 stray edges a second turn it at up to 44 % of its top
speed until it is stopped after 0.2 to 4.5 s (one of 31 sequences that move it is not in 5 s), 5 a second at up to 43 %,
in half of the cases for more than 5 s. On the measured speed it is 8 % at most, for ever up to 20 a second."""

ENCODERS = """\
8 to 2,880 edges a turn on the slowest and the fastest motor, simulated, at 200 Hz; [ms] without a model / with
one. Where fewer than 10 edges a second are all that there is (6 rad/s, 8 edges), every plant reports a
standstill: with a model the motor is refused, without one it is stopped as stalled, or at a
speed that stray edges decide. With 24 and 96 edges at 15 % of 6 rad/s (3 and 14 edges a second) 5 stray edges a second
look like the speed that is asked for, and exchanged channels take 0.4 and, with 24 edges, 1.5 s with a model: a load of
a quarter of the voltage may drive a motor with two channels backward, so that only a voltage beyond that tells. 2,880
edges at 300 rad/s come every 7 us, and the timer ticks every 4: nothing is learnt of that motor, as of one whose
channels were exchanged from the start. A loop that does not know the back-EMF lets it coast, and pushes it in pulses;
three of half the voltage and more that make it faster the other way tell; weaker ones may be what a load is held by,
so that gains of a twelfth take 7.3 s from the start, at up to 6 % of the top speed (600 rad/s, 960 edges, 15 %)."""


@dataclass(frozen=True)
class Cell:
    """One motor, at both rates."""

    motor: Motor
    outcomes: tuple[Outcome, ...]

    def text(self) -> str:
        """[ms] at each rate."""
        return " / ".join("never" if one.after is None else f"{1e3 * one.after:.0f}" for one in self.outcomes)


def run(fault: Fault, motor: Motor, rate: float, model: bool) -> Outcome:
    """What a fault does to a motor that runs."""
    supply = fault.supply * motor.voltage
    edges = fault.edges_for(motor)
    loop = Loop(motor, rate, model, not fault.two_channels, supply, edges=edges, measured=supply > 0.0)
    loop.run(0.2)
    if fault.at_start:
        fault.apply(loop)
        loop.run(BEFORE)
    loop.reference = fault.reference_for(motor) if fault.controlled else None
    if not fault.controlled:
        loop.raw = fault.raw * motor.voltage
    begin = loop.time
    if not fault.at_start:
        loop.run(AT_REFERENCE)
        begin = loop.time
        fault.apply(loop)
    loop.run(AFTER)
    return outcome(loop.moments, begin)


def row(name: str, most: float, cells: list[Cell]) -> tuple[str, bool]:
    """A line of the table, and whether it is met."""
    outcomes = [(cell.motor, one) for cell in cells for one in cell.outcomes]
    met = all(one.after is not None and one.after <= most + 1e-9 for _, one in outcomes)
    speed = max(one.speed / motor.top for motor, one in outcomes)
    voltage = max(one.voltage / motor.voltage for motor, one in outcomes)
    said = next((one.said for motor, one in outcomes if motor == MOTORS[2] and one.said), outcomes[0][1].said)
    times = " | ".join(cell.text() for cell in cells)
    mark = "" if met else " **no**"
    return f"| {name} | {1e3 * most:.0f}{mark} | {times} | {speed:.0%} | {voltage:.0%} | {said} |", met


def simulated() -> Iterable[tuple[str, bool]]:
    """The rows of the simulated plant."""
    for fault in FAULTS:
        for model in (False, True) if fault.controlled else (False,):
            cells = [Cell(m, tuple(run(fault, m, rate, model) for rate in RATES)) for m in MOTORS]
            name = fault.name + (", with a model" if model else "")
            yield row(name, fault.most, cells)
            print(name, [cell.text() for cell in cells], file=sys.stderr)


def emulated() -> Iterable[tuple[str, bool]]:
    """The rows of the emulated board."""
    for fault in BOARD_FAULTS:
        cells = [Cell(m, tuple(run_on_board(fault, m, rate) for rate in RATES)) for m in BOARD_MOTORS]
        yield row(fault.name, fault.most, cells)
        print(fault.name, file=sys.stderr)


def page() -> str:
    """The whole page."""
    sim, board = list(simulated()), list(emulated())
    met = [ok for _, ok in sim + board]
    heads = " | ".join(motor.name for motor in MOTORS)
    return "\n".join(
        [
            "# Faults",
            "",
            f"`python benchmarks/faults.py` at {commit()}, {machine()}.",
            "",
            f"{sum(met)} of {len(met)} rows are within their time: 150 ms after a fault could be known, 500 ms where",
            "only motion can tell. A row that is not is marked **no**; `never` is no 0 V for good within 3 s.",
            "",
            "Each fault comes to a motor that runs at half of its top speed (or, under plain `motor/voltage`, at 60 %",
            "of its voltage). Times [ms] from the fault to 0 V at the pins for good, at 200 Hz / 1 kHz; the largest",
            "true speed and voltage from the fault on, as shares of the motor's, over all cells; what was said of the",
            "174 rad/s motor.",
            "",
            NOTE,
            "",
            "## Simulated plant",
            "",
            f"| fault | may take | {heads} | speed | voltage | what was said |",
            "|---|---|" + "---|" * len(MOTORS) + "---|---|---|",
            *[line for line, _ in sim],
            "",
            "## Emulated board: the real firmware, the driver, the controller",
            "",
            f"| fault | may take | {' | '.join(m.name for m in BOARD_MOTORS)} | speed | voltage | what was said |",
            "|---|---|" + "---|" * len(BOARD_MOTORS) + "---|---|---|",
            *[line for line, _ in board],
            "",
            "## Other encoders",
            "",
            ENCODERS,
            "",
            *encoders(),
            "",
            "## What is limited, and nothing to stop for",
            "",
            *limits(),
            "",
        ]
    )


def main() -> int:
    """Write the page."""
    (RESULTS / "faults.md").write_text(page(), encoding="utf-8")
    print(RESULTS / "faults.md")
    return 0


if __name__ == "__main__":
    sys.exit(main())
