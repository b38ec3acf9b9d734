"""Add effects periodic in the angle to a fit of all others, on measured angles, from where their spectrum points."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from motor_identification.estimation.direction_correction import correct_directions
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds, improves_fit
from motor_identification.estimation.parameter_space import map_theta, set_values
from motor_identification.measurement.intervals import Intervals
from motor_identification.measurement.measured_angle import Track
from motor_identification.noise.angle_noise import make_whitening, whiten
from motor_identification.noise.likelihood import estimate_noise, make_noise
from motor_identification.noise.slots.first_harmonic import bound_chance_eccentricity
from motor_identification.periodic.angle_load import find_angle_load
from motor_identification.periodic.ripple_spectrum import (
    USUAL_RIPPLE,
    explain_runs_by_chance,
    find_ripples,
    fit_ripple,
)
from motor_identification.periodic.run_alignment import Aligned, align_runs
from motor_identification.periodic.simulated_angle_fit import fit_on_simulated_angle
from motor_identification.recording import Floats, Integers
from motor_model.effects import EFFECT_BY_NAME

PERIODIC_ROUNDS = 2  # the second time, the motor that bridges the gaps of the measured angle has the effect already
WAVE_ROUNDS = 5  # of the noise that a wave and its slips leave
ITERATIONS, TOLERANCE = 25, 1e-8  # of a descent on measured angles

LOAD_OVER_ANGLE = "torque_ripple"  # of the effects, the torque that goes with the angle

Tracks = tuple[Track, ...]


@dataclass(frozen=True)
class Start:
    """Where a periodic effect is fitted from: measured angles, its values in every recording, a motor if need be."""

    tracks: Tracks
    values: Mapping[str, Floats]
    motor: Mapping[str, Floats] = field(default_factory=dict)  # where it is another than without the effect
    is_told: bool = False  # by white residuals, of which mean speeds, of a coarse sensor's rows, may tell nothing

    @property
    def cycles(self) -> float:
        """[1/rev] of the line in the spectrum over the angle."""
        return float(self.values.get("ripple_cycles", np.array(1.0)))


def drop_periodic_effects(effects: tuple[str, ...]) -> tuple[str, ...]:
    """Drop the effects that repeat with the angle."""
    return tuple(name for name in effects if not EFFECT_BY_NAME[name].periodic)


def add_periodic_effects(estimate: Estimate, effects: tuple[str, ...]) -> Estimate:
    """Extend a fit without periodic effects by those among `effects`."""
    for effect in _STARTS:
        if effect in effects:
            estimate = add_periodic_effect(estimate, effect) or estimate
    return estimate


def add_periodic_effect(bare: Estimate, effect: str, least: float = 0.0, freely: bool = True) -> Estimate | None:
    """Extend a fit by one periodic effect; with `least`, None where nothing speaks for it.

    That is where its spectrum promises less than `least` squared standard deviations, or a fit on measured angles gains
    nothing. From there it is fitted on the simulated angle too if `freely` (beside a random torque that runs away from
    the measured one), and once more where the spectrum then points elsewhere.
    """
    effects = (*bare.problem.unknowns.effects, effect)
    fits: list[Estimate] = []
    tracks = measure_angles(bare, effects)
    cycles_before, cost_without = np.inf, bare.cost
    promise, spent = least, bare.simulations
    for _ in range(PERIODIC_ROUNDS):
        start = _STARTS[effect](bare, tracks, promise)
        if start is None or abs(start.cycles - cycles_before) * _turned(bare, start) < 1.0:  # or the same line again
            break
        cycles_before, promise = start.cycles, 0.0
        begin = _begin(replace(bare, simulations=spent), effects, start)
        held = fit_speeds(begin, iterations=ITERATIONS, tolerance=TOLERANCE)
        spent = held.simulations
        gains = start.is_told or improves_fit(cost_without, held.cost, len(held.problem.weight))
        if least > 0.0 and not gains:
            break
        fits += _fit_freely(bare, begin, held, effect, start) if freely else [correct_directions(held)]
        spent = fits[-1].simulations
        best = _best(fits)
        bare = _without_effect(bare, best)
        tracks = measure_angles(best, effects)
    return replace(_best(fits), simulations=spent) if fits else None


def add_load_once_a_turn(bare: Estimate) -> Estimate:
    """Extend a fit by a torque that goes round once a turn, however few turns there are, on measured angles."""
    effects = (*bare.problem.unknowns.effects, LOAD_OVER_ANGLE)
    load = fit_ripple(bare, measure_angles(bare, effects), 1.0)
    begin = _begin(bare, effects, Start(load.tracks, _list_values(load.amplitude, 1.0, load.phases)))
    return fit_speeds(begin, iterations=ITERATIONS, tolerance=TOLERANCE)


def _begin(bare: Estimate, effects: tuple[str, ...], start: Start) -> Estimate:
    """An estimate with more effects, not fitted yet, on measured angles."""
    trial = replace(bare.problem.with_effects(effects), tracks=start.tracks)
    theta = map_theta(bare.problem.unknowns, bare.theta, trial.unknowns, start.values)
    return Estimate(trial, set_values(trial.unknowns, theta, start.motor), bare.simulations)


def _fit_freely(bare: Estimate, begin: Estimate, held: Estimate, effect: str, start: Start) -> list[Estimate]:
    """The fit on the measured angle, with directions by its own motion, and the one on the simulated angle."""
    unknowns, without = held.problem.unknowns, bare.problem.unknowns
    mended = map_theta(without, map_theta(unknowns, held.theta, without, {}), unknowns, start.values)
    directed = correct_directions(held)
    free = directed.on(replace(directed.problem, tracks=()))
    return [directed, fit_on_simulated_angle(free, effect, (begin.theta, mended), _turned(bare, start))]


def _without_effect(bare: Estimate, best: Estimate) -> Estimate:
    """The motor without the effect, as the best fit with it has all else."""
    problem = replace(bare.problem, intervals=best.problem.intervals)
    problem = replace(problem, tracks=best.problem.tracks if problem.tracks else ())
    theta = map_theta(best.problem.unknowns, best.theta, problem.unknowns, {})
    return Estimate(problem, theta, bare.simulations)


def _best(fits: Sequence[Estimate]) -> Estimate:
    return min(fits, key=lambda fit: fit.cost)


def measure_angles(estimate: Estimate, effects: tuple[str, ...]) -> Tracks:
    """Measure the angle through every recording, its gaps bridged by an estimate, for a fit of other effects."""
    return estimate.problem.on_measured_angle(estimate.theta, effects).tracks


def _turned(bare: Estimate, start: Start) -> float:
    """[rad] how far the encoder's shaft turned."""
    return bare.problem.unknowns.gear * max(float(np.ptp(track.angle)) for track in start.tracks)


