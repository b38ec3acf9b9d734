"""Faults with encoders of 8 to 2,880 edges a turn, on the slowest and the fastest motor: a section of `faults.py`."""

from math import tau

from faults_injected import block, swap
from faults_line import CableOff
from faults_loop import Loop, Outcome, outcome
from faults_motor import Motor

RATE = 200.0  # [Hz]
EDGES = (8, 24, 96, 2880)
MOTORS = (Motor(6.0, 1.2), Motor(600.0, 48.0))  # with the voltages exchanged every time is the same
STRAY = (0.0, 5.0, 50.0)  # edges a second on a line that is lost
BLOCKED, SWAPPED, AT_FIRST = "shaft blocked", "channels exchanged", "exchanged from the start"
HEADS = ("cable off", *(f"{one:g} stray/s" for one in STRAY[1:]), BLOCKED, SWAPPED, AT_FIRST)


def run(motor: Motor, edges: int, share: float, model: bool, head: str) -> Outcome | None:
    """What a fault does to a motor that runs at a share of its top speed, or shall; None: it is not let run."""
    loop = Loop(motor, RATE, model, single_channel=head not in (SWAPPED, AT_FIRST), edges=edges)
    loop.run(0.2)
    loop.reference = share * motor.top
    if head == AT_FIRST:
        swap(loop)
        loop.run(3.0)
        return outcome(loop.moments, 0.2) if any(moment.voltage for moment in loop.moments) else None
    loop.run(1.5)
    if not any(moment.voltage for moment in loop.moments[-round(0.1 * RATE) :]):
        return None
    if head == BLOCKED:
        block(loop)
    elif head == SWAPPED:
        swap(loop)
    else:
        loop.line = CableOff(STRAY[HEADS.index(head)], slot=tau / edges)
    begin = loop.time
    loop.run(3.0)
    return outcome(loop.moments, begin)


def encoders() -> list[str]:
    """The table: [ms] to 0 V for good, without a model / with one."""
    lines = [f"| motor | edges a turn | reference | {' | '.join(HEADS)} |", "|---|---:|---:|" + "---|" * len(HEADS)]
    for motor in MOTORS:
        for edges in EDGES:
            for share in (0.5, 0.15):
                cells = []
                for head in HEADS:
                    both = [run(motor, edges, share, model, head) for model in (False, True)]
                    cells.append(" / ".join(_text(one) for one in both))
                lines.append(f"| {motor.name} | {edges} | {share:.0%} | {' | '.join(cells)} |")
    return lines


def _text(one: Outcome | None) -> str:
    return "refused" if one is None else "never" if one.after is None else f"{1e3 * one.after:.0f}"


if __name__ == "__main__":
    print("\n".join(encoders()))
