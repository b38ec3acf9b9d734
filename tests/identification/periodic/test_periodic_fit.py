"""What repeats with the shaft angle is found where no swarm would: its line, size, and phase in every recording."""

from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from plant import profiles, record
from recorded import as_speed, without_count
from tiers import keep_fast

from motor_identification.estimation.direction_correction import correct_directions
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.parameter_space import make_unknowns, map_theta
from motor_identification.estimation.problem import make_problem
from motor_identification.identify import Request, SearchConfig, identify
from motor_identification.measurement.intervals import Intervals
from motor_identification.measurement.measured_angle import Track, make_track
from motor_identification.noise.angle_noise import Whitening
from motor_identification.noise.likelihood import Noise
from motor_identification.periodic import periodic_fit
from motor_identification.periodic.periodic_fit import add_periodic_effect, align_wave, measure_angles
from motor_identification.periodic.ripple_spectrum import LINE_CHANCE, PHASE_CHANCE, SLIP_CHANCE, find_ripples
from motor_identification.periodic.run_alignment import Aligned, align_runs
from motor_identification.recording import Floats, Recording, check
from motor_identification.sensor.description import note_sensors
from motor_model.effects import INDEX
from motor_model.parameters import PAPER_KA, PAPER_KV

BASE = {"kv": PAPER_KV, "ka": PAPER_KA}
RIPPLE = {"ks": 0.35, "ripple_voltage": 0.3, "ripple_cycles": 5.3}


def made(values: dict[str, float], drive: profiles.Profile, seed: int) -> Recording:
    return check(record(BASE | values, *drive, seed=seed, irregularity=0.005)[0])


def near(a: float, b: float) -> float:
    """How far two phases are apart [rad]."""
    return abs(float(np.angle(np.exp(1j * (a - b)))))


@pytest.mark.slow
def test_a_ripple_in_two_recordings_with_a_phase_each() -> None:
    phases = (0.8, -2.0)
    drives = (profiles.staircase(10.0, 3, 0.25), profiles.staircase(7.0, 2, 0.3))
    recordings = [
        made(RIPPLE | {"ripple_phase": phase}, drive, seed)
        for seed, (phase, drive) in enumerate(zip(phases, drives, strict=True))
    ]
    fit = identify(recordings, Request(("coulomb_friction", "torque_ripple"), SearchConfig(particles=20, epochs=60)))
    for name, value in (BASE | RIPPLE).items():
        error = fit.parameters.value(name) - value
        assert abs(error) < 0.02 * value
        assert 0.0 < fit.standard_errors[name] < 0.02 * value
    assert abs(fit.parameters.value("ripple_cycles") - 5.3) < 0.01
    assert near(fit.parameters.value("ripple_phase"), phases[0]) < 0.3
    assert 0.8 < fit.residual_rms / fit.noise_floor < 1.5
    without = identify(recordings, Request(("coulomb_friction",), SearchConfig(particles=20, epochs=60)))
    assert without.residual_rms > 1.3 * fit.residual_rms


def without_ripple(recording: Recording, values: dict[str, float]) -> tuple[Estimate, Floats]:
    """A fit that lacks only the ripple, and where it began."""
    bare = make_problem([recording], ("coulomb_friction",) if "ks" in values else ())
    guess = np.array([np.log(values["kv"]), np.log(values["ka"]), values.get("ks", 0.0)])[: len(bare.unknowns.low)]
    return fit_speeds(correct_directions(fit_speeds(Estimate(bare, guess)))), guess


SWINGING = {"kv": 0.071, "ka": 0.0056, "ripple_voltage": 0.39, "ripple_cycles": 10.866, "ripple_phase": 0.4}


@pytest.mark.parametrize("friction", keep_fast([0.0, 0.4], 0.4), ids=["swings on its ripple", "with friction"])
def test_a_ripple_is_followed_through_every_standstill(friction: float) -> None:
    """Without friction the shaft swings where it should stand, no edge says which way, and a fit takes it for noise."""
    values = SWINGING | ({"ks": friction} if friction else {})
    parts = [profiles.staircase(12.0, 4, 0.4), profiles.ramps(12.0, 1.2), profiles.reversals(12.0, 6)]
    drive = profiles.joined(*parts, profiles.coast(12.0, 2, 0.6), profiles.random(12.0, 4.0, 3))
    recording = check(record(values, *drive, seed=3, irregularity=0.005)[0])
    bare, guess = without_ripple(recording, values)
    line = find_ripples(bare, measure_angles(bare, bare.problem.unknowns.effects))[0]
    assert abs(line.cycles - 10.866) < 0.01
    assert 0.8 * 0.39 < line.amplitude < 1.1 * 0.39

    found = add_periodic_effect(bare, "torque_ripple", 4.0)
    assert found is not None and found.simulations > bare.simulations + 100
    fitted = found.parameters.values
    assert 1e-9 < abs(fitted["ripple_cycles"] - 10.866) < 1e-3
    assert abs(fitted["ripple_voltage"] / 0.39 - 1.0) < 0.01
    assert abs(fitted.get("ks", 0.0) - friction) < 1e-4
    truth = map_theta(bare.problem.unknowns, guess, found.problem.unknowns, {name: np.array(values[name]) for name in (
        "ripple_voltage", "ripple_cycles", "ripple_phase")})  # fmt: skip
    best = found.problem.cost(truth)
    assert 0.99 * best < found.cost < 1.02 * best < 0.5 * bare.problem.cost(guess)


