"""Global search beside its peers: evaluations and time until the cost is within 1 % of the least, from every start.

Seven parameters of a motor with hidden friction (kv, ka, ks, breakaway, Stribeck speed, dead zone, delay) from 28 s of
the rich profile, an encoder of 96 slots that are 1 % irregular. All search the same box of the same compiled cost, on
the same threads; each gets all places of a generation at once where it takes them.
"""

import argparse
import os
import sys
from dataclasses import replace
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy: small matrices

import numpy as np
import peers
from machine import machine
from peers import Meter, Peer
from search_figure import Floats, Run, Table, draw

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.request import SearchConfig
from motor_identification.estimation.search.global_search import COARSE_SAMPLES
from motor_identification.estimation.search.multistart import search
from motor_identification.estimation.search.objective import Objective, make_objective
from motor_identification.experiment import make_plan, simulate_plan
from motor_identification.recording import check, recording_of
from motor_model.excitation import profile
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_model.sensing.board import BoardConfig

EFFECTS = ("static_friction", "transport_delay", "dead_zone")
LIGHT = {"ks": 0.4, "breakaway_voltage": 0.9, "stribeck_speed": 6.0, "delay": 0.006, "dead_zone_voltage": 0.6}
HEAVY = {"ks": 3.0, "breakaway_voltage": 4.5, "stribeck_speed": 10.0, "delay": 0.006, "dead_zone_voltage": 1.0}
MOTORS = {"heavy friction (breakaway 4.5 V of 12 V)": HEAVY, "light friction (breakaway 0.9 V of 12 V)": LIGHT}
GOAL = 1.01  # of the least cost
BUDGET = 10_000  # evaluations, as many as identify may spend at most
OURS, SINGLE, MULTI = "ours", "TRF, one start", "TRF, multi-start"
SWARMS = {"pymoo PSO": peers.pymoo_pso, "pyswarms global best": peers.pyswarms_pso}
LIBRARIES = {"CMA-ES (cma)": peers.cma_es, "SciPy differential evolution": peers.scipy_de, **SWARMS}
TRF = {SINGLE: peers.single_trf, MULTI: peers.multi_start_trf}
RESULTS = Path(__file__).with_name("results")
STARTS, PEER_STARTS = 100, 20  # a run of a library takes as long as forty of ours
HEAD = (
    "# Global search beside its peers",
    "",
    "Seven parameters (kv, ka, ks, breakaway, Stribeck speed, dead zone, delay) of a motor with hidden friction, from",
    "28 s of the rich profile and 96 slots that are 1 % irregular: simulations of one motor (those for derivatives",
    "counted) and time until the cost is within 1 % of the least. Ours stops when it has verified that itself, and",
    "counts only if what it returns is within 1 %; a peer is stopped there, and where it stops by itself before, it is",
    f"started again elsewhere until {BUDGET} simulations are used up.",
)
COLUMNS = (
    "| search | reached 1 % | simulations until then: median | 90th percentile | time: median | all it took, median |",
    "|---|---:|---:|---:|---:|---:|",
)


def made(values: dict[str, float]) -> tuple[Objective, float]:
    """What a search sees, and the least cost, which is where least squares leads from the truth."""
    motor = Parameters({"kv": PAPER_KV, "ka": PAPER_KA, **values}, EFFECTS)
    config = BoardConfig(slot_irregularity=0.01, seed=1)
    plan = make_plan(profile("rich"), None, 12.0, 1.0 / config.sample_rate)
    samples = [sample for _, sample in simulate_plan(plan, motor, config)]
    whole = make_problem([check(recording_of(samples, config.info(motor), "rich"))], EFFECTS, os.cpu_count() or 1)
    problem, unknowns = whole.coarsen(COARSE_SAMPLES), whole.unknowns
    truth = np.array([motor.value(name) for name in unknowns.names])
    truth[unknowns.logarithmic] = np.log(truth[unknowns.logarithmic])
    return peers.in_unit_box(make_objective(problem)), fit_speeds(Estimate(problem, truth)).cost


def ours(objective: Objective, least: float, seed: int) -> Run:
    """Our search, until it stops by itself; what it returns has to be within 1 %."""
    meter = Meter(objective, GOAL * least, 10 * BUDGET, stop_at_goal=False)
    found = search(replace(objective, costs=meter.costs, residuals=meter.residuals), SearchConfig(seed=seed))
    assert found.evaluations == meter.evaluations
    return _run(meter, found.cost <= meter.goal)


def theirs(peer: Peer, objective: Objective, least: float, seed: int) -> Run:
    """A peer, until it reached the goal or used up its evaluations."""
    meter = Meter(objective, GOAL * least, BUDGET)
    peers.run(peer, meter, seed)
    return _run(meter, meter.reached is not None)


def _run(meter: Meter, success: bool) -> Run:
    evaluations, seconds = meter.reached if meter.reached and success else (meter.evaluations, meter.elapsed)
    return Run(success, evaluations, seconds, meter.evaluations, meter.elapsed, meter.improved)


