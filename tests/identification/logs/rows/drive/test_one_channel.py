"""Counts of one channel, and those of a motor that never turns back: by a simulated motor of known direction."""

from pathlib import Path

import numpy as np
import pytest
from one_channel import EDGES, FINE, KV, ROW, TAU, counted, drive, turn

from motor_identification.bag import Source
from motor_identification.cli.import_log import main
from motor_identification.identify import Request
from motor_identification.logs.columns.said import Said
from motor_identification.logs.imported import import_log
from motor_identification.logs.rows.drive.one_channel import EITHER_WAY, FEWEST, find_ways
from motor_identification.service.job import Job, run_job


@pytest.mark.parametrize("ks", [0.0, 0.5])
def test_one_channel_turns_as_it_is_driven(ks: float) -> None:
    volts = drive(600)
    speeds = turn(volts, ks)
    signals = counted(volts, speeds)
    ways = find_ways(signals)
    assert ways is not None
    right = ways[1:] == np.sign(np.add.reduceat(speeds, np.arange(0, len(speeds), FINE))[:-1])
    steps = np.diff(signals.motion)
    assert float(np.sum(steps[right])) > 0.97 * float(np.sum(steps))
    assert find_ways(counted(volts, speeds, both=True)) is None  # which fall, too


@pytest.mark.parametrize(
    ("low", "high", "ks", "load"),
    [(-1.0, 4.0, 0.0, -6.0), (-4.0, 6.0, 4.5, 0.0), (0.5, 4.0, 0.0, 0.0)],
)
def test_a_motor_that_never_turns_back_has_a_direction(low: float, high: float, ks: float, load: float) -> None:
    """A load drives it on, friction holds it, or no voltage drives it back."""
    volts = drive(600, low, high)
    speeds = turn(volts, ks, load)
    assert np.min(speeds) >= 0.0 and np.any(speeds > 0.0)
    assert find_ways(counted(volts, speeds)) is None


def test_a_brake_for_a_negative_voltage_is_no_way_back() -> None:
    volts = drive(600)
    assert find_ways(counted(volts, turn(np.maximum(volts, 0.0)))) is None


@pytest.mark.parametrize(("rows", "told"), [(FEWEST - 1, False), (240, True)])
def test_a_few_rows_tell_nothing(rows: int, told: bool) -> None:
    volts = drive(rows)
    assert (find_ways(counted(volts, turn(volts))) is not None) is told


@pytest.mark.parametrize(("share", "told"), [(0.4 * EITHER_WAY, False), (3.0 * EITHER_WAY, True)])
def test_a_motor_that_hardly_turns_back_is_taken_as_it_is(share: float, told: bool) -> None:
    volts = np.where(np.arange(1200) % 600 < 600 * share, -4.0, np.where(np.arange(1200) % 200 < 100, 4.0, 1.0))
    assert (find_ways(counted(volts, turn(volts))) is not None) is told


def test_import_gives_counts_of_one_channel_their_way_and_a_fit_finds_the_motor(tmp_path: Path) -> None:
    volts = drive(900, -3.0)
    signals = counted(volts, turn(volts))
    lines = [f"{k * ROW:.2f},{u:g},{c:.0f}" for k, (u, c) in enumerate(zip(volts, signals.motion, strict=True))]
    path = tmp_path / "log.csv"
    path.write_text("\n".join(["t [s],u [V],count", *lines]) + "\n")
    (motor,) = import_log(path, Said(edges_per_revolution=EDGES)).motors
    assert motor.log.info.single_channel
    assert any(line.startswith("Caution: count only rises while the voltage changes") for line in motor.log.findings)
    assert any(", both ways;" in line for line in motor.log.findings)
    assert main([str(path), "--output", str(tmp_path / "bag"), "--edges-per-revolution", str(EDGES)]) == 0
    fit = run_job(Job(Source((str(tmp_path / "bag"),)), Request(effects=())))
    assert fit.parameters.values["kv"] == pytest.approx(KV, rel=0.02)
    assert fit.parameters.values["ka"] == pytest.approx(KV * TAU, rel=0.04)
