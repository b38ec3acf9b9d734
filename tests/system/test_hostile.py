"""A fixed set of hostile inputs, each in a process of its own: benchmarks/hostile.py tries ten times as many."""

import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from domains import free_domain
from hostile.inputs import KINDS
from hostile.live import garbled_messages
from hostile.named import CASES, DEAR, LIVE
from tiers import keep_fast

ROOT = Path(__file__).resolve().parents[2]
SHARES = {"brief": 0.006, "whole": 0.035}  # of the benchmark's
SEED = 2
ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "NUMBA_NUM_THREADS": "1"}


def run_trials(extent: str) -> list[list[Any]]:
    """Of every input: kind, number, words, status, faults, and all that is known."""
    path = os.pathsep.join(part for part in sys.path if part)
    environment = os.environ | ONE_THREAD | {"PYTHONPATH": path, "ROS_DOMAIN_ID": str(free_domain())}
    command = [sys.executable, "-m", "hostile", str(SHARES[extent]), str(SEED), extent]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return [json.loads(line) for line in done.stdout.splitlines()]


@pytest.mark.long
@pytest.mark.timeout(600)
@pytest.mark.parametrize("extent", keep_fast(SHARES, "brief"))
def test_nothing_breaks_hangs_floods_or_runs(extent: str) -> None:
    """One to seven of every kind, and all that have a name but six; or three dozen of a kind, and all."""
    trials = run_trials(extent)
    assert [(kind, number, words, known) for kind, number, words, _, faults, known in trials if faults] == []
    assert len(trials) >= {"brief": 110, "whole": 250}[extent] and {trial[3] for trial in trials} <= {0, 1, 2, 130}
    left_out = DEAR if extent == "brief" else set()
    named = {f"named: {case.name}" for case in CASES if not case.large and case.name not in left_out}
    assert {trial[0] for trial in trials} == {kind.name for kind in KINDS} | named
    of_bags = [trial[3] for trial in trials if trial[0].startswith("MCAP file")]
    assert 0.4 < of_bags.count(0) / len(of_bags) < 0.8  # 0.3 where the bag that is changed is refused as it is


def test_every_input_has_one_name_and_each_that_needs_more_has_its_test() -> None:
    names = [case.name for case in CASES]
    assert len(set(names)) == len(names) >= 90 and not set(names) & set(LIVE) and set(names) > DEAR
    assert all((ROOT / test).is_file() for test in LIVE.values())


def test_a_named_input_that_ends_otherwise_is_a_fault(tmp_path: Path) -> None:
    """The sandbox and the cases can tell: the same refusal, with another status, other words or less time wanted."""
    (case,) = [case for case in CASES if case.name == "a model with kv of 10⁻³⁰⁰"]
    asked = (case, replace(case, status=0), replace(case, says="all is well"), replace(case, seconds=0.0))
    found = [one.run(tmp_path / str(k)).faults for k, one in enumerate(asked)]
    assert found == [(), ("status 1",), ("not said: all is well",), ("0 s",)]


def test_living_nodes_outlive_garbled_messages() -> None:
    os.environ["ROS_DOMAIN_ID"] = str(free_domain())
    assert garbled_messages(20, SEED).endswith("all lived on.")
