"""Our own motors exported as other people's logs, imported again without hints, and identified: what comes back.

Random motors, rates from 10 Hz to 1 kHz, positions, counts and speeds in any unit, held values, jitter, whole
milliseconds, decimal commas, duties of a battery, wraps (`tests/support/exported_logs.py`). The only word that is said
is how many counts a turn has, where a log counts.
"""

import argparse
import os
import sys
import tempfile
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy: small matrices
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "support"))

import numpy as np
from exported_logs import Case, draw_case, write_case
from machine import commit, machine

from motor_identification.identify import Request, identify
from motor_identification.logs.columns.guess import guess_forms
from motor_identification.logs.columns.said import Said
from motor_identification.logs.csv.reader import read_table
from motor_identification.logs.form import Kind
from motor_identification.logs.imported import import_log
from motor_identification.recording import check, recording_of
from motor_model.errors import MotorError

RESULTS = Path(__file__).with_name("results")
NEAR = {"kv": 0.01, "ka": 0.05}
FINE = 0.5  # periods of the sensor in a time constant: a coarser log hardly shows ka


@dataclass(frozen=True)
class Result:
    """What came back: relative errors, or why nothing did."""

    case: Case
    errors: dict[str, float]
    named: bool  # whether columns, kind and units were guessed as they are
    trouble: str = ""
    on_bound: tuple[str, ...] = ()  # parameters that `identify` says are at the limit of their search range

    @property
    def near(self) -> bool:
        return not self.trouble and all(abs(self.errors[name]) <= most for name, most in NEAR.items())


def run(case: Case, folder: Path) -> Result:
    path = folder / f"log_{case.seed}.csv"
    write_case(case, path)
    said = Said(edges_per_revolution=case.edges if case.kind is Kind.COUNT else None)
    try:
        (form,) = guess_forms(read_table(path), said).forms
        named = (form.kind, form.unit, form.time_unit) == (case.kind, case.unit, case.time_unit)
        (motor,) = import_log(path, said).motors
        runs = [check(recording_of(run.samples, motor.log.info, run.label)) for run in motor.log.runs]
        fit = identify(runs, Request(("coulomb_friction",)))
    except MotorError as error:
        return Result(case, {}, False, str(error).replace(str(path), "log.csv"))
    found = fit.parameters.values
    errors = {name: found[name] / case.truth.values[name] - 1.0 for name in NEAR}
    return Result(case, errors, named, on_bound=tuple(name for name, on in fit.on_bound.items() if on))


def group(results: list[Result], title: str) -> str:
    if not results:
        return f"| {title} | 0 | | | | |"
    errors = {name: np.abs([one.errors[name] for one in results if one.errors]) for name in NEAR}
    near = sum(one.near for one in results)
    named = sum(one.named for one in results)
    cells = [f"{100 * np.median(values):.2g} / {100 * np.quantile(values, 0.95):.2g} %" for values in errors.values()]
    return f"| {title} | {len(results)} | {named} | {cells[0]} | {cells[1]} | {near} |"


def rows(results: list[Result]) -> list[str]:
    fine = [one for one in results if one.case.slow <= FINE]
    lines = [group(results, "all"), group(fine, f"sensor's period up to {FINE:g} time constants")]
    lines += [group([one for one in fine if one.case.kind is kind], f"… {kind.value}") for kind in Kind]
    lines += [group([one for one in fine if one.case.held > 1], "… held")]
    lines += [group([one for one in fine if one.case.jitter > 0.0], "… jitter of 10 or 20 %")]
    lines += [group([one for one in fine if one.case.whole and one.case.time_unit == "ms"], "… whole milliseconds")]
    coarse = [one for one in results if one.case.slow > FINE]
    return [*lines, group(coarse, f"sensor's period above {FINE:g} time constants")]


def failures(results: list[Result]) -> list[str]:
    lines = []
    for one in results:
        if one.near and one.named:
            continue
        case = one.case
        what = one.trouble or ", ".join(f"{name} {100 * error:+.2g} %" for name, error in one.errors.items())
        about = [f"{case.rate:g} Hz", case.kind.value, case.unit, f"{case.edges} counts a turn"]
        about += [f"held {case.held} rows"] if case.held > 1 else []
        about += [f"jitter {100 * case.jitter:g} %"] if case.jitter else []
        about += [f"whole {case.time_unit}"] if case.whole else []
        about += ["duty"] if case.duty else []
        about += ["wraps"] if case.wraps else []
        about += [f"period {case.slow:.2g} time constants", "" if one.named else "named otherwise"]
        about += [f"`identify` says that {' and '.join(one.on_bound)} is on its bound"] if one.on_bound else []
        lines.append(f"- {case.seed}: {what} ({', '.join(filter(None, about))})")
    return lines


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cases", type=int, default=200)
    parser.add_argument(
        "--first", type=int, default=5000, help="first case; 0 to 199 were looked at while it was written"
    )
    options = parser.parse_args()
    cases, first = options.cases, options.first
    with tempfile.TemporaryDirectory() as folder:
        results = [run(draw_case(seed), Path(folder)) for seed in range(first, first + cases)]
    troubles = Counter(bool(one.trouble) for one in results)[True]
    page = f"""# Round trip: our motors as other people's logs

`python benchmarks/round_trip.py --cases {cases} --first {first}` (commit {commit()}; {machine()}).
{__doc__.splitlines()[0]}
Rates of 10 Hz to 1 kHz; speeds, positions, counts; 48 to 4096 counts a turn; values held for up to 4 rows, rows that
jitter, whole milliseconds, semicolons and decimal commas, duties with a battery in mV, positions that wrap. 28 s of the
profile `rich`, commanded at the rows. Only the counts of a turn are said, where a log counts. {troubles} logs
were refused.

| logs | number | named as they are | error of kv (median / 95 %) | error of ka | kv within 1 % and ka within 5 % |
|---|---|---|---|---|---|
{chr(10).join(rows(results))}

What did not come back within 1 % and 5 %:

{chr(10).join(failures(results)) or "nothing"}
"""
    (RESULTS / "round_trip.md").write_text(page, encoding="utf-8")
    print(page)


if __name__ == "__main__":
    main()
