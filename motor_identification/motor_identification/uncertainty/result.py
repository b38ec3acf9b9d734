"""What an identification returns: a motor, how sure each of its numbers is, and all that limits them."""

from dataclasses import dataclass

import numpy as np

from motor_identification.estimation.whitened_fit import Refined
from motor_identification.recording import Floats
from motor_identification.uncertainty.identifiability import not_told_apart, telling_apart
from motor_identification.uncertainty.recording_consistency import dissents, sentence_of
from motor_identification.uncertainty.standard_errors import certainty
from motor_identification.uncertainty.whiteness import Whiteness
from motor_model.effects import EFFECT_BY_NAME, SPEC_BY_NAME
from motor_model.parameters import Parameters

ON_BOUND = 1e-4  # of the box


@dataclass(frozen=True)
class SearchReport:
    """How the global search went."""

    trace: Floats  # [rad/s] best RMS after each epoch of a swarm and each descent
    swarms: int  # each from a seed of its own
    descents: int
    agreeing: int  # descents that ended at the best cost
    agreed: bool  # whether the search ended because of that; else it had used up its simulations


@dataclass(frozen=True)
class Fit:
    """An identified motor and how far it is to be trusted; dictionaries are by parameter name."""

    parameters: Parameters
    standard_errors: dict[str, float]  # NaN where not identifiable; ±1.96 of them cover 95 %
    correlations: dict[str, dict[str, float]]  # of the errors of two parameters; NaN where one is not identifiable
    on_bound: dict[str, bool]
    not_identifiable: tuple[str, ...]
    not_told_apart: dict[str, tuple[str, ...]]  # fitted effect → absent effects with the same trace
    suggested_experiment: str  # a profile, or empty
    residual_rms: float  # [rad/s] time-weighted, of simulated − measured mean speed
    noise_floor: float  # [rad/s] what timer tick (or count quantisation) and irregular slots alone leave
    r_squared: float
    whiteness: Whiteness  # of the residuals
    slot_irregularity: tuple[float, ...]  # of every recording's disc, as a share of a slot; NaN where it has none
    start_speeds: tuple[float, ...]  # [rad/s] of every recording
    search: SearchReport
    evaluations: int  # simulations of one motor through all recordings
    duration: float  # [s]
    uris: tuple[str, ...]
    notes: tuple[str, ...]


def judge(refined: Refined, place: Floats, search: SearchReport, evaluations: int) -> Fit:
    """Everything a user should know about a fitted place (D,), but for how long it took."""
    problem = refined.problem
    unknowns, weight, speed = problem.unknowns, problem.weight, problem.speed
    jacobian = refined.jacobian(place)
    sure = certainty(refined, place, jacobian)
    alike = not_told_apart(refined, place, jacobian, sure.errors, sure.not_identifiable)
    cost = problem.cost(place)
    span = unknowns.high - unknowns.low
    at_wall = (place - unknowns.low < ON_BOUND * span) | (unknowns.high - place < ON_BOUND * span)
    bounds = {name: bool(at_wall[i]) and _is_a_wall(name, at_low=place[i] < 0.5 * (unknowns.low + unknowns.high)[i])
              for i, name in enumerate(unknowns.names)}  # fmt: skip
    variance = float(np.sum(weight * (speed - np.sum(weight * speed)) ** 2))
    return Fit(
        parameters=unknowns.parameters(place, problem.recordings[0].info.name),
        standard_errors=unknowns.value_errors(place, sure.errors),
        correlations=sure.correlations_of(unknowns.names),
        on_bound=bounds,
        not_identifiable=sure.not_identifiable,
        not_told_apart=alike,
        suggested_experiment=_suggestion(sure.not_identifiable, alike),
        residual_rms=float(np.sqrt(cost)),
        noise_floor=refined.noise_floor,
        r_squared=1.0 - cost / variance if variance > 1e-18 * float(np.max(speed**2)) else float("nan"),
        whiteness=sure.whiteness,
        slot_irregularity=tuple(encoder.irregularity for encoder in refined.encoders),
        start_speeds=tuple(float(v) for v in unknowns.decode(place[None])[1][0]),
        search=search,
        evaluations=evaluations,
        duration=0.0,
        uris=tuple(recording.uri for recording in problem.recordings),
        notes=(
            *(note for recording in problem.recordings for note in recording.notes),
            *(sentence_of(one) for one in dissents(refined, place) if one.disagrees),
        ),
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
    return telling_apart(rival for rivals in alike.values() for rival in rivals)