def measured(values: dict[str, float], starts: int, peer_starts: int) -> tuple[Table, float]:
    """All searches of one motor, and the least cost."""
    objective, least = made(values)
    objective.costs(np.full((4, len(objective.low)), 0.5))  # loads the compiled cost
    table = {OURS: [ours(objective, least, seed) for seed in range(starts)]}
    print(_row(OURS, table[OURS]), flush=True)
    for name, peer in (TRF | LIBRARIES).items():
        count = starts if name in TRF else peer_starts
        table[name] = [theirs(peer, objective, least, seed) for seed in range(count)]
        print(_row(name, table[name]), flush=True)
    return table, least


def _row(name: str, runs: list[Run]) -> str:
    """One line of the table; "never" where too few reached the goal for that quantile."""
    success = [run.reached for run in runs]
    cells = [name, f"{sum(success)} of {len(runs)}"]
    for share in (0.5, 0.9):
        cells.append(_number(_quantile(_until(runs), share), "{:.0f}"))
    cells.append(_number(_quantile(np.array([r.seconds if r.reached else np.inf for r in runs]), 0.5), "{:.2f} s"))
    cells.append(f"{np.median([run.total for run in runs]):.0f} in {np.median([run.duration for run in runs]):.2f} s")
    return "| " + " | ".join(cells) + " |"


def _until(runs: list[Run]) -> Floats:
    """Evaluations until the goal, infinite where it was not reached."""
    return np.array([run.evaluations if run.reached else np.inf for run in runs])


def _quantile(values: Floats, share: float) -> float:
    """The smallest value that this share of them does not exceed; infinite where too few are finite."""
    return float(np.sort(values)[max(int(np.ceil(share * len(values))) - 1, 0)])


def _number(value: float, form: str) -> str:
    return form.format(value) if np.isfinite(value) else "never"


def claims(table: Table) -> list[str]:
    """What issue 3 promises, each with its numbers and whether it holds."""
    success = {name: sum(run.reached for run in runs) for name, runs in table.items()}
    starts = len(table[OURS])
    total = np.median([run.total for run in table[OURS]])
    median = {name: _quantile(_until(table[name]), 0.5) for name in (OURS, MULTI)}
    ratio = median[OURS] / median[MULTI]
    within = sum(run.reached and run.evaluations <= total for run in table[MULTI])
    seconds = float(np.median([run.seconds for run in table[OURS]]))
    rows = [
        (success[OURS] == starts, f"the search succeeds from every start: {success[OURS]} of {starts}"),
        (success[SINGLE] < starts, f"plain least squares does not: {success[SINGLE]} of {starts} from one start each"),
        (
            within < starts,
            f"nor restarted, with the evaluations that ours takes until it stops (median {total:.0f}): {within} of "
            f"{starts}; with {BUDGET}: {success[MULTI]} of {starts}",
        ),
        (
            ratio <= 2.0,
            f"at no more than twice its evaluations: median {median[OURS]:.0f} beside {median[MULTI]:.0f} of "
            f"restarted least squares, {ratio:.2f} times",
        ),
    ]
    for name in SWARMS:
        times = np.array([run.seconds for run in table[name]])  # of those that never reached it: all they took
        faster, bound = float(np.median(times)) / seconds, success[name] < 0.5 * len(times)
        text = f"at least 10 times faster than {name}: {'more than ' if bound else ''}{faster:.0f} times"
        rows.append((faster >= 10.0, f"{text} ({success[name]} of {len(times)} reached 1 % at all)"))
    return [f"- {'holds' if holds else 'DOES NOT HOLD'}: {text}" for holds, text in rows]


def main() -> int:
    """Print and write the table and the claims, draw the figure."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help="10 starts, 3 of the libraries; writes nothing")
    quick = parser.parse_args().quick
    lacking = peers.missing()
    if lacking:
        print(f"{', '.join(lacking)} cannot be imported: install the peers with `{peers.INSTALL}`.", file=sys.stderr)
        return 1
    lines, tables = [*HEAD, f"{machine()}.", ""], {}
    for motor, values in MOTORS.items():
        print(motor, flush=True)
        table, least = tables[motor] = measured(values, *((10, 3) if quick else (STARTS, PEER_STARTS)))
        rows = [_row(name, runs) for name, runs in table.items()]
        lines += [f"## {motor[0].upper()}{motor[1:]}", "", *COLUMNS, *rows, "", *claims(table), ""]
        print("\n".join(claims(table)), flush=True)
    if not quick:
        RESULTS.mkdir(exist_ok=True)
        (RESULTS / "search.md").write_text("\n".join(lines).rstrip() + "\n", encoding="utf-8")
        draw(tables, OURS, SINGLE, GOAL, BUDGET, RESULTS / "search.png")
    return 0


if __name__ == "__main__":
    sys.exit(main())
