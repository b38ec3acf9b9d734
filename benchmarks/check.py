"""First runs on the emulated board, wired right and wrong: what `check` names, and how soon the pins are at 0 V.

The firmware is the real one on the emulated chip; somebody turns the shaft when asked, to within 4 %, and says what it
does. Voltages are those that the bridge's pins ask for, looked at every millisecond.
"""

import sys
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from machine import commit, machine

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "support"))
from first_run_bench import EmulatedRun, motor

from motor_board.build import FirmwareConfig
from motor_board.faults import Wiring
from motor_driver.check.settings import DRIVE_TIME, HIGHEST, Settings
from motor_model.gearing.gear import exact_gear
from motor_model.parameters import Parameters

RESULTS = Path(__file__).with_name("results")
SEEDS = 2
BOARD = FirmwareConfig(channels=2, supply_full_scale=60_000, board_id=7)
TOPS = {6.0: 6.0, 30.0: 12.0, 174.0: 12.0, 600.0: 24.0}  # [rad/s]: [V]
OFF_WITHIN = 0.02  # [s] from the check's wish to the pins: a sample period, a frame each way, and this loop's steps


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


def rows() -> Iterator[str]:
    """A row a case: named by all motors, and the worst of their times."""
    for case in CASES:
        tops = [top for top in TOPS if not case.gear or top < 100.0]  # a gearmotor's output
        runs = [run(case, top, seed) for top in tops for seed in range(SEEDS * len(TOPS) // len(tops))]
        named = sum(one.codes == case.codes for one in runs)
        said = ", ".join(sorted({f"`{code}`" for one in runs for code in one.codes})) or "nothing"
        off, driven = max(one.off for one in runs), max(one.driven for one in runs)
        highest, whole = max(one.highest for one in runs), max(one.whole for one in runs)
        written = sum(one.right for one in runs)
        alone = run(case, 30.0 if case.gear else 174.0, 0, hand=False)
        there = ", ".join(f"`{code}`" for code in alone.codes) or "nothing"
        yield (
            f"| {case.name} | {said} | {named} of {len(runs)} | {written} | {1e3 * off:.0f} ms | {driven:.1f} s | "
            f"{100.0 * highest:.0f} % | {whole:.0f} s | {there} |"
        )
        print(f"{case.name}: {named} of {len(runs)}, {said}", flush=True)


def accuracy() -> Iterator[str]:
    """What is measured of a motor that is wired right, beside the truth."""
    for top, volts in TOPS.items():
        runs = [run(CASES[0], top, seed) for seed in range(SEEDS)]
        spans = [
            (min(values), max(values))
            for values in ([getattr(one, name) for one in runs] for name in ("gain", "top", "breakaway"))
        ]
        shown = [f"{low:.3f} to {high:.3f}" for low, high in spans[:2]]
        late = f"{100.0 * spans[2][0]:+.1f} to {100.0 * spans[2][1]:+.1f} %"
        yield f"| {top:.0f} rad/s, {volts:.0f} V | {shown[0]} | {shown[1]} | {late} |"


def main() -> None:
    """Write the page."""
    table, numbers = list(rows()), list(accuracy())
    text = f"""# The first run with a new board

`python benchmarks/check.py`, commit {commit()}; {machine()}.

`check` on the emulated board: the real firmware on an emulated ATmega328P, a simulated motor on its pins, an encoder
with two channels and slots that are irregular by 1 %, a supply that the board measures (where nothing else is said).
{len(TOPS) * SEEDS} motors a row: top speeds of 6, 30, 174 and 600 rad/s at 6, 12, 12 and 24 V, {SEEDS} of each, with
time constants of 40 to 200 ms, friction of 3 to 8 % of the voltage, breakaway 1.4 times that, and 24 to 360 edges a
turn. Somebody turns the shaft when asked, to within 4 %, and answers. "Off": from the last sample at which the check
wants a voltage to 0 V at the pins, at most (with the board's sample period of 5 ms and frames in it). "Driven": the
longest stretch with voltage; the check allows {DRIVE_TIME:.0f} s. "Highest": of the motor's voltage; the check allows
{HIGHEST:.0%}.

| wired | said | right | file written | off | driven | highest | whole run | said with `--no-hand` |
|---|---|---|---|---|---|---|---|---|
{chr(10).join(table)}

A file is written where nothing is wrong, or where `reverse_motor` or `reverse_encoder` makes up for it. A bridge that
is stuck on turns the motor whatever the pins say: there the pins are at 0 V from the beginning, and the sentence says
to switch the supply off. With `--no-hand` wrong counts cannot be seen, one channel tells no direction, and where
nothing moves the sentence names all that it may be.

What is measured of a motor that is wired right, over the truth; the breakaway is where the first edge came, which is a
little later:

| motor | speed for a volt | top speed | breakaway, of the motor's voltage |
|---|---|---|---|
{chr(10).join(numbers)}
"""
    (RESULTS / "check.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
