"""Wrong numbers inside recordings: jumping counts, mistaken units, stamps that cannot be; refused, or left out."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from plant import profiles, record
from recorded import as_counts
from tiers import keep_fast

from motor_identification.identify import Request, SearchConfig, identify
from motor_identification.measurement.build_intervals import make_intervals
from motor_identification.measurement.edges import extract_edges
from motor_identification.measurement.sanity_checks import (
    compare_motion_with_voltage,
    compare_speed_with_count,
    find_count_jump,
    find_undriven,
)
from motor_identification.recording import Recording, check
from motor_model.errors import RecordingError
from motor_model.parameters import PAPER_KA, PAPER_KV

TRUTH = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.5}
Spoil = Callable[[Recording], Recording]


@pytest.mark.parametrize(
    ("share", "coasting", "found"),
    [(0.5, np.inf, True), (0.11, np.inf, True), (0.09, np.inf, False), (0.5, 4.0, False)],
)
def test_a_motor_that_keeps_its_speed_at_0_volts_is_not_driven_by_what_was_logged(
    share: float, coasting: float, found: bool
) -> None:
    """For a tenth of the recording; one that was switched off becomes slower in that time."""
    recording, _ = record(TRUTH, *profiles.step(10.0, 8.0), seed=0)
    before = recording.time < share * recording.duration
    speed = np.where(before, 60.0 * np.exp(-recording.time / (coasting * share * recording.duration)), 80.0)
    one = replace(recording, voltage=np.where(before, 0.0, 5.0), speed=speed)
    undriven = find_undriven([replace(one, voltage=np.full(len(one), 5.0)), one])
    assert (undriven is not None) is found
    if undriven is not None:
        assert undriven.speed == pytest.approx(60.0)
        assert undriven.duration == pytest.approx(share * one.duration, abs=2.0 * one.sample_period)


def test_no_motion_of_a_motor_is_a_jump() -> None:
    for seed in range(3):
        for drive in (profiles.random(12.0, 3.0, seed=seed), profiles.reversals(12.0, 6, 0.2), profiles.step(12.0)):
            for edges in (24, 500):
                recording, _ = record(TRUTH, *drive, seed=seed, edges=edges, single_channel=False)
                assert find_count_jump(recording.time, recording.edge_count, recording.voltage) is None
                assert 0.9 < (compare_speed_with_count(recording) or 1.0) < 1.1


def test_a_flank_crossed_again_and_again_is_no_speed() -> None:
    """A shaft of two channels that trembles on a flank between two moves; with one channel each change is a slot."""
    recording, _ = record(TRUTH, *profiles.step(12.0), edges=24, single_channel=False)
    ends = np.arange(len(recording)) >= len(recording) // 5
    trembling = np.where(ends, np.arange(len(recording)) % 2, 0)
    held = np.where(ends, recording.edge_count[len(recording) // 5], recording.edge_count)
    still = replace(recording, edge_count=held + trembling, speed=np.where(ends, 0.0, recording.speed))
    ratio = compare_speed_with_count(still)
    assert ratio is None or 0.8 < ratio < 1.2
    single = replace(still, info=replace(still.info, single_channel=True))
    assert (compare_speed_with_count(single) or 0.0) < 0.1


COUNTS = {
    "wraps at a byte": lambda r: replace(r, edge_count=r.edge_count % 256),
    "wraps after a turn": lambda r: replace(r, edge_count=r.edge_count % 96),
    "is reset": lambda r: replace(r, edge_count=np.where(r.time > 0.7, r.edge_count - r.edge_count[140], r.edge_count)),
    "is misread once": lambda r: replace(r, edge_count=r.edge_count + 5000 * (np.arange(len(r)) == 100)),
}


@pytest.mark.parametrize("case", COUNTS)
def test_a_count_that_wraps_or_is_reset_is_refused_with_its_time(case: str) -> None:
    recording, _ = record(TRUTH, *profiles.step(10.0, 1.0), seed=0, single_channel=False)
    make_intervals(check(as_counts(recording)))
    with pytest.raises(
        RecordingError, match=r"edge_count jumps from -?\d+ to -?\d+ at 0\.\d+ s: the counter wrapped"
    ) as caught:
        identify([check(as_counts(COUNTS[case](recording)))], Request())
    assert str(caught.value).endswith(".") and "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("factor", "said"), [(180 / np.pi, r"57\.\d ×"), (60 / (2 * np.pi), r"9\.5\d ×"), (np.pi / 180, r"1/5\d")]
)
@pytest.mark.parametrize("counts", [False, True])
def test_a_speed_in_another_unit_than_the_counts_is_refused(factor: float, said: str, counts: bool) -> None:
    recording, _ = record(TRUTH, *profiles.random(12.0, 3.0), seed=0, single_channel=False)
    wrong = replace(recording, speed=recording.speed * factor)
    with pytest.raises(RecordingError, match=f"speed is {said}.* the speed from edge_count. Report speed in rad/s"):
        identify([check(as_counts(wrong) if counts else wrong)], Request())


def test_stamps_of_another_clock_are_refused() -> None:
    recording, _ = record(TRUTH, *profiles.step(10.0, 1.0), seed=0)
    with pytest.raises(RecordingError, match="edge_time values lie outside the sample that counted the edge. Stamp"):
        identify([check(replace(recording, edge_time=recording.edge_time - 3_000_000_000))], Request())


def spoiled(recording: Recording, how: str, seed: int) -> tuple[Recording, int]:
    """About 1 % of the stamps wrong, and how many."""
    random = np.random.default_rng(seed)
    moving = np.diff(recording.edge_count, prepend=recording.edge_count[0]) != 0
    bad = np.flatnonzero((random.random(len(recording)) < 0.01) & moving)
    stamp = recording.edge_time.copy()
    stamp[bad] = {
        "repeated": lambda: stamp[bad - 1],
        "going backwards": lambda: stamp[bad] - random.integers(6_000_000, 50_000_000, len(bad)),
        "anywhere near": lambda: stamp[bad] + random.integers(-5_000_000, 5_000_000, len(bad)),
        "early": lambda: stamp[bad] - random.integers(100_000, 2_000_000, len(bad)),
        "a timer's wrap off": lambda: stamp[bad] - 262_144_000,
    }[how]()
    return replace(recording, edge_time=stamp), len(bad)


HOW = ["repeated", "going backwards", "anywhere near", "early", "a timer's wrap off"]


@pytest.mark.parametrize("how", keep_fast(HOW, "early", "going backwards"))
@pytest.mark.parametrize("irregularity", keep_fast([0.0, 0.01], 0.01))
def test_one_stamp_in_a_hundred_wrong_changes_nothing(how: str, irregularity: float) -> None:
    for seed, drive in enumerate((profiles.staircase(12.0, 4, 0.25), profiles.random(12.0, 4.0, seed=1))):
        recording, _ = record(TRUTH, *drive, seed=seed, irregularity=irregularity)
        wrong, number = spoiled(recording, how, seed)
        assert number >= 5
        lost = len(extract_edges(recording).time) - len(extract_edges(wrong).time)
        assert 0.3 * number <= lost <= 2 * number + 2  # a wrong stamp takes the edge before it along
        fit = identify([check(wrong)], Request(("coulomb_friction",), SearchConfig(particles=30, epochs=40)))
        off = [(v - TRUTH[name]) / fit.standard_errors[name] for name, v in fit.parameters.values.items()]
        assert max(map(abs, off)) < 3.0
        near = [abs(v / TRUTH[name] - 1.0) for name, v in fit.parameters.values.items()]
        assert max(near) < 0.01
        if how != "early":  # the smallest, below half a slot, are left to be seen as outliers of the fit
            assert fit.residual_rms < 1.3 * fit.noise_floor


def test_right_stamps_are_kept() -> None:
    for seed in range(4):
        for irregularity in (0.0, 0.01, 0.03):
            recording, truth = record(
                TRUTH, *profiles.random(12.0, 4.0, seed=seed), seed=seed, irregularity=irregularity
            )
            assert len(extract_edges(recording).time) >= 0.998 * (
                np.count_nonzero(np.diff(recording.edge_count))
                + np.count_nonzero(np.abs(np.diff(recording.edge_count)) > 1)
            )


def test_two_channels_wired_backwards_are_refused_and_braking_is_not() -> None:
    """A model with positive kv had no sample that fitted: a ZeroDivisionError in the slot table."""
    for drive in (profiles.random(12.0, 3.0, seed=1), profiles.reversals(12.0, 6, 0.2), profiles.step(12.0)):
        right, _ = record(TRUTH, *drive, seed=1, single_channel=False)
        swapped = replace(right, edge_count=-right.edge_count, speed=-right.speed)
        agreement = compare_motion_with_voltage(right)
        assert agreement is not None and agreement > 0.5
        assert compare_motion_with_voltage(swapped) == pytest.approx(-agreement)
        make_intervals(right)
        with pytest.raises(RecordingError, match="counts down while its voltage is positive.*: swap the two channels"):
            identify([swapped], Request(("coulomb_friction",), SearchConfig(20, 20)))
    still = replace(right, edge_count=0 * right.edge_count)
    assert compare_motion_with_voltage(still) is None
