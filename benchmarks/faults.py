"""Every fault that has to stop the motor, injected: time to 0 V at the pins, largest speed and voltage until then.

On the simulated plant with motors of 6, 30, 174 and 600 rad/s at 12 V and of 174 rad/s at 1.2 and 48 V, at 200 Hz and
1 kHz, with the controller's measured speed and with a model; on the emulated board with the real firmware; and between
running programs.
"""

import argparse
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from faults_board import BOARD_FAULTS, run_on_board
from faults_encoders import encoders
from faults_files import files
from faults_kill import HEAD as KILLED_HEAD
from faults_kill import killed
from faults_limits import limits
from faults_live import HEAD, live
from faults_loop import Loop, Outcome, outcome
from faults_motor import MOTORS, Motor
from faults_rows import FAULTS, Fault
from machine import commit, machine

RESULTS = Path(__file__).with_name("results")
RATES = (200.0, 1000.0)  # [Hz]
AT_REFERENCE, AFTER = 1.5, 3.0  # [s]
BEFORE = 1.0  # [s] that a fault of the line is there before the reference comes
BOARD_MOTORS = (MOTORS[0], MOTORS[2], MOTORS[3])
TEMPLATE = Path(__file__).with_name("faults_page.md")


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
        fault.apply(loop)
        begin = loop.time  # a fault that comes in two steps lets time pass
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
        for model in fault.models if fault.controlled else (False,):
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


def table(motors: Iterable[Motor], rows: Iterable[str]) -> str:
    """The rows under a head that names the motors."""
    names = [motor.name for motor in motors]
    head = f"| fault | may take | {' | '.join(names)} | speed | voltage | what was said |"
    return "\n".join([head, "|---|---|" + "---|" * len(names) + "---|---|---|", *rows])


def known() -> Iterable[tuple[str, bool]]:
    """The emulated board's rows of the page as it is."""
    lines = (RESULTS / "faults.md").read_text(encoding="utf-8").split("\n## Emulated board", 1)[1].split("\n## ", 1)[0]
    for line in lines.splitlines():
        if line.startswith("| ") and not line.startswith("| fault |"):
            yield line, "**no**" not in line


def page(board: list[tuple[str, bool]], of_board: str) -> str:
    """The whole page; the sentences around the tables stand in `faults_page.md`; of_board: what its rows are of."""
    between, dead, sim = live(), killed(), list(simulated())
    met = [ok for _, ok in sim + board + between + dead]
    return TEMPLATE.read_text(encoding="utf-8").format(
        commit=commit(),
        machine=machine(),
        met=sum(met),
        count=len(met),
        simulated=table(MOTORS, (line for line, _ in sim)),
        of_board=of_board,
        live="\n".join([HEAD, *(line for line, _ in between)]),
        killed="\n".join([KILLED_HEAD, *(line for line, _ in dead)]),
        emulated=table(BOARD_MOTORS, (line for line, _ in board)),
        encoders="\n".join(encoders()),
        files="\n".join(files()),
        limits="\n".join(limits()),
    )


def main() -> int:
    """Write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--simulated", action="store_true", help="the emulated board's rows stay as they are")
    if parser.parse_args().simulated:
        board, of_board = list(known()), "`--simulated`: these rows are those of the page before."
    else:
        board, of_board = list(emulated()), ""
    (RESULTS / "faults.md").write_text(page(board, of_board), encoding="utf-8")
    print(RESULTS / "faults.md")
    return 0


if __name__ == "__main__":
    sys.exit(main())
