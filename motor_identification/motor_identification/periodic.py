"""Effects periodic in the angle: added to a fit of all others, on measured angles, from where their spectrum points."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from motor_identification.descent import Speeds, descend, typical
from motor_identification.direction import redirected
from motor_identification.problem import Problem
from motor_identification.recording import Floats
from motor_identification.ripple import ripple_of, ripples
from motor_identification.track import Track
from motor_identification.unknowns import carried
from motor_model.effects import EFFECT_BY_NAME

ROUNDS = 2  # the second time, the motor that bridges the gaps of the measured angle has the effect already
ITERATIONS = 25  # of a descent
RIPPLES = 2  # lines of the spectrum that are tried
SIZES, PHASES, TURNS = (1.0, 1.3, 1.6), 12, 3  # of a ripple that is followed on the simulated angle

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
    """Extend a fit by one periodic effect; None where its spectrum promises less than `least`.

    That is in squared standard deviations.
    """
    effects, evaluations = (*bare.unknowns.effects, effect), 0
    choices: list[tuple[Problem, Floats]] = []
    full, end = bare.anchored(place, effects), place
    for _ in range(ROUNDS):
        ends = []
        starts = _STARTS[effect](bare, place, full.tracks, least)
        if not starts:
            return None
        if effect == "torque_ripple" and not choices:
            adrift, there, more = _adrift(bare, place, starts[0][1])
            choices.append((adrift, there))
            evaluations += more
        least = 0.0
        for tracks, values in starts:
            trial = replace(full, tracks=tracks)
            start = carried(bare.unknowns, place, full.unknowns, values)
            end, more = descend(trial, Speeds(trial), start, iterations=ITERATIONS, tolerance=1e-8)
            ends.append((float(trial.costs(end[None])[0]), trial, end))
            evaluations += more
        _cost, best, end = min(ends, key=lambda row: row[0])
        best = redirected(best, end)
        place = carried(best.unknowns, end, bare.unknowns, {})
        bare = replace(bare, intervals=best.intervals, tracks=best.tracks if bare.tracks else ())
        full = best.anchored(end, effects)
    free = replace(best, tracks=())  # a complete model does not drift, and then its own angle is the better one
    onward, more = descend(free, Speeds(free), end, iterations=ITERATIONS, tolerance=1e-10)
    evaluations += more
    choices += [(best, end), (free, onward)]
    best, end = min(choices, key=lambda one: float(one[0].costs(one[1][None])[0]))
    return best, end, evaluations


def _adrift(bare: Problem, place: Floats, values: Mapping[str, Floats]) -> tuple[Problem, Floats, int]:
    """A ripple on the simulated angle: what the shaft does where no edge comes, only a simulation of it can follow.

    Such as the swings of a motor without friction at every standstill, or the blocks that are kept out of a fit. Its
    phase is searched there, and its size anew, whichever way the shaft turned; then directions and fit in turns.
    """
    free = bare.with_effects((*bare.unknowns.effects, "torque_ripple"))
    grid = [
        carried(bare.unknowns, place, free.unknowns, {**values, "ripple_voltage": size * values["ripple_voltage"],
                                                      "ripple_phase": 0.0 * values["ripple_phase"] + phase})
        for size in SIZES
        for phase in np.linspace(-np.pi, np.pi, PHASES, endpoint=False)
    ]  # fmt: skip
    residuals = free.evaluate(np.array(grid))
    either_way = np.minimum(np.abs(residuals), np.abs(residuals + 2.0 * free.speed))
    most = 3.0 * float(np.median(np.abs(bare.residuals(place))))
    there = grid[int(np.argmin(np.minimum(either_way, most) ** 2 @ free.weight))]
    evaluations = len(grid)
    for _ in range(TURNS):
        free = redirected(free, there)
        most = typical(free, there)[1]
        there, more = descend(free, Speeds(free), there, most=most, iterations=ITERATIONS, tolerance=1e-6)
        evaluations += more
    free = redirected(free, there)
    there, more = descend(free, Speeds(free), there, iterations=ITERATIONS, tolerance=1e-8)
    return free, there, evaluations + more


def phases(bare: Problem, place: Floats, effect: str, cycles: float, tracks: Tracks = ()) -> Start:
    """Measured angles and phases under which a known periodic effect fits recordings best; see `added`.

    Without `tracks` a motor that lacks the effect bridges the gaps of the measured angle.
    """
    tracks = tracks or bare.anchored(place, bare.unknowns.effects).tracks
    if effect == "torque_ripple":
        ripple = ripple_of(bare, place, tracks, cycles)
        return ripple.tracks, {"ripple_phase": np.array(ripple.phases)}
    ((tracks, wave),) = _eccentricities(bare, place, tracks, 0.0)
    return tracks, {"eccentricity_phase": wave["eccentricity_phase"]}


def _eccentricities(problem: Problem, place: Floats, tracks: Tracks, _least: float) -> list[Start]:
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
    return [(tracks, {"eccentricity": size, "eccentricity_phase": np.asarray(np.angle(waves), dtype=np.float64)})]


def _ripples(problem: Problem, place: Floats, tracks: Tracks, least: float) -> list[Start]:
    return [
        (
            ripple.tracks,
            {
                "ripple_voltage": np.array(ripple.amplitude),
                "ripple_cycles": np.array(ripple.cycles),
                "ripple_phase": np.array(ripple.phases),
            },
        )
        for ripple in ripples(problem, place, tracks, least)[:RIPPLES]
    ]


_STARTS = {"encoder_eccentricity": _eccentricities, "torque_ripple": _ripples}