@pytest.mark.slow
def test_a_ripple_is_found_that_is_not_among_the_highest_lines_of_the_blocks() -> None:
    """A small one beside an irregular disc: in blocks of a few turns eleven other lines look more likely."""
    values = {"kv": 0.05004, "ka": 0.005761, "ripple_voltage": 0.26745, "ripple_cycles": 10.8622, "ripple_phase": -1.21}
    recording = check(record(values, *profiles.rich(12.0, 1002), seed=1002, irregularity=0.00525, disc_seed=195)[0])
    bare, _guess = without_ripple(recording, values)
    lines = find_ripples(bare, measure_angles(bare, ()), 4.0)
    assert abs(lines[0].cycles - 10.8622) < 0.005
    assert 0.8 < lines[0].amplitude / 0.26745 < 1.1


def test_an_eccentric_disc() -> None:
    truth = {"ks": 0.3, "eccentricity": 0.03, "eccentricity_phase": 2.5}
    recording = made(truth, profiles.staircase(10.0, 4, 0.25), seed=3)
    fit = identify(
        [recording], Request(("coulomb_friction", "encoder_eccentricity"), SearchConfig(particles=20, epochs=60))
    )
    assert abs(fit.parameters.value("eccentricity") - 0.03) < 6e-4
    assert near(fit.parameters.value("eccentricity_phase"), 2.5) < 0.05
    assert abs(fit.parameters.value("kv") / PAPER_KV - 1.0) < 1e-4
    assert 0.8 < fit.residual_rms / fit.noise_floor < 1.5


@pytest.mark.parametrize("size", [0.0, 0.002])
def test_an_eccentricity_is_followed_where_a_fit_gains_by_it(size: float) -> None:
    recording = made({"eccentricity": size, "eccentricity_phase": 0.7}, profiles.staircase(10.0, 3, 0.3), seed=2)
    bare = correct_directions(fit_speeds(Estimate(make_problem([recording], ()), np.log([PAPER_KV, PAPER_KA]))))
    asked = add_periodic_effect(bare, "encoder_eccentricity")
    assert asked is not None
    found = add_periodic_effect(bare, "encoder_eccentricity", 4.0)
    assert (found is None) == (size == 0.0)
    for estimate in filter(None, (asked, found)):
        assert abs(estimate.parameters.values["eccentricity"] - size) < 3e-4


def test_every_recording_has_its_own_phase_and_load_step() -> None:
    recordings = [made({"ks": 0.3}, profiles.step(8.0, 0.4), seed) for seed in range(3)]
    unknowns = make_unknowns(recordings, ("coulomb_friction", "load_step", "torque_ripple"))
    own = ["step_time", "ripple_phase"]
    assert [unknowns.names.index(name) for name in own] == [4, 7]
    assert unknowns.columns.tolist() == [[0, 1, 2, 3, 4, 5, 6, 7], [0, 1, 2, 3, 8, 5, 6, 9], [0, 1, 2, 3, 10, 5, 6, 11]]
    place = np.arange(12.0) / 100.0 + unknowns.low
    vectors, _starts = unknowns.decode(place[None])
    assert vectors.shape[:2] == (1, 3)
    changing = [name for name in INDEX if len(set(vectors[0, :, INDEX[name]])) > 1]
    assert changing == own

    fewer = make_unknowns(recordings, ("coulomb_friction",))
    back = map_theta(unknowns, place, fewer, {})
    assert np.array_equal(back, place[:3])
    again = map_theta(fewer, back, unknowns, {
        "step_voltage": np.array(0.5), "step_time": np.array([0.1, 0.2, 0.3]), "ripple_voltage": np.array(0.1),
        "ripple_cycles": np.array(5.0), "ripple_phase": np.array([1.0, 2.0, -1.0]),
    })  # fmt: skip
    assert np.allclose(again, [*place[:3], 0.5, 0.1, 0.1, 5.0, 1.0, 0.2, 2.0, 0.3, -1.0])


