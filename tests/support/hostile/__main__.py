"""Try hostile inputs of every kind from a process of its own, and print how each ended, a line of JSON each.

`python -m hostile 0.1 7` tries a tenth of the benchmark's, from seed 7 on; with `brief` those named ones that take a
second of a processor are left out.

What is forked from a process with threads, such as that of tests that ran before, may wait for ever for a lock.
"""

import json
import sys
import tempfile
from pathlib import Path

from hostile.inputs import KINDS
from hostile.named import CASES, DEAR
from hostile.trial import tried, warm_up

share, start, left_out = float(sys.argv[1]), int(sys.argv[2]), DEAR if "brief" in sys.argv else frozenset()
out = sys.stdout
warm_up()
for kind in KINDS:
    for trial in tried(kind, max(1, round(kind.share * share)), start):
        verdict = trial.verdict
        faults = [str(fault) for fault in verdict.faults]
        row = [kind.name, trial.number, list(trial.words), verdict.status, faults, repr(verdict)]
        print(json.dumps(row), file=out, flush=True)
for number, case in enumerate(CASES):
    if not case.large and case.name not in left_out:
        with tempfile.TemporaryDirectory() as outer:
            verdict = case.run(Path(outer) / "place")
        row = [f"named: {case.name}", number, case.words, verdict.status, list(verdict.faults), repr(verdict)]
        print(json.dumps(row), file=out, flush=True)
