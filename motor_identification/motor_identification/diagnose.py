"""Diagnosis: find which effects are missing from a motor's model, one after the other, until nothing is missing.

Each step tries every effect of the table on top of the model, with all parameters fitted again (a wrong parameter eats
missing physics), and takes the one under which held-out motion is most likely (`evidence.py`), if it is likely enough
not to be a false alarm and explains enough of the gap. Afterwards every finding has to hold its own beside the others.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from time import perf_counter

from motor_identification.diagnosis.backward_elimination import needed, without_stand_ins
from motor_identification.diagnosis.forward_selection import Way, by_another_way, climbed, settled
from motor_identification.diagnosis.result import Diagnosis
from motor_identification.diagnosis.verdict import concluded
from motor_identification.estimation.problem import make_problem
from motor_identification.identify import Request, report_of, searched
from motor_identification.measurement.request_checks import refuse_nonsense
from motor_identification.periodic.periodic_fit import add_periodic, without_periodic
from motor_identification.progress import Stage, Stopped, Telling
from motor_identification.recording import Recording
from motor_identification.uncertainty.result import SearchReport
from motor_identification.validation.held_out import HeldOut, Kept, keep_out, spared
from motor_model.effects import normalised
from motor_model.errors import RecordingError

__all__ = ["Stage", "Stopped", "diagnose"]


def diagnose(
    recordings: Sequence[Recording],
    validation: Sequence[Recording] = (),
    known: tuple[str, ...] = (),
    workers: int = 1,
    progress: Callable[[Stage], None] | None = None,
    stopped: Callable[[], bool] | None = None,
) -> Diagnosis:
    """Diagnose checked recordings of one motor; without `validation` a quarter of them is kept out of every fit.

    Raises:
        ModelError: a known effect is not in the table, or no fit of these recordings can have it.
        RecordingError: a recording cannot answer.
        Stopped: `stopped` said so.
    """
    begun = perf_counter()
    if not recordings:
        raise RecordingError("there is no recording to diagnose: name at least one bag.")
    refuse_nonsense(recordings, known)
    tell = Telling(progress or (lambda stage: None), stopped or (lambda: False))
    tell("first fit", 0.0, "", float("nan"))
    kept = keep_out(recordings, validation)
    kept = replace(kept, problem=replace(kept.problem, stopped=tell.stopped))
    start, report = _first(recordings, normalised(known), kept, workers)
    way = by_another_way(climbed(start, tell), tell)
    tell("checking", 0.9, "", way.model.held.gap)
    way = needed(without_stand_ins(way), tell)
    diagnosis = concluded(start.model, way, recordings, validation, report)
    before, after = _finished(diagnosis.before), _finished(diagnosis.after)
    return replace(diagnosis, before=before, after=after, duration=perf_counter() - begun)


def _finished(held: HeldOut) -> HeldOut:
    """For others, in other processes too: there is nothing left to stop."""
    return replace(held, problem=replace(held.problem, stopped=None))


def _first(
    recordings: Sequence[Recording], known: tuple[str, ...], kept: Kept, workers: int
) -> tuple[Way, SearchReport]:
    """The model to begin with, searched globally."""
    whole = replace(make_problem(recordings, without_periodic(known), workers), stopped=kept.problem.stopped)
    if kept.same:
        whole = whole.sparing(spared)
    found, place, _evaluations = searched(whole, Request(known, workers=workers), lambda share: None)
    problem, place, _evaluations = add_periodic(replace(whole, workers=1), place, known)
    return Way((), *settled(problem, place, kept), workers), report_of(found)
