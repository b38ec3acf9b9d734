"""The base paper reproduced: its step and fit, its four gain pairs in simulation and on "hardware", its statements.

`--emulated` also runs the loop on the real firmware on the emulated microcontroller. Writes results/paper.md and its
figures. What is assumed where the paper is silent stands in `paper_loop.Assumption`.
"""

import argparse
import os
import sys
from pathlib import Path
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy: small matrices

import numpy as np
import paper_words as words
from machine import machine
from paper_figures import draw_fit, draw_friction, draw_pairs
from paper_fit import DISCS, by_edges, by_swarm, errors, record, with_friction
from paper_loop import FREE, HARDWARE, PAIRS, RATES, REFERENCES, UNITS, Assumption, Bench, Row, judge, run, simulation
from paper_statements import statements_table
from paper_study import CAUSES, Causes, Table, calm_discs, deviation, table, varied, verdicts

from motor_model.parameters import Parameters

RESULTS = Path(__file__).with_name("results")
DISC_COUNT, FITS = 9, 15
LOW = 20.0  # [rad/s] a slow reference, where friction shows
TEMPLATE = Path(__file__).with_name("paper_page.md")
NO_ANTI_WINDUP = "without anti-windup"
VARIANTS: dict[str, dict[str, bool]] = {
    NO_ANTI_WINDUP: {"anti_windup": False},
    "the integral sums errors without their time step": {"per_sample": True},
    "the output may brake (±12 V)": {"brakes": True},
}
Page = dict[str, Any]  # the template's fields


def fit_part(page: Page) -> Parameters:
    """Figs. 5 and 6, and how wrong each fit is; the paper's model of the hardware."""
    recording = record(Bench(HARDWARE), 0)
    papers, ours = by_swarm(recording), by_edges(recording)
    draw_fit(recording, papers, ours, RESULTS / "paper_fit.png")
    page["fits"], page["fitted"] = FITS, words.fitted_sentence(papers, ours)
    page["errors"] = words.errors_table({name: errors(bench, FITS) for name, bench in DISCS.items()})
    off = with_friction(0.01)
    page["friction"] = ", ".join(f"{name} {abs(error):.0e}" for name, error in off.items())
    return papers.model


def emulated_table(assumption: Assumption, discs: int) -> Table:
    """All pairs on the emulated board."""
    from paper_emulated import run_emulated

    def row(pair: tuple[float, float]) -> Row:
        runs = [run_emulated(pair, assumption, HARDWARE, seed) for seed in range(discs)]
        rows = [judge(one, assumption.reference) for one in runs]
        return Row(*(float(np.median([getattr(r, name) for r in rows])) for name in Row.__dataclass_fields__))

    return {pair: row(pair) for pair in PAIRS}


def pairs_part(page: Page, assumption: Assumption, fitted: Parameters, emulated: bool) -> tuple[Table, Table]:
    """Figs. 7 to 9 and the table of the four pairs, in simulation and on the hardware."""
    simulated, hardware = table(assumption, simulation(fitted), 1), table(assumption, Bench(HARDWARE), DISC_COUNT)
    draw_pairs(
        [run(pair, assumption, simulation(fitted)) for pair in PAIRS],
        [run(pair, assumption, Bench(HARDWARE)) for pair in PAIRS],
        assumption.reference,
        RESULTS / "paper_pairs.png",
    )
    board = {rate: emulated_table(varied(assumption, rate=rate), 3) for rate in RATES[:2]} if emulated else {}
    page["pairs"] = words.pairs_table(assumption, simulated, hardware)
    page["board"] = words.board_section(assumption, hardware, board)
    return simulated, hardware


