"""Five thousand hostile inputs over commands, nodes and kinds of files, each in a process of its own under limits.

Bags, databases, YAML, workbooks and CSV are real ones that were changed by their grammar (`tests/support/hostile`);
messages to living nodes are garbled; what once did harm has a row with a name, and how it has to end. Wanted: no
traceback, no internal error, no hang, not more than 2 GiB, no file outside of the output, no code run. `--share 0.1`
tries a tenth, `--seed` others. `--kind NAME` tries one kind and writes no page.
"""

import argparse
import os
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from machine import commit, machine

sys.path[0] = str(Path(__file__).resolve().parents[1] / "tests" / "support")  # not beside control.py: tune imports one
os.environ.setdefault("ROS_DOMAIN_ID", "99")

from hostile.inputs import KINDS
from hostile.kind import Kind
from hostile.live import garbled_messages
from hostile.named import CASES, LIVE, Case
from hostile.sandbox import MEMORY, PATIENCE
from hostile.trial import Trial, tried, warm_up

RESULTS = Path(__file__).with_name("results")
FAULTS = ("traceback", "internal error", "hang", "memory", "files", "code", "other")


def row(kind: Kind, count: int, seed: int) -> tuple[str, int, list[Trial]]:
    """A line of the table, the number of inputs, and those that did harm."""
    began = time.monotonic()
    trials = list(tried(kind, count, seed))
    bad = [trial for trial in trials if trial.verdict.faults]
    faults = Counter(fault if fault in FAULTS else "other" for trial in bad for fault in trial.verdict.faults)
    statuses = Counter(trial.verdict.status for trial in trials)
    longest = max(trial.verdict.seconds for trial in trials)
    most = max(trial.verdict.megabytes for trial in trials)
    cells = [
        kind.name,
        str(len(trials)),
        *(str(statuses[number]) for number in (0, 1, 2)),
        *(str(faults[fault]) for fault in FAULTS),
        f"{longest:.1f}",
        f"{most:.0f}",
    ]
    line = f"| {' | '.join(cells)} |"
    print(f"{line} {time.monotonic() - began:.0f} s", flush=True)
    for trial in bad:
        print(f"  {trial.number} {trial.words} {trial.verdict}", flush=True)
    return line, len(trials), bad


def named_row(case: Case) -> tuple[str, bool]:
    """A line of the table of inputs with a name, and whether it did no harm and ended as it has to."""
    with tempfile.TemporaryDirectory() as outer:
        verdict = case.run(Path(outer) / "place")
    how = ", ".join(verdict.faults) or "as it has to"
    says = f"`{case.says}`" if case.says else ""
    cells = [case.name, str(verdict.status), says, f"{verdict.busy:.1f}", f"{verdict.megabytes:.0f}", how]
    line = f"| {' | '.join(cell.replace('|', 'or') for cell in cells)} |"
    if verdict.faults:
        print(line, verdict, flush=True)
    return line, not verdict.faults


def page(lines: list[str], named: list[str], total: int, bad: int, seed: int, live: str, begun: str) -> str:
    return "\n".join(
        [
            "# Hostile inputs",
            "",
            f"{total:,} inputs, each in a process of its own with {MEMORY >> 30} GiB and {PATIENCE:.0f} s; "
            f"seed {seed}, commit {begun}. {bad} did harm. {machine()}.",
            "",
            "Statuses: 0 done, 1 one sentence, 2 usage. `other`: a status that is none of these, or a flood of words.",
            "",
            f"| kind of input | inputs | 0 | 1 | 2 | {' | '.join(FAULTS)} | longest [s] | most memory [MB] |",
            f"|---|{'---:|' * (6 + len(FAULTS))}",
            *lines,
            "",
            live,
            "",
            "## Inputs with a name",
            "",
            "What once broke, hung, flooded or commanded the workbench, and more like it. It ends with this status and "
            "these words among others, within 20 s of a processor; nothing it says has a control character.",
            "",
            "| input | status | says | busy [s] | most memory [MB] | ended |",
            "|---|---:|---|---:|---:|---|",
            *named,
            "",
            "What needs living nodes, a full disk or another network namespace is in these tests:",
            "",
            "| input | test |",
            "|---|---|",
            *(f"| {name.replace('|', 'or')} | `{test}` |" for name, test in LIVE.items()),
            "",
        ]
    )


def main() -> int:
    """Write results/hostile.md."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--share", type=float, default=1.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kind", default="")
    options = parser.parse_args()
    begun = commit()  # before the first input, for the run takes a quarter of an hour
    warm_up()
    lines, total, harm = [], 0, 0
    for kind in KINDS:
        if options.kind in kind.name:
            line, count, bad = row(kind, max(round(kind.share * options.share), 1), options.seed)
            lines, total, harm = [*lines, line], total + count, harm + len(bad)
    if options.kind:
        return int(harm > 0)
    named = [named_row(case) for case in CASES]
    total, harm = total + len(named), harm + sum(not sound for _, sound in named)
    live = garbled_messages(max(round(200 * options.share), 20), options.seed)
    print(live)
    (RESULTS / "hostile.md").write_text(
        page(lines, [line for line, _ in named], total, harm, options.seed, live, begun), encoding="utf-8"
    )
    return int(harm > 0)


if __name__ == "__main__":
    sys.exit(main())
