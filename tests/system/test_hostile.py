"""A fixed set of hostile inputs, each in a process of its own: benchmarks/hostile.py tries ten times as many."""

import json
import os
import subprocess
import sys
from typing import Any

import pytest
from domains import free_domain
from hostile.inputs import KINDS
from hostile.live import garbled_messages

SHARE = 0.07  # of the benchmark's
SEED = 2
ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "NUMBA_NUM_THREADS": "1"}


def run_trials() -> list[list[Any]]:
    """Of every input: kind, number, words, status, faults, and all that is known."""
    path = os.pathsep.join(part for part in sys.path if part)
    environment = os.environ | ONE_THREAD | {"PYTHONPATH": path, "ROS_DOMAIN_ID": str(free_domain())}
    command = [sys.executable, "-m", "hostile", str(SHARE), str(SEED)]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return [json.loads(line) for line in done.stdout.splitlines()]


@pytest.mark.long
@pytest.mark.timeout(600)
def test_nothing_breaks_hangs_floods_or_runs() -> None:
    trials = run_trials()
    assert [(kind, number, words, known) for kind, number, words, _, faults, known in trials if faults] == []
    assert len(trials) >= 300 and {trial[3] for trial in trials} <= {0, 1, 2, 130}
    assert {trial[0] for trial in trials} == {kind.name for kind in KINDS}
    of_bags = [trial[3] for trial in trials if trial[0].startswith("MCAP file")]
    assert 0.45 < of_bags.count(0) / len(of_bags) < 0.8  # 0.3 where the bag that is changed is refused as it is


def test_living_nodes_outlive_garbled_messages() -> None:
    os.environ["ROS_DOMAIN_ID"] = str(free_domain())
    assert garbled_messages(20, SEED).endswith("all lived on.")
