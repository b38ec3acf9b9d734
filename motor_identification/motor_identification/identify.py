"""Identify a motor: multi-start search over the whole box, least squares from there, and how sure the result is."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from time import perf_counter

from motor_identification.estimation.direction_correction import correct_directions
from motor_identification.estimation.kv_split import split_kv_if_needed
from motor_identification.estimation.miscounts import exclude_miscounts
from motor_identification.estimation.problem import Problem, make_problem
from motor_identification.estimation.request import PhysicalRequest, Request, SearchConfig, SearchReport
from motor_identification.estimation.search.global_search import search_globally
from motor_identification.estimation.whitened_fit import WhitenedFit, fit_whitened
from motor_identification.measurement.request_checks import check_effects
from motor_identification.periodic.periodic_fit import add_periodic_effects, drop_periodic_effects
from motor_identification.physical.known_resistance import convert_with_resistance
from motor_identification.physical.measured_current import identify_with_current
from motor_identification.progress import Heartbeat
from motor_identification.recording import Recording
from motor_identification.sensor.description import note_sensors
from motor_identification.sensor.pulses.missed_edges import average_shares
from motor_identification.timing.speed_timing import find_timing
from motor_identification.uncertainty.result import Fit
from motor_identification.uncertainty.summary import summarise_fit
from motor_model.effects import normalised
from motor_model.errors import RecordingError
from motor_model.program.memory import ask_for_room

__all__ = ["Request", "SearchConfig", "identify"]

Progress = Callable[[str, float], None]  # what is being done, share done 0 to 1

ROOM = 192 * 2**20  # [bytes] half a minute at 200 Hz on two cores fits in 230 MiB beside the imports, not in 140
SEARCHED, DESCENDED = 0.5, 0.9  # of the progress bar
MISCOUNTED = "{} of {} intervals were left out: off by whole slots (edges missed or counted twice)."
MISSED = "{:.2%} ± {:.2%} of all edges were missed: only those that follow each other were compared."
UNFINISHED = (
    "The search ended after {} simulations, before independent starts agreed ({} of {} did): raise epochs or "
    "particles, or compare another seed."
)
OUTLYING = "{} of {} intervals were left out: they contradict their neighbours (wrong stamp, unseen reversal)."


def identify(recordings: Sequence[Recording], request: Request, progress: Progress | None = None) -> Fit:
    """Fit kv, ka and the requested effects to checked recordings of one motor.

    Raises:
        ModelError: an effect is not in the table, or no fit of these recordings can have it.
        NotEnoughMemory: a fit has no room.
        RecordingError: the recording cannot answer.
    """
    begun = perf_counter()
    if not recordings:
        raise RecordingError("there is no recording to fit: name at least one bag.")
    ask_for_room(ROOM)
    tell = progress or (lambda stage, share: None)
    working = Heartbeat(tell)
    recordings = note_sensors(recordings)
    check_effects(request.effects)
    effects = normalised(request.effects)
    whole = make_problem(recordings, drop_periodic_effects(effects), request.workers, working)
    estimate, search = search_globally(whole, request.search, lambda share: tell("search", SEARCHED * share))
    timing = find_timing(recordings, estimate, beside=effects, lagging=True)
    if timing is not None:
        recordings = timing.set_on(recordings)
        whole = make_problem(recordings, drop_periodic_effects(effects), request.workers, working)
        estimate, search = search_globally(whole, request.search)
    working.begin("least squares", SEARCHED, DESCENDED)
    directed = add_periodic_effects(correct_directions(estimate), effects)
    counted = exclude_miscounts(directed)
    working.begin("standard errors", DESCENDED, 1.0)
    fit = fit_whitened(counted)
    if request.physical is None:  # else that says what of kv is back-EMF
        fit = split_kv_if_needed(fit)
    notes = (*_list_left_out(directed.problem, counted.problem, fit.problem), *_list_doubts(search))

    def summarise(one: WhitenedFit) -> Fit:
        return summarise_fit(one, search, lambda: perf_counter() - begun, notes, effects)

    result = replace(_add_physics(fit, summarise, request.physical), timing=timing)
    tell("done", 1.0)
    return result


def _add_physics(fit: WhitenedFit, summarise: Callable[[WhitenedFit], Fit], request: PhysicalRequest | None) -> Fit:
    """Summarise a fit, and what was asked for in ohms and newton-metres."""
    if request is None:
        return summarise(fit)
    if request.resistance:
        return convert_with_resistance(summarise(fit), request)
    return identify_with_current(fit, summarise)


def _list_left_out(whole: Problem, counted: Problem, kept: Problem) -> list[str]:
    """List what was not used, in sentences."""
    total, miscounted = len(whole.weight), len(whole.weight) - len(counted.weight)
    outliers = len(counted.weight) - len(kept.weight)
    rows = ((MISCOUNTED, miscounted), (OUTLYING, outliers))
    missed = average_shares([data.missed for data in whole.intervals])
    notes = [] if missed is None else [MISSED.format(missed.share, missed.error)]
    return notes + [text.format(number, total) for text, number in rows if number]


def _list_doubts(search: SearchReport) -> list[str]:
    """A sentence if the search ended for want of simulations."""
    return [] if search.agreed else [UNFINISHED.format(search.evaluations, search.agreeing, len(search.descents))]
