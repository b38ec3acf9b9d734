"""Identification: particle swarm over the whole box, least squares from its best place, and how sure the result is."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np

from motor_identification.estimation.direction_correction import redirected
from motor_identification.estimation.excerpt import excerpt
from motor_identification.estimation.least_squares import Speeds, descend
from motor_identification.estimation.miscounts import cleaned
from motor_identification.estimation.multistart import Found, SearchConfig, search
from motor_identification.estimation.objective import landscape_of
from motor_identification.estimation.problem import Problem, make_problem
from motor_identification.estimation.whitened_fit import refine
from motor_identification.measurement.request_checks import refuse_nonsense
from motor_identification.periodic.periodic_fit import add_periodic, without_periodic
from motor_identification.recording import Floats, Recording
from motor_identification.uncertainty.result import Fit, SearchReport, judge
from motor_model.effects import normalised
from motor_model.errors import MotorError, RecordingError

Progress = Callable[[str, float], None]  # what is being done, share done 0 to 1

COARSE = 0.02  # [s] length of the intervals that the swarm compares
MISCOUNTED = "{} of {} intervals were left out: off by whole slots (edges missed or counted twice)."
UNFINISHED = (
    "The search ended after {} simulations, before independent starts agreed ({} of {} did): raise epochs or "
    "particles, or compare another seed."
)
OUTLYING = "{} of {} intervals were left out: they contradict their neighbours (wrong stamp, unseen reversal)."


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


def identify(recordings: Sequence[Recording], request: Request, progress: Progress | None = None) -> Fit:
    """Fit kv, ka and the requested effects to checked recordings of one motor.

    Raises:
        ModelError: an effect is not in the table, or no fit of these recordings can have it.
        RecordingError: the recording cannot answer.
    """
    begun = perf_counter()
    if not recordings:
        raise RecordingError("there is no recording to fit: name at least one bag.")
    tell = progress or (lambda stage, share: None)
    refuse_nonsense(recordings, request.effects)
    effects = normalised(request.effects)
    whole = make_problem(recordings, without_periodic(effects), request.workers)
    found, place, evaluations = searched(whole, request, lambda share: tell("search", 0.8 * share))
    tell("least squares", 0.8)
    directed = redirected(whole, place)
    directed, place, more = add_periodic(directed, place, effects)
    evaluations += more
    counted, place, more = cleaned(directed, place)
    evaluations += more
    tell("least squares", 0.9)
    refined, place, more = refine(counted, place)
    fit = judge(refined, place, report_of(found), evaluations + more)
    tell("done", 1.0)
    notes = (*fit.notes, *_left_out(directed, counted, refined.problem), *_unfinished(found))
    return replace(fit, notes=notes, duration=perf_counter() - begun)


def report_of(found: Found) -> SearchReport:
    """How a global search went."""
    return SearchReport(np.sqrt(found.trace), found.swarms, len(found.descents), found.agreeing, found.agreed)


def searched(whole: Problem, request: Request, progress: Callable[[float], None]) -> tuple[Found, Floats, int]:
    """The whole box searched on an excerpt of joined intervals, then least squares on everything."""
    coarse = whole.coarse(COARSE)
    searched = excerpt(coarse)
    found = search(landscape_of(searched), SearchConfig(request.particles, request.epochs, request.seed), progress)
    place, evaluations = found.place, found.evaluations
    if searched is not coarse:  # the rest of the way is shorter from the pieces' own best place
        place, more = descend(searched, Speeds(searched), place)
        evaluations += more
    place, more = descend(whole, Speeds(whole), place)
    return found, place, evaluations + more


def _left_out(whole: Problem, counted: Problem, kept: Problem) -> list[str]:
    """What was not used, in sentences."""
    total, miscounted = len(whole.weight), len(whole.weight) - len(counted.weight)
    outliers = len(counted.weight) - len(kept.weight)
    rows = ((MISCOUNTED, miscounted), (OUTLYING, outliers))
    return [text.format(number, total) for text, number in rows if number]


def _unfinished(found: Found) -> list[str]:
    """A sentence if the search ended for want of simulations."""
    return [] if found.agreed else [UNFINISHED.format(found.evaluations, found.agreeing, len(found.descents))]
