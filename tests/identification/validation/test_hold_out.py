"""Ways to hold data out, with one interface: other recordings, every fourth block of the same, or nothing."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from plant import profiles, record
from small import THETA, TRUE, small_recording

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.problem import make_problem
from motor_identification.measurement.command_swing import measure_swings
from motor_identification.measurement.time_blocks import TimeBlocks
from motor_identification.noise.likelihood import Noise
from motor_identification.recording import Recording, check
from motor_identification.validation.hold_out import (
    LEAST_SWING,
    LEAST_SWING_SHARE,
    LEAST_TRAVEL_SHARE,
    LEAST_WAY,
    LEAST_WAY_SHARE,
    STRETCHES,
    BlocksOfSame,
    HoldOut,
    OtherRecordings,
    WholeRecordings,
    _leave_out_few,
    make_hold_out,
    measure_held_travel,
    sum_held_swing,
)

WRONG = THETA + np.array([0.02, 0.0, 0.0])


@cache
def long() -> Recording:
    """10 s to fit to."""
    return check(record(TRUE, *profiles.random(10.0, 10.0), seed=1, irregularity=0.005, name="training")[0])


@cache
def short() -> Recording:
    """4 s to validate on."""
    return check(record(TRUE, *profiles.random(9.0, 4.0), seed=2, irregularity=0.005, name="other")[0])


@pytest.fixture(params=[BlocksOfSame, OtherRecordings])
def hold_out(request: pytest.FixtureRequest) -> HoldOut:
    made = make_hold_out([long()], [short()] if request.param is OtherRecordings else [])
    assert type(made) is request.param
    return made


def training(hold_out: HoldOut, theta: np.ndarray = THETA) -> Estimate:
    return Estimate(hold_out.restrict(make_problem([long()], ("coulomb_friction",))), theta)


def test_the_truth_is_at_the_floor_and_a_wrong_motor_is_not(hold_out: HoldOut) -> None:
    held, wrong = (hold_out.validate(training(hold_out, theta)) for theta in (THETA, WRONG))
    assert 0.7 < held.gap / held.floor(0.005) < 1.3 and wrong.gap > 3.0 * held.gap
    assert held.parameters.values == pytest.approx(TRUE) and held.miscounted == 0
    assert held.recordings == hold_out.problem.recordings


def test_nothing_that_counts_is_fitted(hold_out: HoldOut) -> None:
    """What counts may be anything: the fit, nuisance parameters too, stays what it was."""
    rule = hold_out.scored_blocks
    (data,) = hold_out.problem.intervals
    spoilt = replace(
        data, speed=np.where(rule.mark(data, hold_out.problem.sample_period), data.speed + 3.0, data.speed)
    )
    other = replace(hold_out, problem=replace(hold_out.problem, intervals=(spoilt,)))
    problem = make_problem([long()], ("coulomb_friction",))
    fits = []
    for one in (hold_out, other):
        train = one.restrict(
            problem if isinstance(one, OtherRecordings) else problem.with_intervals(one.problem.intervals)
        )
        fits.append(one.apply(fit_speeds(Estimate(train, WRONG))).theta)
    assert np.array_equal(*fits)
    assert other.validate(training(other)).gap > hold_out.validate(training(hold_out)).gap + 1.0


@pytest.mark.parametrize(("beside", "share"), [(False, 0.25), (True, 0.5)])
def test_how_much_counts(beside: bool, share: float) -> None:
    hold_out = make_hold_out([long()], [short()] if beside else [])
    held = hold_out.validate(training(hold_out))
    (data,), (scored,) = held.intervals, held.scored
    assert data.duration[scored].sum() / data.duration.sum() == pytest.approx(share, abs=0.06)
    kept = training(hold_out).problem.intervals[0].duration.sum()
    whole = make_problem([long()], ()).intervals[0].duration.sum()
    assert kept / whole == pytest.approx(1.0 if beside else 0.75, abs=0.06)


def test_miscounted_intervals_do_not_count() -> None:
    recording = check(
        record(TRUE | {"miss_rate": 0.01}, *profiles.random(9.0, 4.0), seed=2, irregularity=0.005, name="other")[0]
    )
    hold_out = make_hold_out([long()], [recording])
    held = hold_out.validate(training(hold_out))
    assert held.miscounted > 5 and held.gap < 1.3 * held.floor(0.005)
    everything = replace(held, scored=tuple(np.ones_like(marks) for marks in held.scored))
    assert everything.gap > 3.0 * held.gap


@pytest.mark.parametrize(("instant", "counts"), [(2.75, False), (2.25, True), (2.99, False), (2.93, False)])
def test_a_block_in_which_a_load_begins_at_an_instant_that_nobody_could_foresee_does_not_count(
    instant: float, counts: bool
) -> None:
    """Every other block of half a second counts; what is near its end is not told from what is in it."""
    load = {"step_voltage": 0.8, "step_time": instant}
    other = check(record(TRUE | load, *profiles.random(9.0, 6.2), seed=2, irregularity=0.005, name="other")[0])
    hold_out = make_hold_out([long()], [other])
    fitted = Estimate(make_problem([long()], ("coulomb_friction", "load_step")), np.array([*THETA, 0.8, 0.5]))
    held = hold_out.validate(fitted)
    (data,), (scored,) = held.intervals, held.scored
    begin = data.time[data.first]
    assert scored[(begin > 2.5) & (begin < 3.0)].any() == counts and scored[(begin > 1.5) & (begin < 2.0)].any()
    assert held.gap < 1.3 * held.floor(0.005)
    plain = hold_out.validate(training(hold_out))  # which has no load, and is compared on the same blocks
    alike = plain.leave_out(held.instants)
    assert not (alike.scored[0] & held.instants[0]).any() and (alike is plain) == counts
    without = replace(held, instants=tuple(np.zeros_like(marks) for marks in held.scored))
    noise = Noise(0.005, 0.0)
    assert (held.log_likelihood(noise) == without.log_likelihood(noise)) == counts  # the likelihood is of all blocks


@pytest.mark.parametrize(("left_out", "gone"), [(25, 25), (26, 0)])
def test_no_gap_is_of_what_is_left_where_much_is_left_out(left_out: int, gone: int) -> None:
    everything, some = np.ones(100, dtype=bool), np.arange(100) < left_out
    assert np.count_nonzero(_leave_out_few(everything, some)) == gone


def test_directions_are_those_of_the_fitted_motion() -> None:
    hold_out = make_hold_out([long()], [short()])
    again = hold_out.correct_directions(training(hold_out))
    assert type(again) is OtherRecordings and again.problem.recordings == hold_out.problem.recordings
    assert again.problem.intervals[0].left_out <= hold_out.problem.intervals[0].left_out
    assert again.validate(training(again)).gap < 1.2 * again.validate(training(again)).floor(0.005)


def drive(*volts: float) -> Recording:
    """A motor under voltages that are each held for half a second."""
    return check(record(TRUE, *profiles.pieces(volts, 0.5), seed=3, name="driven")[0])


STEP = drive(0.0, *[8.0] * 11)


@pytest.mark.parametrize(
    ("recordings", "kind"),
    [
        ([STEP], WholeRecordings),  # a step
        ([drive(*[8.0, 0.0] * 5)], WholeRecordings),  # many, all in the blocks that are not held out
        ([drive(*[8.0, 0.0] * 12)], BlocksOfSame),
        ([STEP] * 6, WholeRecordings),  # one of six would be held out
        ([STEP] * 11, BlocksOfSame),
        ([drive(*[8.0, 7.7] * 40)], WholeRecordings),  # a controller that holds a speed
    ],
    ids=["step", "few steps", "steps", "few runs", "runs", "held speed"],
)
def test_nothing_is_held_out_where_the_command_hardly_swings_there(recordings: list[Recording], kind: type) -> None:
    hold_out = make_hold_out(recordings, [])
    assert type(hold_out) is kind and hold_out.seen == (kind is WholeRecordings)
    swings = [measure_swings(recording) for recording in recordings]
    held, every = sum_held_swing(hold_out.problem, swings, hold_out.scored_blocks), sum(map(np.sum, swings))
    assert held == pytest.approx(every) if hold_out.seen else LEAST_SWING <= held < 0.5 * every


def test_blocks_that_are_in_step_with_a_train_of_pulses_are_stretched() -> None:
    """Every fourth block of this one is a stop: the command swings in it as much as by chance, and nothing turns."""
    pulses = [drive(*[8.0, 0.0, -8.0, 0.0] * 12)]
    hold_out, in_step = make_hold_out(pulses, []), TimeBlocks(4)
    swings = [measure_swings(recording) for recording in pulses]
    every = sum(map(np.sum, swings))
    assert sum_held_swing(hold_out.problem, swings, in_step) > LEAST_SWING_SHARE * every / 4
    assert measure_held_travel(hold_out.problem, in_step).share < 0.5 * LEAST_TRAVEL_SHARE
    assert LEAST_TRAVEL_SHARE < measure_held_travel(hold_out.problem, hold_out.scored_blocks).share < 1.5
    assert hold_out.scored_blocks.stretch == STRETCHES[1]
    random = make_hold_out([long()], [])  # of which the usual blocks show as much as others
    assert random.scored_blocks.stretch == 1.0
    held = measure_held_travel(random.problem, in_step)
    assert held.share > LEAST_TRAVEL_SHARE and held.share_one_way > LEAST_WAY_SHARE


def test_blocks_that_show_one_way_only_are_stretched() -> None:
    """Every fourth block of this one is the way back: as much travel as by chance, and none of it forwards."""
    there_and_back, in_step = [drive(*[8.0, 8.0, 0.0, -8.0] * 12)], TimeBlocks(4)
    hold_out = make_hold_out(there_and_back, [])
    assert hold_out.scored_blocks.stretch > 1.0
    before, held = (measure_held_travel(hold_out.problem, blocks) for blocks in (in_step, hold_out.scored_blocks))
    assert before.share > LEAST_TRAVEL_SHARE and before.share_one_way == 0.0
    assert held.share > LEAST_TRAVEL_SHARE and held.share_one_way > LEAST_WAY_SHARE


@pytest.mark.parametrize(("share", "seen"), [(0.9 * LEAST_WAY, False), (1.1 * LEAST_WAY, True)])
def test_a_little_motion_back_need_not_be_held_out(share: float, seen: bool) -> None:
    """Such as the swing at the end of a stop; here all that goes back is in blocks that are not held out."""
    problem, blocks = make_hold_out([STEP] * 11, []).problem, TimeBlocks(4)
    data = problem.intervals[0]
    kept = ~blocks.mark(data, problem.sample_period, 0)
    back = kept & (np.cumsum(np.where(kept, data.travel, 0.0)) <= share * data.travel.sum())
    turned = replace(data, speed=np.where(back, -1.0, 1.0) * np.abs(data.speed))
    one = replace(problem, recordings=problem.recordings[:1], intervals=(turned,))
    held = measure_held_travel(one, blocks)
    assert held.share_one_way == 0.0 if seen else held.share_one_way >= held.share > LEAST_TRAVEL_SHARE


def test_where_nothing_is_held_out_all_is_fitted_and_counts() -> None:
    hold_out = make_hold_out([STEP], [])
    problem = make_problem([STEP], ("coulomb_friction",))
    assert hold_out.restrict(problem) is problem
    held = hold_out.validate(Estimate(problem, THETA))
    assert held.counted.all() and held.seen and not held.confirms


@pytest.mark.parametrize(
    ("recordings", "confirms"),
    [
        ([STEP], False),
        ([STEP, STEP], True),
        ([drive(8.0, 6.4, 4.8)], False),
        ([drive(8.0, 6.4, 4.8, 3.2)], True),
        ([drive(8.0, 6.8, 8.0, 6.8)], False),
        ([drive(8.0, 6.8, 8.0, 6.8, 8.0)], True),
    ],
    ids=["step", "two", "three levels", "four levels", "four responses", "five responses"],
)
def test_more_than_a_step_confirms(recordings: list[Recording], confirms: bool) -> None:
    hold_out = make_hold_out(recordings, [])
    problem = make_problem(recordings, ("coulomb_friction",))
    assert hold_out.seen and hold_out.validate(Estimate(problem, THETA)).confirms == confirms


def test_small_recordings_have_blocks_too() -> None:
    hold_out = BlocksOfSame(make_problem([small_recording()], ()), TimeBlocks(4))
    held = hold_out.validate(
        Estimate(hold_out.restrict(make_problem([small_recording()], ("coulomb_friction",))), THETA)
    )
    assert 0.1 < held.counted.mean() < 0.4
