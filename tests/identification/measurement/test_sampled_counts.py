"""Where a disc was, from counts without stamps: every sample of a fast one, every change of a slow one."""

from dataclasses import replace
from math import sqrt

import numpy as np
import pytest
from handmade import PERIOD, turning
from plant import profiles, record
from recorded import as_counts

from motor_identification.measurement.sampled_counts import (
    UNIFORM_SIGMA,
    estimate_stamp_jitter,
    extract_count_changes,
    locate_fixes,
    measure_rounding,
    number_runs,
    part_returns,
)
from motor_identification.recording import Floats
from motor_identification.sensor.parabola_scatter import WINDOW
from motor_model.parameters import PAPER_KA, PAPER_KV
from motor_model.sample import Measurement


def fixes_at(rate: float, duration: float = 1.0):  # type: ignore[no-untyped-def]
    """Fixes of a disc that turns evenly, so many slots a sample."""

    def slots(time: Floats) -> Floats:
        return rate / PERIOD * time + 0.3

    recording = turning(slots, duration, Measurement.COUNTS)
    return recording, locate_fixes(recording, extract_count_changes(recording)), slots


@pytest.mark.parametrize("rate", [0.13, 0.37, 0.81, 1.3, 3.7, 10.87])
def test_every_fix_is_where_the_disc_was_within_its_blur(rate: float) -> None:
    _, fixes, slots = fixes_at(rate)
    inner = slice(1, -1)
    error = (fixes.place - slots(fixes.time))[inner]
    assert np.abs(error - error.mean()).max() < 2.0 * sqrt(3.0) * fixes.blur[inner].max()
    assert abs(error.mean()) < 0.1  # and none of it is systematic
    assert 0.3 < np.std(error) / np.median(fixes.blur[inner]) < 1.5


@pytest.mark.parametrize(("rate", "blur"), [(0.2, 0.2), (0.5, 0.5), (0.95, 1.0), (1.05, 1.0), (4.0, 1.0)])
def test_slow_changes_are_sharp_and_fast_samples_are_one_slot(rate: float, blur: float) -> None:
    recording, fixes, _ = fixes_at(rate)
    assert np.median(fixes.blur) == pytest.approx(blur * UNIFORM_SIGMA, rel=0.06)
    if rate > 1.0:
        assert len(fixes) > 0.95 * len(recording)
    else:
        assert len(fixes) == pytest.approx(rate * len(recording), rel=0.1)


@pytest.mark.parametrize("jitter", [0.0, 0.0005])
def test_stamps_that_jitter_blur_every_fix_of_a_fast_motor(jitter: float) -> None:
    recording, fixes, slots = fixes_at(8.87, 3.0)
    assert estimate_stamp_jitter(fixes) == 0.0
    late = recording.time + np.random.default_rng(0).normal(0.0, jitter, len(recording))
    shaken = replace(recording, edge_count=np.floor(slots(late)).astype(np.int64))
    found = locate_fixes(shaken, extract_count_changes(shaken))
    expected = np.hypot(UNIFORM_SIGMA, jitter * 8.87 / PERIOD)
    assert np.median(found.blur) == pytest.approx(expected, rel=0.3)
    assert estimate_stamp_jitter(found) == 0.0  # once it is in the blur, none is left


@pytest.mark.parametrize("standing", [0.0, 0.4])
def test_a_motor_that_stands_most_of_the_time_does_not_bound_the_jitter_of_its_motion(standing: float) -> None:
    """Rows of 1 ms under even stamps were off by 0.06 ms, and a real floor of 32 rad/s was said to be 5."""
    recording, _, slots = fixes_at(40.0, 10.0)
    jitter, turns = 0.06 * PERIOD, 1.0 - standing
    late = recording.time + np.random.default_rng(0).normal(0.0, jitter, len(recording))
    shaken = replace(recording, edge_count=np.floor(slots(np.clip(late, 0.0, 10.0 * turns))).astype(np.int64))
    found = locate_fixes(shaken, extract_count_changes(shaken))
    moving = found.time < 9.9 * turns
    assert np.median(found.blur[moving]) == pytest.approx(np.hypot(UNIFORM_SIGMA, 0.06 * 40.0), rel=0.1)


@pytest.mark.parametrize("tick", [0, 100_000])
def test_stamps_of_a_loop_that_jitters_are_as_uncertain_as_its_clocks_tick(tick: int) -> None:
    """A millisecond's tenth of rows of 5 ms: counts of even rows would bound the jitter far below it."""
    recording, _, slots = fixes_at(80.0, 3.0)
    true = np.cumsum(np.round(PERIOD * 1e9 * (1.0 + 0.01 * np.random.default_rng(1).standard_normal(len(recording)))))
    stamps = np.round(true / max(tick, 1)) * max(tick, 1)
    loop = replace(
        recording,
        sample_time=(stamps - stamps[0]).astype(np.int64),
        edge_count=np.floor(slots((true - true[0]) * 1e-9)).astype(np.int64),
    )
    assert measure_rounding(loop) == pytest.approx(max(tick, 1) * 1e-9 / np.sqrt(12.0))
    kept = np.delete(np.arange(len(recording)), [50, 51, 90])
    assert measure_rounding(recording) == measure_rounding(recording.at_rows(kept)) == 0.0  # rows alike, some missing
    blur = np.hypot(UNIFORM_SIGMA, tick * 1e-9 / np.sqrt(12.0) * 80.0 / PERIOD)
    assert np.median(locate_fixes(loop, extract_count_changes(loop)).blur) == pytest.approx(blur, rel=0.1)


