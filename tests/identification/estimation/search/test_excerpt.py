"""Excerpts of long recordings: same unknowns, little to simulate, and the same motor is found."""

import numpy as np
import pytest
from tiers import keep_fast

from motor_identification.estimation.problem import Problem, make_problem
from motor_identification.estimation.search.excerpt import MOST_SEARCHED, PIECES_PER_RECORDING, take_excerpt
from motor_identification.identify import Request, SearchConfig, identify
from motor_identification.recording import Recording, check, recording_of
from motor_model.excitation import profile
from motor_model.parameters import Parameters
from motor_model.sensing.board import BoardConfig, SimulatedBoard

TRUE = {"kv": 0.0955, "ka": 0.0055, "ks": 0.4}
EFFECTS = ("coulomb_friction",)
LONGEST = MOST_SEARCHED / 200.0  # [s]


def recorded(repeats: int, first: int = 0) -> Recording:
    """`rich` several times over, each time with another voltage; without the first samples."""
    config = BoardConfig(slot_irregularity=0.01, seed=4)
    board = SimulatedBoard(Parameters(TRUE, EFFECTS), config)
    rich = profile("rich")
    shape = rich.voltage(np.arange(0.0, rich.duration, 0.005), 1.0)
    commands = np.concatenate([peak * shape for peak in np.linspace(6.0, 12.0, repeats)])
    samples = [board.sample(float(command)) for command in commands][first:]
    return check(recording_of(samples, config.info(Parameters(TRUE, EFFECTS)), "long"))


@pytest.fixture(scope="module")
def long() -> Recording:
    return recorded(6)


def coarse(recordings: list[Recording], effects: tuple[str, ...] = EFFECTS) -> Problem:
    return make_problem(recordings, effects).coarsen(4.0)


def place_of(task: Problem, **values: float) -> np.ndarray:
    found = {**TRUE, **values}
    return np.array([np.log(found["kv"]), np.log(found["ka"]), found["ks"], *np.zeros(len(task.unknowns.low) - 3)])


def test_pieces_are_short_begin_at_rest_and_are_simulated_as_the_whole_is(long: Recording) -> None:
    whole = coarse([long])
    pieces = take_excerpt(whole)
    assert len(pieces.intervals) == PIECES_PER_RECORDING
    seen = sum(float(data.time[-1] - data.time[0]) for data in pieces.intervals)
    assert 0.9 * LONGEST < seen <= LONGEST + 0.1
    assert (
        len({int(data.time[0] / long.duration * PIECES_PER_RECORDING) for data in pieces.intervals})
        == PIECES_PER_RECORDING
    )
    for place in (place_of(whole), place_of(whole, ka=0.0066), place_of(whole, ks=0.8)):
        everywhere, here = (task.costs(place[None])[0] for task in (whole, pieces))
        assert 0.3 < here / everywhere < 3.0  # a piece that began on a moving motor would be off by its whole speed


def test_the_excerpt_has_the_same_minimum(long: Recording) -> None:
    pieces = take_excerpt(coarse([long]))
    best = pieces.costs(place_of(pieces)[None])[0]
    for name, factor in (("kv", 1.01), ("kv", 0.99), ("ka", 1.05), ("ka", 0.95), ("ks", 1.05), ("ks", 0.95)):
        assert pieces.costs(place_of(pieces, **{name: factor * TRUE[name]})[None])[0] > 1.2 * best


def test_short_recordings_and_effects_that_happen_anywhere_are_searched_whole(long: Recording) -> None:
    short = coarse([recorded(1)])
    assert take_excerpt(short) is short
    for effect in ("load_step", "warm_up"):
        whole = coarse([long], (*EFFECTS, effect))
        assert take_excerpt(whole) is whole


@pytest.mark.slow
def test_phases_count_from_the_beginning_and_a_turning_motor_has_one_initial_speed(long: Recording) -> None:
    for recording, effects in ((long, (*EFFECTS, "torque_ripple")), (recorded(6, first=300), EFFECTS)):
        pieces = take_excerpt(coarse([recording], effects))
        assert [float(data.time[0]) for data in pieces.intervals] == [0.0]
        assert 0.9 * LONGEST < pieces.intervals[0].time[-1] <= LONGEST + 0.1
    turning = coarse([recorded(6, first=300), long])
    assert list(turning.unknowns.turning) == [True, False]
    pieces = take_excerpt(turning)
    assert pieces.unknowns.turning.sum() == 1
    assert len(pieces.unknowns.low) == len(turning.unknowns.low)
    starts = pieces.unknowns.decode(np.append(place_of(short_of(pieces)), 12.5)[None])[1]
    assert list(starts[0]) == [12.5] + [0.0] * (len(pieces.intervals) - 1)


def short_of(task: Problem) -> Problem:
    """The problem as if no recording began turning, for a place without initial speeds."""
    return make_problem([task.recordings[-1]], EFFECTS)


def test_a_long_recording_is_identified(long: Recording) -> None:
    fit = identify([long], Request(EFFECTS, SearchConfig(particles=16)))
    for name, true in TRUE.items():
        relative = fit.standard_errors[name] / true
        assert 1e-9 < relative < 1e-6
        assert abs(fit.parameters.value(name) / true - 1.0) < 4.0 * relative


@pytest.mark.parametrize("name", keep_fast(["staircase", "prbs"], "prbs"))
def test_a_motor_that_stands_for_most_of_the_recording_is_searched_where_it_moves(name: str) -> None:
    """Two minutes at 0 V, then motion: pieces fell into the standstill, and nothing was left to fit."""
    config = BoardConfig(seed=4)
    board = SimulatedBoard(Parameters(TRUE, EFFECTS), config)
    drive = profile(name)
    commands = np.append(np.zeros(24_000), drive.voltage(np.arange(0.0, drive.duration, 0.005), 10.0))
    samples = [board.sample(float(command)) for command in commands]
    recording = check(recording_of(samples, config.info(Parameters(TRUE, EFFECTS)), "still"))
    pieces = take_excerpt(coarse([recording]))
    assert len(pieces.intervals) >= 1 and all(len(data.first) > 10 for data in pieces.intervals)
    fit = identify([recording], Request(EFFECTS, SearchConfig()))
    assert fit.parameters.value("kv") == pytest.approx(TRUE["kv"], rel=1e-3)