def estimate_phases(bare: Estimate, effect: str, cycles: float, tracks: Tracks = ()) -> Start:
    """Estimate measured angles and phases under which a known periodic effect fits recordings best.

    Without `tracks` a motor that lacks the effect bridges the gaps of the measured angle.
    """
    tracks = tracks or measure_angles(bare, bare.problem.unknowns.effects)
    if effect == "torque_ripple":
        ripple = fit_ripple(bare, tracks, cycles)
        return Start(ripple.tracks, {"ripple_phase": np.array(ripple.phases)})
    wave = _start_eccentricity(bare, tracks, 0.0)
    assert wave is not None
    return Start(wave.tracks, {"eccentricity_phase": wave.values["eccentricity_phase"]})


def _start_eccentricity(bare: Estimate, tracks: Tracks, least: float) -> Start | None:
    """Fit the first harmonic of what an estimate leaves over the angle, with every run's slips, by least squares.

    None where it explains no more than `least` and what so many runs, each turned as it fits best, do by chance.
    """
    waves, straightened, explained, chance = [], [], 0.0, 0.0
    for data, track, increments in zip(bare.problem.intervals, tracks, bare.increments, strict=True):
        angle, noise = data.gear * track.at(data.time), estimate_noise([(data, increments)])
        whitening = make_whitening(make_noise(data, noise.share), noise.drift)
        chance = max(chance, bound_chance_eccentricity(data.slot * data.gear, noise.share))
        shapes = (np.diff(shape(angle)[np.stack([data.first, data.last])], axis=0)[0] for shape in (np.sin, np.cos))
        sine, cosine, left = (whiten(whitening, part) for part in (*shapes, -increments))
        run = track.run_at(data.time[data.first])
        aligned = align_wave(sine, cosine, left, run, data)
        explained += aligned.explained - explain_runs_by_chance(int(run.max()), data)
        waves.append(data.gear * aligned.weight)
        straightened.append(track.slipped(aligned.slips / data.gear))
    if least > 0.0 and explained <= least:
        return None
    size = np.full(len(waves), np.mean(np.abs(waves)))
    phase = np.asarray(np.angle(waves), dtype=np.float64)
    values = {"eccentricity": size, "eccentricity_phase": phase}
    return Start(tuple(straightened), values, is_told=bool(size[0] > chance))


def align_wave(sine: Floats, cosine: Floats, left: Floats, run: Integers, data: Intervals) -> Aligned:
    """Align counted runs by a wave of one cycle a turn; noise is what it leaves, first of runs as they were counted.

    sine, cosine, left: responses and residual of every interval, shape (I,); run: the number of its run.
    """
    moving = data.slack == 0.0
    parts = np.stack([sine * sine, sine * cosine, cosine * cosine, sine * left, cosine * left])
    sums = np.stack([np.bincount(run[moving], part[moving]) for part in parts], axis=1)
    power, number = float(left[moving] @ left[moving]), max(int(np.count_nonzero(moving)), 1)
    aligned = Aligned(0j, np.zeros(len(sums)), 0.0)
    noise = power
    for _ in range(WAVE_ROUNDS):
        if noise <= 0.0:
            break
        aligned = align_runs(np.asarray(sums * (number / noise)), data.slot * data.gear, data.counts_both_ways)
        noise = power - aligned.explained * noise / number
    return aligned


def _start_ripple(bare: Estimate, tracks: Tracks, least: float) -> Start | None:
    """Find a load that is larger than ripples are, or the best line of the spectrum, if there is one."""
    load = find_angle_load(bare.problem, tracks, USUAL_RIPPLE * bare.problem.unknowns.extent.voltage)
    if load is not None:
        motor = {"kv": np.array(load.kv), "ka": np.array(load.ka)}
        return Start(tracks, _list_values(load.amplitude, 1.0, load.phases), motor)
    lines = find_ripples(bare, tracks, least)
    if not lines:
        return None
    return Start(lines[0].tracks, _list_values(lines[0].amplitude, lines[0].cycles, lines[0].phases))


def _list_values(amplitude: float, cycles: float, phases: tuple[float, ...]) -> dict[str, Floats]:
    """List the values of a ripple [V], [1/rev] and, in every recording, [rad]."""
    return {"ripple_voltage": np.array(amplitude), "ripple_cycles": np.array(cycles), "ripple_phase": np.array(phases)}


_STARTS = {"encoder_eccentricity": _start_eccentricity, "torque_ripple": _start_ripple}
