"""A line in the residual's spectrum over the angle: its cycles, amplitude and phase; nothing where there is none."""

from dataclasses import replace
from functools import cache
from math import tau

import numpy as np
import pytest
from plant import profiles, record
from small import TRUE

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.problem import make_problem
from motor_identification.periodic import ripple_spectrum
from motor_identification.periodic.periodic_fit import Tracks, measure_angles
from motor_identification.periodic.ripple_spectrum import (
    KNOT_CYCLES,
    KNOT_SHARE,
    LINE_CHANCE,
    PHASE_CHANCE,
    SLIP_CHANCE,
    SLIP_CHANCE_BASE,
    _explained_by_chance,
    _spectrum,
    find_finest,
    find_ripples,
    fit_ripple,
    measure_line,
    place_knots,
)
from motor_identification.periodic.whitened_run import whiten_runs
from motor_identification.recording import check
from motor_model.effects import SPEC_BY_NAME

RIPPLE = {"ripple_voltage": 0.3, "ripple_cycles": 5.3, "ripple_phase": 0.8}


@cache
def lacking(**ripple: float) -> tuple[Estimate, Tracks]:
    """A fit with friction, to a motor that may have a ripple too."""
    drive = profiles.staircase(10.0, 3, 0.25)
    recording = check(record(TRUE | ripple, *drive, seed=1, irregularity=0.003, disc_seed=1)[0])
    problem = make_problem([recording], ("coulomb_friction",))
    estimate = fit_speeds(Estimate(problem, np.array([np.log(TRUE["kv"]), np.log(TRUE["ka"]), TRUE["ks"]])))
    return estimate, measure_angles(estimate, problem.unknowns.effects)


def swinging(volts: list[float], seconds: float, **ripple: float) -> tuple[Estimate, Tracks]:
    """The same of a motor that is driven to and fro."""
    recording = check(record(TRUE | ripple, *profiles.pieces(volts, seconds), seed=1)[0])
    problem = make_problem([recording], ("coulomb_friction",))
    estimate = fit_speeds(Estimate(problem, np.array([np.log(TRUE["kv"]), np.log(TRUE["ka"]), TRUE["ks"]])))
    return estimate, measure_angles(estimate, problem.unknowns.effects)


def test_the_strongest_line_is_the_ripple() -> None:
    lines = find_ripples(*lacking(**RIPPLE))
    assert lines[0].cycles == pytest.approx(5.3, abs=0.02)
    assert lines[0].amplitude == pytest.approx(0.3, rel=0.1)
    assert abs(np.angle(np.exp(1j * (lines[0].phases[0] - 0.8)))) < 0.3
    assert [line.explained for line in lines] == sorted((line.explained for line in lines), reverse=True)


@pytest.mark.parametrize(("times", "found"), [(0.9, True), (1.5, False)])
def test_less_than_the_least_is_no_line(times: float, found: bool) -> None:
    estimate, tracks = lacking(**RIPPLE)
    explained = find_ripples(estimate, tracks)[0].explained
    assert bool(find_ripples(estimate, tracks, times * explained)) is found


def test_where_there_is_none_chance_makes_none() -> None:
    estimate, tracks = lacking()
    assert find_ripples(estimate, tracks, 4.0) == []


def test_a_motor_that_swings_within_a_turn_has_no_line_of_fewer_cycles_than_one() -> None:
    estimate, tracks = swinging([6.0, -6.0] * 4, 0.05)
    assert np.ptp(tracks[0].angle) < np.pi
    with np.errstate(all="raise"):
        lines = find_ripples(estimate, tracks)
    low, high = SPEC_BY_NAME["ripple_cycles"].box(estimate.problem.unknowns.extent)
    assert lines and all(low <= line.cycles <= high for line in lines)