LEVEL, LEVELS, LAG = 0.36, 14, 0.084  # [s] and stairs of a motor that answers within two rows


def stairs(jitter: float, seed: int):  # type: ignore[no-untyped-def]
    """Counts of a motor on stairs in uneven rows of 50 ms, whose stamps are off by chance by so much [s]."""
    random = np.random.default_rng(seed)
    shape = turning(lambda time: 1e-6 * time, LEVEL * LEVELS, Measurement.COUNTS)
    rows = np.arange(0.0, LEVEL * LEVELS, 0.05)
    read = rows + np.append(0.0, random.normal(0.0, 0.003, len(rows) - 1))
    since = np.maximum(read[:, None] - LEVEL * np.arange(LEVELS), 0.0)
    slots = 4000.0 * np.sum(since - LAG * (1.0 - np.exp(-since / LAG)), axis=1)
    stamp = np.round((read + random.normal(0.0, jitter, len(read))) * 1e9).astype(np.int64)
    begun = shape.at_rows(np.arange(len(read)))
    return replace(begun, sample_time=stamp - stamp[0], edge_count=np.floor(slots).astype(np.int64))


@pytest.mark.parametrize("seed", range(4))
def test_what_a_motor_does_within_few_uneven_rows_is_no_jitter_of_their_stamps(seed: int) -> None:
    """Exact stamps were said to be off by 0.76 ms, which hid a friction and an inductance beside a dead time."""
    recording = stairs(0.0, seed)
    found = locate_fixes(recording, extract_count_changes(recording))
    told = estimate_stamp_jitter(replace(found, blur=np.full(len(found), UNIFORM_SIGMA)))
    assert told > 4e-4
    assert np.median(found.blur / found.rate) < 0.3 * told


def test_stamps_that_jitter_do_so_in_uneven_rows_too() -> None:
    shares = []
    for seed in range(8):
        recording = stairs(0.002, seed)
        found = locate_fixes(recording, extract_count_changes(recording))
        fast = found.rate > np.median(found.rate)
        shares.append(np.median((found.blur / found.rate)[fast]) / 0.002)
    assert np.median(shares) == pytest.approx(1.0, abs=0.25) and min(shares) > 0.6


def test_a_dozen_fixes_tell_no_jitter() -> None:
    _, fixes, _ = fixes_at(9.0, (2 * WINDOW - 4) * PERIOD)
    assert len(fixes) < 2 * WINDOW and estimate_stamp_jitter(fixes) == 0.0


def test_a_disc_that_does_not_turn_has_no_fixes() -> None:
    recording = turning(lambda time: 1e-6 * time, 0.5, Measurement.COUNTS)
    assert len(extract_count_changes(recording)) == 0
    assert len(locate_fixes(recording, extract_count_changes(recording))) == 0


def test_the_first_change_after_a_turn_stands_alone() -> None:
    """A second channel may take the last one back there, half a slot from the next; between others nothing changes."""
    way = np.array([1, 1, 1, -1, -1, -1, 1, 1])
    changes = part_returns(number_runs(np.arange(8), way))
    assert changes.run.tolist() == [0, 0, 0, 1, 2, 2, 3, 4]
    straight = number_runs(np.arange(3), np.array([1, 1, 1]))
    assert part_returns(straight).run.tolist() == [0, 0, 0]
    rocking = part_returns(number_runs(np.arange(4), np.array([1, -1, 1, -1])))
    assert rocking.run.tolist() == [0, 1, 2, 3]


def test_a_motor_that_follows_a_jumping_voltage_shows_no_jitter() -> None:
    """Its motion within seven samples is no parabola; samples and voltages before foresee it all the same."""
    drive = profiles.pieces(np.random.default_rng(0).uniform(-6.0, 6.0, 500), np.full(500, 0.02))
    recording, _ = record({"kv": PAPER_KV, "ka": PAPER_KA}, *drive, sample_rate=50.0, edges=960, single_channel=False)
    sampled = as_counts(recording)
    fixes = locate_fixes(sampled, extract_count_changes(sampled))
    assert estimate_stamp_jitter(replace(fixes, blur=np.full(len(fixes), UNIFORM_SIGMA))) > 1e-3
    assert np.median(fixes.blur) == pytest.approx(UNIFORM_SIGMA, rel=0.2)
