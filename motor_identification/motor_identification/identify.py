"""Identification: particle swarm over the whole box, least squares from its best place, and how sure the result is."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np

from motor_identification.descent import Speeds, descend
from motor_identification.direction import redirected
from motor_identification.missed import find_miscounted
from motor_identification.problem import Problem, make_problem
from motor_identification.recording import Floats, Recording
from motor_identification.refine import Refined, learn
from motor_identification.statistics import certainty, not_told_apart
from motor_identification.swarm import SwarmConfig, minimise
from motor_model.effects import EFFECT_BY_NAME, SPEC_BY_NAME
from motor_model.errors import MotorError, RecordingError
from motor_model.parameters import Parameters

Progress = Callable[[str, float], None]  # what is being done, share done 0 to 1

COARSE = 0.02  # [s] length of the intervals that the swarm compares
ENOUGH = 1e-3  # relative improvement per epoch below which the swarm hands over to least squares
PATIENCE = 25  # epochs without such an improvement
CLEANINGS = 8  # rounds at most of leaving out miscounted intervals: each makes the next easier to see
MISCOUNTED = "{} of {} intervals are off by whole slots (edges missed or counted twice) and were left out."
OUTLYING = "{} of {} intervals contradict their neighbours (a wrong stamp, an unseen reversal) and were left out."
ON_BOUND = 1e-4  # of the box


@dataclass(frozen=True)
class Request:
    """What to fit and how hard to search.

    Raises:
        MotorError: a number that no search can do with.
    """

    effects: tuple[str, ...] = ()
    particles: int = 50
    epochs: int = 200
    seed: int = 0
    workers: int = 1

    def __post_init__(self) -> None:
        if self.particles < 2 or self.epochs < 1 or self.seed < 0:
            raise MotorError("particles must be at least 2, epochs at least 1, and the seed not negative.")


@dataclass(frozen=True)
class Fit:
    """An identified motor and how far it is to be trusted; dictionaries are by parameter name."""

    parameters: Parameters
    standard_errors: dict[str, float]  # NaN where not identifiable
    on_bound: dict[str, bool]
    not_identifiable: tuple[str, ...]
    not_told_apart: dict[str, tuple[str, ...]]  # fitted effect → absent effects with the same trace
    suggested_experiment: str  # a profile, or empty
    residual_rms: float  # [rad/s] time-weighted, of simulated − measured mean speed
    noise_floor: float  # [rad/s] what timer tick (or count quantisation) and irregular slots alone leave
    r_squared: float
    slot_irregularity: tuple[float, ...]  # of every recording's disc, as a share of a slot; NaN where it has none
    start_speeds: tuple[float, ...]  # [rad/s] of every recording
    trace: Floats  # [rad/s] best RMS after each epoch of the swarm
    evaluations: int
    duration: float  # [s]
    uris: tuple[str, ...]
    notes: tuple[str, ...]


def identify(recordings: Sequence[Recording], request: Request, progress: Progress | None = None) -> Fit:
    """Fit kv, ka and the requested effects to checked recordings of one motor.

    Raises:
        ModelError: an effect is not in the table.
        RecordingError: the recording cannot answer.
    """
    begun = perf_counter()
    if not recordings:
        raise RecordingError("there is no recording to fit: name at least one bag.")
    tell = progress or (lambda stage, share: None)
    whole = make_problem(recordings, request.effects, request.workers)
    config = SwarmConfig(request.particles, request.epochs, request.seed, stall=PATIENCE, tolerance=ENOUGH)
    swarm = minimise(
        whole.coarse(COARSE).costs,
        whole.unknowns.low,
        whole.unknowns.high,
        config,
        lambda epoch, cost: tell("swarm", 0.9 * epoch / request.epochs),
    )
    tell("least squares", 0.9)
    place, evaluations = descend(whole, Speeds(whole), swarm.place)
    directed = redirected(whole, place)
    place, counted, more = _without_miscounted(directed, place)
    tell("least squares", 0.95)
    refined, place, most = _refined(counted, place)
    fit = _judge(refined, place, np.sqrt(swarm.trace), swarm.evaluations + evaluations + more + most, begun)
    tell("done", 1.0)
    return replace(fit, notes=(*fit.notes, *_left_out(directed, counted, refined.problem)))


def _without_miscounted(problem: Problem, place: Floats) -> tuple[Floats, Problem, int]:
    """Fit mean speeds, leave out what is off by whole slots, and again: the place, what was kept, simulations."""
    evaluations = 0
    for _ in range(CLEANINGS):
        place, more = descend(problem, Speeds(problem), place)
        evaluations += more
        bad = find_miscounted(problem, place)
        if not any(marks.any() for marks in bad):
            break
        problem = problem.without(bad)
    return place, problem, evaluations


def _refined(problem: Problem, place: Floats) -> tuple[Refined, Floats, int]:
    """Learn the encoder from the residuals, fit white residuals, and again, without outliers."""
    evaluations = 0
    for last in (False, False, True):
        refined = Refined(problem, learn(problem, place))
        place, more = descend(problem, refined, place)
        evaluations += more
        far = refined.outliers(place)
        if not last and any(marks.any() for marks in far):
            problem = problem.without(far)
    return refined, place, evaluations


def _left_out(whole: Problem, counted: Problem, kept: Problem) -> list[str]:
    """What was not used, in sentences."""
    total, miscounted = len(whole.weight), len(whole.weight) - len(counted.weight)
    outliers = len(counted.weight) - len(kept.weight)
    rows = ((MISCOUNTED, miscounted), (OUTLYING, outliers))
    return [text.format(number, total) for text, number in rows if number]


def _judge(refined: Refined, place: Floats, trace: Floats, evaluations: int, begun: float) -> Fit:
    """Everything a user should know about a fitted place."""
    problem = refined.problem
    unknowns, weight, speed = problem.unknowns, problem.weight, problem.speed
    jacobian = refined.jacobian(place)
    sure = certainty(refined, place, jacobian)
    alike = not_told_apart(refined, place, jacobian, sure)
    cost = float(problem.costs(place[None])[0])
    span = unknowns.high - unknowns.low
    at_wall = (place - unknowns.low < ON_BOUND * span) | (unknowns.high - place < ON_BOUND * span)
    bounds = {name: bool(at_wall[i]) and _is_a_wall(name, at_low=place[i] < 0.5 * (unknowns.low + unknowns.high)[i])
              for i, name in enumerate(unknowns.names)}  # fmt: skip
    variance = float(np.sum(weight * (speed - np.sum(weight * speed)) ** 2))
    return Fit(
        parameters=unknowns.parameters(place, problem.recordings[0].info.name),
        standard_errors=unknowns.value_errors(place, sure.errors),
        on_bound=bounds,
        not_identifiable=sure.not_identifiable,
        not_told_apart=alike,
        suggested_experiment=_suggestion(sure.not_identifiable, alike),
        residual_rms=float(np.sqrt(cost)),
        noise_floor=refined.noise_floor,
        r_squared=1.0 - cost / variance if variance > 1e-18 * float(np.max(speed**2)) else float("nan"),
        slot_irregularity=tuple(encoder.irregularity for encoder in refined.encoders),
        start_speeds=tuple(float(v) for v in unknowns.decode(place[None])[1][0]),
        trace=trace,
        evaluations=evaluations,
        duration=perf_counter() - begun,
        uris=tuple(recording.uri for recording in problem.recordings),
        notes=tuple(note for recording in problem.recordings for note in recording.notes),
    )


def _is_a_wall(name: str, at_low: bool) -> bool:
    """A parameter at the value where its effect vanishes is an answer, not the edge of the search."""
    spec = SPEC_BY_NAME[name]
    return not (at_low and spec.low == spec.off)


def _suggestion(not_identifiable: tuple[str, ...], alike: dict[str, tuple[str, ...]]) -> str:
    """The profile that would show what this recording cannot; empty if nothing is open."""
    for effect in EFFECT_BY_NAME.values():
        if any(spec.name in not_identifiable for spec in effect.parameters):
            return effect.shown_by
    if not_identifiable:
        return "staircase"
    profiles = {EFFECT_BY_NAME[rival].shown_by for rivals in alike.values() for rival in rivals}
    return profiles.pop() if len(profiles) == 1 else "rich" if profiles else ""