def test_a_motor_that_swings_on_by_a_part_of_a_turn_has_its_line_of_one_cycle() -> None:
    once = {"ripple_voltage": 0.6, "ripple_cycles": 1.0, "ripple_phase": 0.8}
    estimate, tracks = swinging([10.0, -8.0] * 60, 0.1, **once)
    assert np.ptp(tracks[0].angle) > 20.0 * tau
    assert max(run.longest_turns() for run in whiten_runs(estimate, tracks)) < 1.5
    assert find_ripples(estimate, tracks)[0].cycles == pytest.approx(1.0, abs=0.02)


def test_where_one_line_alone_could_be_seen_it_is_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    """The grid's points beside it are beyond what is searched."""
    monkeypatch.setattr(ripple_spectrum, "find_finest", lambda runs, low, high, most: low)
    estimate, tracks = lacking(**{**RIPPLE, "ripple_cycles": 1.0})
    low = SPEC_BY_NAME["ripple_cycles"].box(estimate.problem.unknowns.extent)[0]
    assert [line.cycles for line in find_ripples(estimate, tracks)] == [low]


@pytest.mark.parametrize(("off", "share"), [(0.0, 0.9), (0.5, 0.0)])
def test_a_line_of_given_cycles(off: float, share: float) -> None:
    estimate, tracks = lacking(**RIPPLE)
    best = find_ripples(estimate, tracks)[0]
    one = fit_ripple(estimate, tracks, best.cycles + off)
    assert one.cycles == best.cycles + off
    assert (
        one.explained == pytest.approx(best.explained, rel=1e-9) if off == 0.0 else one.explained < 0.5 * best.explained
    )
    assert one.amplitude > share * best.amplitude


@pytest.mark.parametrize("volts", [1.0, 0.1, 0.01])
def test_no_finer_ripple_than_could_be_seen_is_searched(monkeypatch: pytest.MonkeyPatch, volts: float) -> None:
    """What one of so many volts would explain, of the sum of white squares: as much as chance, and not finer."""
    monkeypatch.setattr(ripple_spectrum, "MANY_CYCLES", 400.0)
    runs = whiten_runs(*lacking())
    finest = find_finest(runs, 1.0, 400.0, volts)

    def explained(cycles: float) -> float:
        sums = [run.sum_products(cycles, np.zeros_like(run.course.run))[0] for run in runs]
        return 0.5 * volts**2 * sum(float(part[0] + part[2]) for part in sums)

    around = finest * np.array([1.0, 0.97, 0.93])
    assert max(map(explained, around)) > LINE_CHANCE or finest == 1.0
    finer = np.geomspace(1.3 * finest, 400.0, 12) if finest < 300.0 else []
    assert all(explained(cycles) < 1.5 * LINE_CHANCE for cycles in finer)
    assert {1.0: 100.0, 0.1: 20.0, 0.01: 1.0}[volts] <= finest <= {1.0: 400.0, 0.1: 100.0, 0.01: 20.0}[volts]


@pytest.mark.parametrize("many", [2.0, 150.0, 400.0])
def test_of_many_cycles_a_smaller_ripple_is_searched(monkeypatch: pytest.MonkeyPatch, many: float) -> None:
    """They come through a gear; what is seen of few cycles is searched as it was."""
    runs = whiten_runs(*lacking())
    monkeypatch.setattr(ripple_spectrum, "MANY_CYCLES", 400.0)
    large, small = (find_finest(runs, 1.0, 400.0, volts) for volts in (1.0, ripple_spectrum.FINE_SIZE))
    assert small < 100.0 < 150.0 < large
    monkeypatch.setattr(ripple_spectrum, "MANY_CYCLES", many)
    wanted = {2.0: small, 150.0: 150.0, 400.0: large}[many]
    assert find_finest(runs, 1.0, 400.0, 1.0) == pytest.approx(wanted, rel=0.3 if many == 2.0 else 0.0)