def cause_part(page: Page, assumption: Assumption, fitted: Parameters) -> dict[float, Causes]:
    """The hardware without one thing at a time, at the usual reference and at a slow one."""
    tables, found = [], {}
    for reference in (assumption.reference, LOW):
        there = varied(assumption, reference=reference)
        simulated = {True: table(there, simulation(FREE), 1), False: table(there, simulation(fitted), 1)}
        rows = {name: table(there, bench, DISC_COUNT) for name, bench in CAUSES.items()}
        apart = {
            name: deviation(rows[name], simulated[bench.motor is FREE], reference) for name, bench in CAUSES.items()
        }
        found[reference] = Causes(rows, apart)
        tables.append(words.causes_table(there, found[reference]))
    page["causes"] = "\n\n".join(tables)
    draw_friction(*friction_curves(assumption, fitted), RESULTS / "paper_friction.png")
    return found


def friction_curves(assumption: Assumption, fitted: Parameters) -> tuple[list[float], dict[str, list[float]]]:
    """How far [10, 1] is from simulation over the reference, for four pairs of hardware and simulation."""
    references = [10.0, 15.0, 20.0, 30.0, 50.0, 75.0, 100.0, 125.0, 150.0]
    cases = {
        "simulated with the fitted kv (as the paper does)": (Bench(HARDWARE), fitted),
        "the same, exact speed: friction without quantisation": (CAUSES["with the exact speed"], fitted),
        "simulated with kv = 12 V / 174.097 rad/s": (Bench(HARDWARE), FREE),
        "hardware without friction, the same kv": (Bench(FREE), FREE),
    }
    curves: dict[str, list[float]] = {}
    for name, (bench, model) in cases.items():
        for reference in references:
            there = varied(assumption, reference=reference)
            apart = deviation(table(there, bench, 3), table(there, simulation(model), 1), reference)
            curves.setdefault(name, []).append(apart[PAIRS[0]])
    return references, curves


def sweep_part(page: Page, fitted: Parameters) -> None:
    """Every unit, rate and reference: which statements hold."""
    cells: dict[tuple[str, float], list[str]] = {}
    for unit in UNITS:
        for rate in RATES:
            for reference in REFERENCES:
                held = verdicts(Assumption(unit, rate, reference), fitted, DISC_COUNT)
                cells.setdefault((unit, rate), []).append(held.letters())
            print(unit, f"{rate:g} Hz", *cells[unit, rate], flush=True)
    page["sweep"] = words.sweep_table(cells)


def variant_part(page: Page, assumption: Assumption, hardware: Table) -> None:
    """What the other silent choices change."""
    rows = {"as assumed": hardware}
    for name, change in VARIANTS.items():
        rows[name] = table(varied(assumption, **change), Bench(HARDWARE), DISC_COUNT)
    page["variants"] = words.variants_table(assumption, rows)
    page["windup"] = max(abs(rows[NO_ANTI_WINDUP][pair].mean - hardware[pair].mean) for pair in PAIRS)


def write(emulated: bool) -> None:
    """Compute everything, and write page and figures."""
    assumption = Assumption()
    page: Page = {"machine": machine(), "discs": DISC_COUNT, "unit": assumption.unit, "rate": assumption.rate}
    page["command"] = "python benchmarks/paper.py" + " --emulated" * emulated
    page["reference"] = assumption.reference
    fitted = fit_part(page)
    simulated, hardware = pairs_part(page, assumption, fitted, emulated)
    found = cause_part(page, assumption, fitted)
    calm = calm_discs(assumption, Bench(HARDWARE), DISC_COUNT), DISC_COUNT
    page["statements"] = statements_table(assumption, simulated, hardware, found, calm)
    sweep_part(page, fitted)
    variant_part(page, assumption, hardware)
    text = TEMPLATE.read_text(encoding="utf-8").format(**page)
    (RESULTS / "paper.md").write_text(text, encoding="utf-8")


def main() -> int:
    """Write results/paper.md."""
    parser = argparse.ArgumentParser(description="Reproduce the paper's figures and check its statements.")
    parser.add_argument("--emulated", action="store_true", help="also on the emulated board (needs avr-gcc and simavr)")
    options = parser.parse_args()
    if options.emulated:
        from paper_emulated import available

        if why := available():
            print(why, file=sys.stderr)
            return 1
    RESULTS.mkdir(exist_ok=True)
    write(options.emulated)
    return 0


if __name__ == "__main__":
    sys.exit(main())
