"""Faults of motors of 3 to 6,000 rad/s with time constants of 5 ms to 2 s: those that take longer than 0.55 s.

The motors of `faults.py` have one time constant. Here the gains are those of a closed loop of half of the motor's own,
at 200 Hz. A line is a motor; what is not said was 0 V for good within 0.55 s.
"""

import sys
from collections.abc import Callable
from dataclasses import dataclass
from math import tau

from faults_injected import block, repeat, swap
from faults_line import CableOff
from faults_loop import Loop, Outcome, outcome
from faults_motor import Motor

from motor_model.parameters import Parameters
from motor_model.sample import Info

RATE, AFTER = 200.0, 4.0  # [Hz], [s]
WITHIN = 0.55  # [s] 0.5 and what a sample and a command take
MOTORS = ((3.0, 2400), (3.0, 360), (30.0, 96), (500.0, 16), (500.0, 1024), (6000.0, 6), (6000.0, 96))  # top, edges
TIME_CONSTANTS = (0.005, 0.05, 0.4, 2.0)  # [s]
VOLTAGES = (1.2, 48.0)


@dataclass(frozen=True)
class AnyMotor(Motor):
    """A motor of any time constant [s]."""

    lag: float = 0.05

    def parameters(self, supply: float = 0.0, **more: float) -> Parameters:
        """As of the other motors, with its own time constant."""
        return super().parameters(supply, **{"ka": self.kv * self.lag} | more)

    def settings(self, info: Info, model: bool) -> dict[str, object]:
        """Gains of a closed loop of half of the time constant."""
        closed = max(0.03, 0.5 * self.lag)
        gains = {"kp": self.kv * self.lag / closed, "ki": self.kv / closed}
        return super().settings(info, model) | gains


def stray(rate: float) -> Callable[[Loop], None]:
    """The encoder's cable is off, with stray edges [1/s]."""

    def apply(loop: Loop) -> None:
        loop.line = CableOff(rate, slot=tau / loop.edges)

    return apply


FAULTS: dict[str, tuple[Callable[[Loop], None], float, bool]] = {  # what, share of the top speed, two channels
    "cable off": (stray(0.0), 0.5, False),
    "cable off at 15 %": (stray(0.0), 0.15, False),
    **{f"{rate} stray edges/s": (stray(rate), 0.5, False) for rate in (5, 20, 50, 100)},
    "shaft blocked": (block, 0.5, False),
    "shaft blocked, two channels": (block, 0.5, True),
    "channels exchanged": (swap, 0.5, True),
    "channels exchanged at 10 %": (swap, 0.1, True),
    "one sample repeated": (repeat, 0.3, False),
}


def run(motor: AnyMotor, edges: int, fault: str, model: bool) -> Outcome | None:
    """What a fault does to a motor that runs; None: it is not let run."""
    apply, share, two_channels = FAULTS[fault]
    loop = Loop(motor, RATE, model, not two_channels, edges=edges)
    loop.run(0.2)
    loop.reference = share * motor.top
    loop.run(1.5 + 4.0 * motor.lag)
    if not any(moment.voltage for moment in loop.moments[-round(0.1 * RATE) :]):
        return None
    begin = loop.time
    apply(loop)
    loop.run(AFTER)
    return outcome(loop.moments, begin)


def late(motor: AnyMotor, edges: int) -> str:
    """The faults that last too long, in words: time, and the largest speed as a share of the top speed."""
    found = []
    for fault in FAULTS:
        for model in (False, True):
            one = run(motor, edges, fault, model)
            if one is None or one.after is None or one.after > WITHIN:
                time = "not let run" if one is None else "never" if one.after is None else f"{one.after:.2f} s"
                speed = f", {one.speed / motor.top:.0%}" if one else ""
                found.append(f"{fault}{', with a model' if model else ''}: {time}{speed}")
    return "; ".join(found) or "none"


def main() -> int:
    """Print the table; a voltage as an argument takes that one alone."""
    voltages = [float(word) for word in sys.argv[1:]] or VOLTAGES
    print("| top speed | edges a turn | time constant | voltage | later than 0.55 s |\n|---:|---:|---:|---:|---|")
    for top, edges in MOTORS:
        for lag in TIME_CONSTANTS:
            for voltage in voltages:
                motor = AnyMotor(top, voltage, lag)
                cells = f"{top:g} rad/s | {edges} | {lag:g} s | {voltage:g} V"
                print(f"| {cells} | {late(motor, edges)} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