def test_no_block_explains_much_more_than_is_there() -> None:
    """Whitening mixes neighbours; a block of hardly any response has no more than twice its own squares explained."""
    runs = whiten_runs(*lacking(**RIPPLE))
    blocks = [run.number_blocks() for run in runs]
    there = sum(float(run.white @ run.white) for run in runs)
    cycles = np.arange(1.0, 9.0, 0.25)
    assert _spectrum(runs, cycles, blocks, 1e6, lambda: None).max() <= 2.0 * there
    short = [np.arange(len(run.white)) // 2 for run in runs]  # the worst that can be: two intervals each
    assert 0.5 * there < _spectrum(runs, cycles, short, 1e6, lambda: None).max() <= 2.0 * there
    nothing = [replace(run, white=0.0 * run.white) for run in runs]
    assert not _spectrum(nothing, np.array([1.0, 1.25]), blocks, 1e6, lambda: None).any()


def test_a_ripple_of_many_volts_is_no_explanation() -> None:
    """The prior of its size: of a thousandth of the volts next to nothing is explained, of a thousand as much."""
    runs = whiten_runs(*lacking(**RIPPLE))
    blocks, cycles = [run.number_blocks() for run in runs], np.array([5.25, 5.3])
    small, usual, large = (_spectrum(runs, cycles, blocks, volts, lambda: None).max() for volts in (3e-4, 0.3, 300.0))
    assert small < 0.01 * usual < usual < large < 1.05 * usual


def test_phases_of_runs_explain_by_chance() -> None:
    """A counted angle needs the best of all lines to be beaten, speeds two squares more for each further run."""
    (run,) = whiten_runs(*lacking())
    (data,) = lacking()[0].problem.intervals
    last = int(run.course.run.max())
    assert last > 1
    told = replace(data, slot=0.0, place=np.zeros_like(data.place))
    free = replace(data, slot=0.0, place=np.full_like(data.place, np.nan))
    assert _explained_by_chance(run, told) == LINE_CHANCE
    assert _explained_by_chance(run, free) == LINE_CHANCE + PHASE_CHANCE * last
    assert _explained_by_chance(run, data) == SLIP_CHANCE * (last + SLIP_CHANCE_BASE)


@pytest.mark.parametrize(("turns", "width"), [(0.0, 100.0), (0.04, 25.0), (1.0, 1.0), (4.0, 0.25), (50.0, 0.125)])
def test_a_line_is_as_wide_as_the_motion_is_short(turns: float, width: float) -> None:
    """An axis that goes on by a twenty-fifth of a turn: a sensor that shows 80,000 cycles took ten minutes."""
    assert measure_line(turns) == pytest.approx(width)


def test_knots_are_no_further_apart_than_responses_change() -> None:
    fine = np.arange(1.0, 300.0, 0.25)
    places = place_knots(fine)
    few = places[fine[places] < 16 * 0.25 / KNOT_SHARE]  # where a share of them is less than 16 points
    assert few.tolist() == list(range(0, len(few) * 16, 16)) and len(few) > 40
    apart = np.diff(fine[places[len(few) :]])
    assert np.all(apart <= KNOT_SHARE * fine[places[len(few) : -1]] + 0.25) and np.max(apart) > 5.0
    coarse = np.arange(1.0, 2000.0, 6.25)
    places = place_knots(coarse)
    assert places[0] == 0 and places[-1] == len(coarse) - 1 and np.all(np.diff(places) > 0)
    apart, allowed = np.diff(coarse[places]), np.maximum(KNOT_CYCLES, KNOT_SHARE * coarse[places[:-1]])
    assert np.all(apart <= allowed + 6.25) and np.max(apart) > 30.0
    assert place_knots(np.array([1.0])).tolist() == [0]


def test_a_motor_that_swings_within_a_turn_has_its_line() -> None:
    """Where lines are wide, a grid as wide finds them."""
    estimate, tracks = swinging([6.0, -6.0] * 20, 0.05, **(RIPPLE | {"ripple_cycles": 21.0, "ripple_voltage": 1.0}))
    assert np.ptp(tracks[0].angle) < 0.5 * tau
    turns = float(np.ptp(tracks[0].angle)) / tau
    assert find_ripples(estimate, tracks)[0].cycles == pytest.approx(21.0, abs=0.5 * measure_line(turns))