def test_the_measured_angle_is_that_of_the_shaft() -> None:
    """A poor motor bridges the gaps of reversals, and the encoder counts everything else."""
    recording = made({"ks": 0.3}, profiles.staircase(8.0, 3, 0.3), seed=5)
    problem = make_problem([recording], ("coulomb_friction",))
    good = np.array([np.log(PAPER_KV), np.log(PAPER_KA), 0.3])
    poor = np.array([np.log(1.05 * PAPER_KV), np.log(0.9 * PAPER_KA), 0.2])
    (data,) = problem.intervals
    truth = problem.angles(good)[0]
    track = make_track(data, problem.angles(poor)[0])
    away = np.abs(problem.angles(poor)[0] - truth).max()
    assert away > 20.0 * data.slot
    error = track.at(data.time) - truth
    assert np.abs(error).max() < 2.0 * data.slot
    for run in np.unique(track.run):  # and within a run it does not drift
        inside = track.run_at(data.time) == run
        assert np.ptp(error[inside]) < 0.6 * data.slot


@pytest.mark.parametrize("seed", range(5))
def test_slips_between_runs_are_found(seed: int) -> None:
    random = np.random.default_rng(seed)
    slips = np.cumsum(random.integers(-2, 3, 12) * (random.random(12) < 0.4))
    slips -= slips[0]
    turn, wave = 0.7, 0.3 * np.exp(1j * random.uniform(-3.0, 3.0))
    sums = []
    for slip in slips:
        here = wave * np.exp(1j * turn * slip)
        design = random.standard_normal((60, 2)) * 10.0
        white = design @ [here.real, here.imag] + random.standard_normal(60)
        gram, vector = design.T @ design, design.T @ white
        sums.append([gram[0, 0], gram[0, 1], gram[1, 1], *vector])
    found = align_runs(np.array(sums), turn, False)
    assert np.abs((found.slips - found.slips[0]) / turn - slips).max() <= 0.25 + 1e-9  # one step
    assert abs(abs(found.weight) - 0.3) < 0.02
    assert 0.8 < found.explained / sum(np.array([0.3**2 * (s[0] + s[2]) / 2.0 for s in sums])) < 1.3


@pytest.mark.parametrize("seed", range(5))
def test_no_other_slips_explain_more(seed: int) -> None:
    """All 97³ of three runs, under the wave that was found, at 5/2 for a step of slip."""
    random = np.random.default_rng(seed)
    parts = random.standard_normal((3, 4, 2)) * random.uniform(2.0, 20.0)
    white = parts @ [0.3, -0.2] + random.standard_normal((3, 4))
    gram, vector = np.swapaxes(parts, 1, 2) @ parts, np.einsum("rij,ri->rj", parts, white)
    sums = np.column_stack([gram[:, 0, 0], gram[:, 0, 1], gram[:, 1, 1], vector])
    found = align_runs(sums, 0.9, False)
    slips = np.arange(-48, 49) / 4
    wave = found.weight * np.exp(1j * 0.9 * slips)
    ss, sc, cc, sw, cw = sums.T[:, :, None]
    gain = 2.0 * (wave.real * sw + wave.imag * cw)
    gain -= wave.real**2 * ss + 2.0 * wave.real * wave.imag * sc + wave.imag**2 * cc
    price = 10.0 * np.abs(slips[:, None] - slips)
    paths = (gain[0] - 10.0 * np.abs(slips))[:, None, None] + (gain[1] - price)[:, :, None] + (gain[2] - price)[None]
    best = np.array(np.unravel_index(np.argmax(paths), paths.shape))
    assert found.slips == pytest.approx(0.9 * slips[best], abs=1e-12)
    assert abs(paths.max() - found.explained) < 1e-6 * paths.max()


def test_an_eccentric_disc_is_seen_in_the_speeds_that_were_counted_on_it() -> None:
    wave = {"eccentricity": 0.04, "eccentricity_phase": 0.5}
    drive = profiles.staircase(8.0, 3, 0.5)
    recording = as_speed(
        check(record({"kv": 0.07, "ka": 0.0056} | wave, *drive, seed=1, edges=960, single_channel=False)[0])
    )
    fit = identify([recording], Request(("encoder_eccentricity",)))
    assert fit.parameters.values["eccentricity"] == pytest.approx(0.04, rel=0.05)


