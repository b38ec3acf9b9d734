"""Effects periodic in the angle: added to a fit of all others, on measured angles, from where their spectrum points."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from motor_identification.estimation.direction_correction import redirected
from motor_identification.estimation.least_squares import Speeds, descend, gains
from motor_identification.estimation.parameter_space import carried
from motor_identification.estimation.problem import Problem
from motor_identification.measurement.measured_angle import Track
from motor_identification.periodic.ripple_spectrum import ripple_of, ripples
from motor_identification.periodic.simulated_angle_fit import adrift
from motor_identification.recording import Floats
from motor_model.effects import EFFECT_BY_NAME

ROUNDS = 2  # the second time, the motor that bridges the gaps of the measured angle has the effect already
ITERATIONS = 25  # of a descent

Tracks = tuple[Track, ...]
Start = tuple[Tracks, Mapping[str, Floats]]  # measured angles, and an effect's values in every recording


def without_periodic(effects: tuple[str, ...]) -> tuple[str, ...]:
    """The effects that do not repeat with the angle."""
    return tuple(name for name in effects if not EFFECT_BY_NAME[name].periodic)


def add_periodic(problem: Problem, place: Floats, effects: tuple[str, ...]) -> tuple[Problem, Floats, int]:
    """Extend a fit without periodic effects, its problem and place (D,), by those among `effects`; and simulations."""
    evaluations = 0
    for effect in _STARTS:
        if effect in effects:
            larger = added(problem, place, effect)
            if larger is not None:
                problem, place, more = larger
                evaluations += more
    return problem, place, evaluations


def added(bare: Problem, place: Floats, effect: str, least: float = 0.0) -> tuple[Problem, Floats, int] | None:
    """Extend a fit by one periodic effect; with `least`, None where nothing speaks for it.

    That is where its spectrum promises less than `least` squared standard deviations, or a fit on measured angles gains
    nothing. From there it is fitted on the simulated angle, and once more where the spectrum then points elsewhere.
    """
    effects, evaluations = (*bare.unknowns.effects, effect), 0
    choices: list[tuple[float, Problem, Floats]] = []
    tracks = bare.anchored(place, effects).tracks
    before, without = np.inf, bare.cost(place)  # number of cycles that was tried; cost without the effect
    promise = least
    for _ in range(ROUNDS):
        begin = _STARTS[effect](bare, place, tracks, promise)
        if begin is None:
            break
        tracks, values = begin
        cycles = float(values.get("ripple_cycles", np.array(1.0)))
        if abs(cycles - before) * _turned(tracks) < 1.0:  # the same line again
            break
        before, promise = cycles, 0.0
        trial = replace(bare.with_effects(effects), tracks=tracks)
        start = carried(bare.unknowns, place, trial.unknowns, values)
        end, more = descend(trial, Speeds(trial), start, iterations=ITERATIONS, tolerance=1e-8)
        evaluations += more
        if least > 0.0 and not gains(without, trial.cost(end), len(trial.weight)):
            break
        mended = carried(bare.unknowns, carried(trial.unknowns, end, bare.unknowns, {}), trial.unknowns, values)
        held = redirected(trial, end)
        loose, there, more = adrift(replace(held, tracks=()), effect, (start, mended), _turned(tracks))
        evaluations += more
        choices += [(one.cost(at), one, at) for one, at in ((held, end), (loose, there))]
        _cost, best, end = min(choices, key=lambda one: one[0])
        bare = replace(bare, intervals=best.intervals, tracks=best.tracks if bare.tracks else ())
        place, tracks = carried(best.unknowns, end, bare.unknowns, {}), best.anchored(end, effects).tracks
    if not choices:
        return None
    _cost, best, end = min(choices, key=lambda one: one[0])
    return best, end, evaluations


def _turned(tracks: Tracks) -> float:
    """[rad] how far the shaft turned."""
    return max(float(np.ptp(track.angle)) for track in tracks)


def phases(bare: Problem, place: Floats, effect: str, cycles: float, tracks: Tracks = ()) -> Start:
    """Measured angles and phases under which a known periodic effect fits recordings best; see `added`.

    Without `tracks` a motor that lacks the effect bridges the gaps of the measured angle.
    """
    tracks = tracks or bare.anchored(place, bare.unknowns.effects).tracks
    if effect == "torque_ripple":
        ripple = ripple_of(bare, place, tracks, cycles)
        return ripple.tracks, {"ripple_phase": np.array(ripple.phases)}
    tracks, wave = _eccentricity(bare, place, tracks, 0.0)
    return tracks, {"eccentricity_phase": wave["eccentricity_phase"]}


def _eccentricity(problem: Problem, place: Floats, tracks: Tracks, _least: float) -> Start:
    """The first harmonic of what a fit leaves over the angle, by least squares."""
    waves = []
    for data, track, increments in zip(problem.intervals, tracks, problem.increments(place), strict=True):
        angle, root = track.at(data.time), 1.0 / np.sqrt(data.duration)
        sine, cosine = (
            np.diff(shape(angle)[np.stack([data.first, data.last])], axis=0)[0] for shape in (np.sin, np.cos)
        )
        moving = data.slack == 0.0
        design = (np.column_stack([sine, cosine]) * root[:, None])[moving]
        waves.append(complex(*np.linalg.lstsq(design, -(increments * root)[moving], rcond=None)[0]))
    size = np.full(len(waves), np.mean(np.abs(waves)))
    return tracks, {"eccentricity": size, "eccentricity_phase": np.asarray(np.angle(waves), dtype=np.float64)}


def _ripple(problem: Problem, place: Floats, tracks: Tracks, least: float) -> Start | None:
    """The best line of the spectrum, if there is one."""
    lines = ripples(problem, place, tracks, least)
    if not lines:
        return None
    values = {"ripple_voltage": np.array(lines[0].amplitude), "ripple_cycles": np.array(lines[0].cycles)}
    return lines[0].tracks, {**values, "ripple_phase": np.array(lines[0].phases)}


_STARTS = {"encoder_eccentricity": _eccentricity, "torque_ripple": _ripple}
