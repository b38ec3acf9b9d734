"""Counts of one channel, and those of a motor that never turns back: by a simulated motor of known direction."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from one_channel import EDGES, FINE, KV, ROW, TAU, counted, drive, turn

from motor_identification.bag import Source
from motor_identification.cli.import_log import main
from motor_identification.identify import Request
from motor_identification.logs.columns.said import Said
from motor_identification.logs.imported import import_log
from motor_identification.logs.rows.drive.one_channel import ALIKE, EITHER_WAY, FEWEST, find_ways, never_goes_back
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


@pytest.mark.parametrize("seed", range(4_360_000, 4_360_004))
def test_counts_that_never_go_back_under_a_voltage_of_either_way_are_told(seed: int) -> None:
    """White noise of the voltage moves a slow motor so little that its counts do not tell which way it turned."""
    rng = np.random.default_rng(seed)
    volts = rng.choice([-4.0, 4.0], 600)
    volts -= np.mean(volts)
    turned = counted(volts, turn(volts))
    assert never_goes_back(turned) and not never_goes_back(counted(volts, turn(volts), both=True))
    down = replace(turned, motion=-turned.motion)
    assert never_goes_back(down)
    for mean, told in ((0.8 * ALIKE, True), (1.3 * ALIKE, False)):  # a mean of its own: it may have gone on one way
        assert never_goes_back(replace(turned, voltage=volts + 4.0 * mean)) is told
    braked = np.where(rng.permutation(600) < 150, 6.0, -2.0)  # which goes less than half as far
    assert not never_goes_back(replace(turned, voltage=braked - np.mean(braked)))


def test_a_log_says_that_its_counts_never_go_back(tmp_path: Path) -> None:
    rng = np.random.default_rng(4_360_010)
    volts = np.round(rng.uniform(-4.0, 4.0, 800), 3)
    count = np.cumsum(rng.integers(0, 3, 800))
    for sign, said in ((1, True), (np.where(np.arange(800) < 700, 1, -1), False)):
        rows = [f"{k / 100},{volts[k]},{one}" for k, one in enumerate(np.cumsum(np.diff(count, prepend=0) * sign))]
        path = tmp_path / f"log{said}.csv"
        path.write_text("\n".join(["t,voltage,count", *rows]))
        (motor,) = import_log(path, Said(edges_per_revolution=48)).motors
        assert any("count never goes back while the voltage" in one for one in motor.log.findings) is said
