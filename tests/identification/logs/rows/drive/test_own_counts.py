"""A speed loop on its own counts is recognised, through filters and means, and what its rows counted is exact."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import lfilter

from motor_identification.estimation.request import Request
from motor_identification.identify import identify
from motor_identification.logs.columns.said import Said
from motor_identification.logs.imported import import_log
from motor_identification.logs.rows.drive.own_counts import (
    FEWEST,
    FEWEST_ROWS,
    MOST_LOST,
    SHARE,
    _explain,
    find_pole,
    take_fed_back,
)
from motor_identification.logs.signals import Floats, Signals
from motor_identification.recording import check, recording_of

ROW, SLOT, LIMIT, KV, TAU, KS = 0.004, 2.0 * np.pi / 22, 12.0, 0.1, 0.11, 0.84
ONE = SLOT / ROW  # [rad/s] a count of a row
Filter = Callable[[Floats], Floats]


def passes(values: Floats) -> Floats:
    return values


def forgets(values: Floats) -> Floats:
    return np.asarray(lfilter([0.3], [1.0, -0.7], values))


def averages(values: Floats) -> Floats:
    return np.asarray(lfilter(np.full(4, 0.25), [1.0], values))


def taught(values: Floats) -> Floats:
    """By the bilinear transform, as a tutorial that many follow does."""
    return np.asarray(lfilter([0.0728, 0.0728], [1.0, -0.8544], values))


@dataclass(frozen=True)
class Loop:
    """A PI loop (kp = 2.2 kv) at 250 Hz, a quarter of a count a row and more; arrays of shape (K,)."""

    time: Floats
    voltage: Floats
    speed: Floats
    counts: Floats

    def signals(self) -> Signals:
        count = len(self.time)
        lines, unknown = np.arange(count), np.full(count, np.nan)
        time = np.rint(self.time * 1e9).astype(np.int64)
        return Signals(Path("log.csv"), lines, time, self.voltage, self.speed, unknown, unknown, {"": slice(0, count)})


def run(filtered: Filter = passes, jitter: float = 0.0, closed: bool = True, rows: int = 1500) -> Loop:
    random, angle, speed, integral, inner = np.random.default_rng(3), 0.1, 0.0, 0.0, 10
    levels = np.array([48.0, 24.0, 71.0, -36.0, 60.0])
    time, volts, made, counts = np.zeros(rows), np.zeros(rows), np.zeros(rows), np.zeros(rows)
    length, before = ROW, 0.0
    for k in range(rows):
        counts[k] = np.floor(angle / SLOT)
        made[k] = (counts[k] - before) * SLOT / length
        shown = filtered(made[max(k - 200, 0) : k + 1])[-1]
        wanted, before = levels[k * len(levels) // rows], counts[k]
        error = wanted - (shown if closed else speed)
        integral += 0.9 * error * ROW
        volts[k] = np.clip(2.2 * KV * error + integral, -LIMIT, LIMIT) if closed else 0.15 * wanted
        length = ROW * (1.0 + jitter * random.uniform(-1.0, 1.0))
        if k + 1 < rows:
            time[k + 1] = time[k] + length
        for _ in range(inner):
            free = (volts[k] / KV - speed) / TAU
            held = KS / KV / TAU
            stands = speed == 0.0 and abs(free) <= held
            new = speed if stands else speed + (free - held * np.sign(speed or free)) * length / inner
            new = 0.0 if speed * new < 0.0 else new
            angle += 0.5 * (speed + new) * length / inner
            speed = new
    return Loop(time, volts, filtered(made), counts)


def write(loop: Loop, folder: Path) -> Path:
    log = folder / "log.csv"
    columns = zip(loop.time, loop.voltage, loop.speed, strict=True)
    rows = "\n".join(f"{time:.4f},{volts:.4f},{speed:.5f}" for time, volts, speed in columns)
    log.write_text(f"time [s],voltage [V],speed [rad/s]\n{rows}\n")
    return log


@pytest.mark.parametrize(
    ("filtered", "jitter"),
    [(passes, 0.0), (forgets, 0.0), (averages, 0.0), (taught, 0.0), (passes, 0.02), (forgets, 0.02)],
)
def test_what_single_rows_counted_is_taken_exactly(filtered: Filter, jitter: float) -> None:
    loop = run(filtered, jitter)
    digits = replace(loop, speed=np.round(loop.speed, 4))
    taken = take_fed_back(digits.signals(), ROW)
    assert taken is not None
    signals, one = taken
    assert one == pytest.approx(ONE, rel=1e-3)
    assert np.array_equal(np.cumsum(np.rint(signals.motion / one)), loop.counts)


def part(loop: Loop, rows: slice) -> Loop:
    return Loop(loop.time[rows], loop.voltage[rows], loop.speed[rows], loop.counts[rows])


@pytest.mark.parametrize("rows", [slice(0, 300), slice(0, 600), slice(333, 1500)])
def test_short_logs_and_those_that_begin_in_motion_are_as_exact(rows: slice) -> None:
    """By chance, a mean of 29 to 32 rows fits single counts of so few."""
    for filtered in (passes, forgets):
        loop = part(run(filtered), rows)
        taken = take_fed_back(loop.signals(), ROW)
        assert taken is not None and taken[1] == pytest.approx(ONE, rel=1e-3)
        counted = np.rint(taken[0].motion / taken[1])
        assert np.array_equal(counted[5:], np.diff(loop.counts, prepend=0.0)[5:])


def test_an_encoder_the_other_way_round_is_counted_as_it_is() -> None:
    loop = run()
    taken = take_fed_back(replace(loop, speed=-loop.speed).signals(), ROW)
    assert taken is not None and np.array_equal(np.cumsum(np.rint(taken[0].motion / taken[1])), -loop.counts)


@pytest.mark.parametrize(("share", "summed"), [(0.5, True), (2.0, False)])
def test_rows_that_are_missing_are_missing_in_a_sum(share: float, summed: bool) -> None:
    loop = run()
    lost = np.linspace(100, 1400, round(share * MOST_LOST * len(loop.time))).astype(int)
    kept = np.delete(np.arange(len(loop.time)), lost)
    some = Loop(loop.time[kept], loop.voltage[kept], loop.speed[kept], loop.counts[kept])
    assert (take_fed_back(some.signals(), ROW) is not None) is summed


@pytest.mark.parametrize("counts_a_row", [0.4, 0.8])
def test_ramps_that_a_quick_motor_follows_are_no_loop(counts_a_row: float) -> None:
    """Its speed changes by as much in every row, either way, as its command does; only the rounding of a row tells."""
    rows, a_row = 1500, 0.08
    ramp = a_row * (50.0 - np.abs(np.arange(rows) % 200 - 100.0))
    speed = lfilter([0.25], [1.0, -0.75], ramp * counts_a_row * ONE / a_row)
    counts = np.floor(np.cumsum(speed) * ROW / SLOT)
    loop = Loop(ROW * np.arange(rows), ramp, np.diff(counts, prepend=0.0) * ONE, counts)
    assert _explain(np.diff(loop.voltage), np.diff(loop.speed))  # as they are they seem to be one
    assert take_fed_back(loop.signals(), ROW) is None


def test_a_run_of_few_rows_does_not_tell() -> None:
    loop = run()
    signals = loop.signals()
    few, many = FEWEST_ROWS - 2, len(loop.time)
    assert take_fed_back(replace(signals, runs={"1": slice(0, many - few), "2": slice(many - few, many)}), ROW)
    open_loop = run(closed=False)
    half = slice(many // 2, many)
    mixed = replace(loop, voltage=np.where(np.arange(many) < many // 2, loop.voltage, open_loop.voltage))
    assert take_fed_back(replace(mixed.signals(), runs={"1": slice(0, many // 2), "2": half}), ROW) is None


def test_nothing_is_taken_of_a_command_that_does_not_answer() -> None:
    assert take_fed_back(run(closed=False).signals(), ROW) is None
    loop = run()
    random = np.random.default_rng(1)
    swept = replace(loop, voltage=random.uniform(-LIMIT, LIMIT, len(loop.voltage)))  # changes in every row
    assert take_fed_back(swept.signals(), ROW) is None
    noisy = replace(loop, speed=loop.speed + random.normal(0.0, 0.3 * ONE, len(loop.speed)))  # no counts
    noisy = replace(noisy, voltage=-0.22 * noisy.speed)
    assert take_fed_back(noisy.signals(), ROW) is None
    anywhere = ONE * random.integers(0, 20, len(loop.time)).astype(float)  # as of a mean that was taken apart wrongly
    assert take_fed_back(replace(loop, speed=anywhere, voltage=-0.22 * anywhere).signals(), ROW) is None
    short = loop.signals().only(np.arange(len(loop.time)) < FEWEST_ROWS)
    assert take_fed_back(short, ROW) is None


def test_a_pole_is_a_ratio_that_comes_again_and_again() -> None:
    chance = np.random.default_rng(2).uniform(-2.0, 2.0, 1000)
    assert find_pole(chance) == 0.0
    many = np.append(chance, np.full(round(1.1 * SHARE * 1000 / (1.0 - SHARE)), 0.7))
    assert find_pole(many) == pytest.approx(0.7, abs=1e-3)
    assert find_pole(np.full(FEWEST - 1, 0.7)) == 0.0 and find_pole(np.full(FEWEST, 0.7)) == 0.7
    assert find_pole(np.ones(1000)) == 0.0 and find_pole(np.zeros(0)) == 0.0


@pytest.mark.parametrize(("edges", "summed"), [(22, True), (44, False)])
def test_counts_of_another_encoder_than_was_said_are_not_summed_up(edges: int, summed: bool, tmp_path: Path) -> None:
    log = write(run(), tmp_path)
    (motor,) = import_log(log, Said(edges_per_revolution=edges)).motors
    assert any("a speed loop on them" in said for said in motor.log.findings) is summed


@pytest.mark.parametrize("filtered", [passes, forgets])
def test_a_motor_behind_its_own_counts_is_the_motor(filtered: Filter, tmp_path: Path) -> None:
    """As speeds its inertia came to 1 % of the true one, or to 900 times it."""
    loop = run(filtered, rows=4000)
    log = write(loop, tmp_path)
    (motor,) = import_log(log, Said()).motors
    assert any("a speed loop on them" in said for said in motor.log.findings)
    runs = [check(recording_of(one.samples, motor.log.info, one.label)) for one in motor.log.runs]
    found = identify(runs, request=Request(effects=("coulomb_friction",))).parameters
    assert found.value("kv") == pytest.approx(KV, rel=2e-3)
    assert found.value("ka") == pytest.approx(KV * TAU, rel=0.02)
    assert found.value("ks") == pytest.approx(KS, rel=0.02)
