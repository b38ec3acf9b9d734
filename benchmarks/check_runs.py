"""Ways to wire a board, right and wrong, and one first run on each: what is named, and for how long pins stay on."""

import sys
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "support"))
from first_run_bench import EmulatedRun, motor

from motor_board.build import FirmwareConfig
from motor_board.emulation.wiring import Wiring
from motor_driver.check.settings import Settings
from motor_model.gearing.gear import exact_gear
from motor_model.parameters import Parameters

BOARD = FirmwareConfig(channels=2, supply_full_scale=60_000, board_id=7)
TOPS = {6.0: 6.0, 30.0: 12.0, 174.0: 12.0, 600.0: 24.0}  # [rad/s]: [V]


@dataclass(frozen=True)
class Case:
    """A way to wire it, and what has to be said of it."""

    name: str
    codes: tuple[str, ...] = ()
    wiring: Wiring = field(default_factory=Wiring)
    channels: int = 2
    measured: bool = True  # the supply
    supply: float = 1.0  # over the expected one
    edges: float = 1.0  # over what the person says
    board_id: int = 7  # that the person expects
    gear: float = 0.0  # of a gearmotor with 11 pulses a turn of its own shaft, counted fourfold; 0: none
    said_gear: float = 0.0  # where the person says another one
    alone: str = ""  # what is said with --no-hand, where that differs


CASES = (
    Case("nothing wrong"),
    Case("A and B exchanged", ("channels_swapped",), Wiring(channels_swapped=True), alone="against"),
    Case("motor's wires exchanged", ("motor_swapped",), Wiring(motor_swapped=True), alone="against"),
    Case("A missing", ("a_missing",), Wiring(a_connected=False), alone="no_motion"),
    Case("B missing", ("b_missing",), Wiring(b_connected=False)),
    Case("no supply, measured", ("no_supply",), Wiring(powered=False)),
    Case("no supply, not measured", ("no_power",), Wiring(powered=False), measured=False, alone="no_motion"),
    Case("wrong counts", ("wrong_counts",), edges=0.5, alone="nothing"),
    Case("wrong board", ("wrong_board",), board_id=9),
    Case("supply too high", ("supply_too_high",), supply=2.0),
    Case("stuck shaft", ("stuck_shaft",), Wiring(shaft_stuck=True), alone="no_motion"),
    Case("bridge stuck on", ("bridge_stuck_on",), Wiring(bridge_stuck=0.6)),
    Case("no pull-ups, hum of 50 Hz", ("hum",), Wiring(hum=50.0)),
    Case("nothing wrong, 11 pulses × 34.014", gear=34.014),
    Case("the same, A missing", ("a_missing",), Wiring(a_connected=False), gear=34.014, alone="no_motion"),
    Case("the same, B missing", ("b_missing",), Wiring(b_connected=False), gear=34.014),
    Case("the same, 50:1 said", ("wrong_counts",), gear=34.014, said_gear=50.0, alone="nothing"),
    Case("nothing wrong, one channel", channels=1),
    Case("motor's wires exchanged, one channel", ("motor_swapped",), Wiring(motor_swapped=True), 1, alone="nothing"),
    Case("hum of 60 Hz, one channel", ("hum",), Wiring(hum=60.0), 1, alone="edges_at_rest"),
)


@dataclass(frozen=True)
class Run:
    """One first run."""

    codes: tuple[str, ...]
    right: bool
    off: float  # [s] longest from the check's last wish for a voltage to 0 V at the pins
    driven: float  # [s] with voltage at the pins at a stretch
    highest: float  # over the motor's voltage
    whole: float  # [s]
    gain: float = float("nan")  # measured over true
    top: float = float("nan")
    breakaway: float = float("nan")  # measured less true, over the motor's voltage


def drawn(top: float, seed: int) -> tuple[Parameters, int, float]:
    """A motor of this top speed, its encoder's edges, and how far a hand turns it."""
    random = np.random.default_rng([round(top), seed])
    true = motor(top, TOPS[top], random.uniform(0.04, 0.2), random.uniform(0.03, 0.08))
    edges = int(random.choice([24, 48, 96] if top > 300.0 else [24, 48, 96, 360]))
    return true, edges, float(np.clip(random.normal(1.0, 0.02), 0.96, 1.04))


def run(case: Case, top: float, seed: int, hand: bool = True) -> Run:
    """One first run of a case."""
    true, edges, turns = drawn(top, seed)
    edges = 11 if case.gear else edges
    said = exact_gear(case.said_gear or case.gear or 1.0)
    board = replace(BOARD, channels=case.channels, supply_full_scale=BOARD.supply_full_scale if case.measured else 0)
    settings = Settings(
        true.max_voltage,
        edges_per_revolution=edges,
        quadrature=4 if case.gear else 1,
        gear=said,
        board_id=case.board_id,
        hand=hand,
    )
    supply = case.supply * true.max_voltage
    counts = round(edges * case.edges)
    bench = EmulatedRun(settings, true, case.wiring, board, counts, case.gear or 1.0, supply, seed, turns)
    done = bench.run()
    codes = tuple(done.check.record.codes) if done.check else (done.code,)
    measured = done.check.record.measured if done.check else None
    right = bool(done.check and done.check.right)
    timing = (*_times(bench), max(abs(volts) for _, volts in bench.pins) / true.max_voltage, bench.pins[-1][0])
    if measured is None or not right:
        return Run(codes, right, *timing)
    late = 0.5 * (measured.breakaway_forward + measured.breakaway_backward) - true.values["breakaway_voltage"]
    shares = (measured.gain / true.gain, measured.top_speed / top, late / true.max_voltage)
    return Run(codes, right, *timing, *shares)


def _times(bench: EmulatedRun) -> tuple[float, float]:
    """The longest times [s] that pins stay on after the last wish, and at a stretch."""
    off = driven = 0.0
    wished, begun = -1.0, None
    for (time, volts), (_, asked) in zip(bench.pins, bench.asked, strict=True):
        if volts:
            off = max(off, time - wished)
            begun = time if begun is None else begun
            driven = max(driven, time - begun)
        else:
            begun = None
        wished = time if asked else wished
    return off, driven
