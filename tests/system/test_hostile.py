"""A fixed set of hostile inputs, each in a process of its own: benchmarks/hostile.py tries ten times as many."""

import os

import pytest
from domains import free_domain
from hostile.inputs import KINDS, Kind
from hostile.live import garbled_messages
from hostile.trial import tried, warm_up

SHARE = 0.09  # of the benchmark's
SEED = 2


@pytest.fixture(scope="module", autouse=True)
def warm() -> None:
    os.environ["ROS_DOMAIN_ID"] = str(free_domain())
    warm_up()


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.name)
def test_nothing_breaks_hangs_floods_or_runs(kind: Kind) -> None:
    trials = list(tried(kind, round(kind.share * SHARE), SEED))
    assert [(trial.number, trial.words, trial.verdict) for trial in trials if trial.verdict.faults] == []
    assert len(trials) >= 3 and {trial.verdict.status for trial in trials} <= {0, 1, 2, 130}


def test_at_least_three_hundred_are_tried() -> None:
    assert sum(round(kind.share * SHARE) for kind in KINDS) >= 300


def test_living_nodes_outlive_garbled_messages() -> None:
    assert garbled_messages(20, SEED).endswith("both lived on.")