@pytest.mark.parametrize("size", [0.0, 0.016])
def test_an_eccentricity_far_below_a_count_is_seen_through_the_rounding_of_speeds(size: float) -> None:
    """Of 53 counts a turn, rows of 5 ms scatter by a dozen times what a disc does that is off by an eighth of one."""
    values = BASE | {"eccentricity": size, "eccentricity_phase": 0.5}
    motion = record(values, *profiles.staircase(6.0, 3, 0.5), seed=1, edges=53, single_channel=False)
    recording = note_sensors([without_count(as_speed(check(motion[0])))])[0]
    bare = fit_speeds(Estimate(make_problem([recording], ()), np.log([PAPER_KV, PAPER_KA])))
    found = add_periodic_effect(bare, "encoder_eccentricity", LINE_CHANCE)
    assert (found is None) == (size == 0.0)
    if found is not None:
        assert found.parameters.values["eccentricity"] == pytest.approx(size, rel=0.1)


@pytest.mark.parametrize(
    ("slot", "both", "chance"), [(0.0, False, PHASE_CHANCE), (0.1, False, SLIP_CHANCE), (0.0, True, 0.0)]
)
@pytest.mark.parametrize("side", [0.99, 1.01])
def test_runs_that_each_turn_as_it_fits_best_explain_by_chance(
    slot: float, both: bool, chance: float, side: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of speeds of which 3 % of the rows were missing an eccentric disc was named with certainty, and there is none."""
    runs, least = 101, 5.0
    data = SimpleNamespace(slot=slot, counts_both_ways=both, gear=1.0, time=np.arange(runs + 1.0))
    data.first, data.last, data.duration = np.arange(runs), np.arange(1, runs + 1), np.ones(runs)
    track = SimpleNamespace(at=lambda time: time, run_at=lambda time: np.arange(runs), slipped=lambda slips: None)
    problem = SimpleNamespace(intervals=(data,))
    bare = cast(Estimate, SimpleNamespace(problem=problem, increments=(np.zeros(runs),)))
    explained = side * (chance * (runs - 1) + least)
    aligned = Aligned(0.01 + 0j, np.zeros(runs), explained)
    white = Whitening(np.ones(runs, dtype=bool), np.zeros(runs), np.ones(runs))
    monkeypatch.setattr(periodic_fit, "estimate_noise", lambda _: Noise(0.0, 0.0))
    monkeypatch.setattr(periodic_fit, "make_noise", lambda *_: None)
    monkeypatch.setattr(periodic_fit, "make_whitening", lambda *_: white)
    monkeypatch.setattr(periodic_fit, "align_wave", lambda *_: aligned)
    start = periodic_fit._start_eccentricity(bare, (cast(Track, track),), least)
    assert (start is not None) is (side > 1.0)
    assert periodic_fit._start_eccentricity(bare, (cast(Track, track),), 0.0) is not None  # asked for by name


TORQUE = {"random_torque": 0.1, "random_torque_time": 0.05, "random_torque_seed": 3.0}


def test_counted_runs_are_aligned_by_the_wave_of_an_eccentric_disc() -> None:
    """A swing about a standstill loses slots: the wave itself tells how many, beside a torque's noise."""
    random, slot, size = np.random.default_rng(5), 2.0 * np.pi / 96, 0.02
    run = np.repeat(np.arange(6), 192)
    counted = np.arange(len(run) + 1) * slot
    slips = np.array([0.0, 2.0, 5.0, 4.0, 7.0, 9.0])
    true = counted[:-1] + slips[run] * slot
    shown = size * (np.sin(true + slot + 0.7) - np.sin(true + 0.7)) + random.normal(0.0, 1e-4, len(run))
    data = cast(Intervals, SimpleNamespace(slack=np.zeros(len(run)), slot=slot, gear=1.0, counts_both_ways=False))
    aligned = align_wave(np.diff(np.sin(counted)), np.diff(np.cos(counted)), shown, run, data)
    assert abs(aligned.weight) == pytest.approx(size, rel=0.02)
    assert (aligned.slips - aligned.slips[0]) / slot == pytest.approx(slips, abs=0.5 + 1e-9)
    still = replace_slack(data)
    assert align_wave(np.diff(np.sin(counted)), np.diff(np.cos(counted)), shown, run, still).weight == 0.0


def replace_slack(data: Intervals) -> Intervals:
    """The same intervals, in none of which an edge came."""
    return cast(Intervals, SimpleNamespace(**(vars(data) | {"slack": np.full(len(data.slack), data.slot)})))


def test_a_ripple_beside_a_random_torque_that_is_slower_and_stronger() -> None:
    hidden = {"ripple_voltage": 0.2, "ripple_cycles": 7.4, "ripple_phase": 0.3}
    bare, _ = without_ripple(made(hidden | TORQUE, profiles.staircase(9.0, 3, 0.5), 2), BASE)
    tracks = measure_angles(bare, bare.problem.unknowns.effects)
    ripple = find_ripples(bare, tracks)[0]
    assert ripple.cycles == pytest.approx(7.4, abs=0.02) and ripple.amplitude == pytest.approx(0.2, rel=0.2)
