"""Summarise an identification: a motor, how sure each of its numbers is, and all that limits them."""

from collections.abc import Callable
from math import ceil, isnan, nan, sqrt

import numpy as np

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.parameter_space import Unknowns
from motor_identification.estimation.problem import Problem
from motor_identification.estimation.request import SearchReport
from motor_identification.estimation.whitened_fit import WhitenedFit
from motor_identification.recording import Floats, have_steady_states
from motor_identification.timing.held_until import describe_untold
from motor_identification.uncertainty.absence import find_absent_effects
from motor_identification.uncertainty.identifiability import find_confusable_effects, suggest_profile
from motor_identification.uncertainty.recording_consistency import compare_recordings, describe_worst_dissent
from motor_identification.uncertainty.result import Fit
from motor_identification.uncertainty.standard_errors import estimate_uncertainty
from motor_model.effect import ParameterSpec
from motor_model.effects import EFFECT_BY_NAME, SPEC_BY_NAME, VISCOUS_SHARE

WINDING = "electrical_time_constant"
MUCH_LESS = 0.75  # of the noise that was assumed of speeds: what is left is no more, and it is said
LEFT = "The fit leaves {:.2g} of the noise that is assumed of the speeds: they have no more, and that is taken."
ON_BOUND = 1e-4  # of the box: how near its edge a parameter counts as on it
SPLIT = "Of kv, {:.1f} ± {:.1f} % is viscous friction and the rest back-EMF, which a motor with {} tells apart."
# Of kv, the viscous friction by which it is said what a winding's motor would be; and of ka and its standard errors, by
# how much that has to matter. Measured: ka 18 % and τ_e 15 % off, 517 and 120 standard errors, where 30 % were viscous.
VISCOUS_PART, MATTERS, SURE_ERRORS = 0.1, 0.01, 1.0
BESIDE_WINDING = (
    "A winding is slow to answer back-EMF and not viscous friction, and speed alone does not tell which of them kv is: "
    "ka and electrical_time_constant are those without viscous friction. If {:.0f} % of kv were, they would be {:.3g} "
    "V·s²/rad and {:.3g} s."
)
NO_VARIANCE = 1e-18  # of the largest speed squared: a measured speed that does not vary, but for rounding


def summarise_fit(
    fit: WhitenedFit,
    search: SearchReport,
    elapsed: Callable[[], float],
    notes: tuple[str, ...] = (),
    asked: tuple[str, ...] = (),
) -> Fit:
    """Summarise a fit: everything a user should know about it, after its recordings' own notes also `notes`.

    elapsed: [s] since the identification began, asked once everything else is known. asked: effects that the fit was
    asked for; what nothing spoke for is not in it.
    """
    unknowns, theta = fit.problem.unknowns, fit.theta
    jacobian = fit.residuals.jacobian(theta)
    sure = estimate_uncertainty(fit, jacobian)
    alike = find_confusable_effects(fit, jacobian, sure.errors, sure.not_identifiable)
    absent = find_absent_effects(fit)
    nowhere = {spec.name for name in absent for spec in _own(name)}
    # An error at zero is one where the effect begins in proportion; elsewhere it is that of a minimum in the noise.
    noise = {spec.name for name in absent if not EFFECT_BY_NAME[name].linear_onset for spec in _own(name)}
    open_ones = tuple(name for name in sure.not_identifiable if name not in nowhere)
    alike = {effect: rivals for effect, rivals in alike.items() if effect not in absent}
    errors = unknowns.value_errors(theta, sure.errors)
    cost, untold = fit.estimate.cost, describe_untold(fit.estimate, errors)
    own_notes = (*_list_own_notes(fit), *_describe_split(unknowns, theta, errors), *_describe_winding(fit, errors))
    return Fit(
        parameters=fit.estimate.parameters,
        standard_errors={name: nan if name in noise else error for name, error in errors.items()},
        correlations=sure.correlations_of(unknowns.names),
        on_bound={name: hit for name, hit in find_bounds_hit(fit.estimate).items() if name in SPEC_BY_NAME},
        not_identifiable=open_ones,
        not_told_apart=alike,
        absent=(*absent, *(name for name in asked if name not in unknowns.effects)),
        suggested_experiment=_suggest_experiment(open_ones, alike),
        residual_rms=float(np.sqrt(cost)),
        noise_floor=fit.residuals.noise_floor,
        r_squared=compute_r_squared(fit.problem, cost),
        whiteness=sure.whiteness,
        slot_irregularity=tuple(encoder.irregularity for encoder in fit.residuals.encoders),
        start_speeds=tuple(float(v) for v in unknowns.decode(theta[None])[1][0]),
        search=search,
        evaluations=fit.estimate.simulations,
        uris=tuple(recording.uri for recording in fit.problem.recordings),
        notes=(*own_notes, *untold, *notes),
        duration=elapsed(),
    )


def compute_r_squared(problem: Problem, cost: float) -> float:
    """Compute the share of the measured speed's variance that a fit of this cost explains; NaN where there is none."""
    weight, speed = problem.weight, problem.speed
    variance = float(np.sum(weight * (speed - np.sum(weight * speed)) ** 2))
    return 1.0 - cost / variance if variance > NO_VARIANCE * float(np.max(speed**2)) else nan


def _list_own_notes(fit: WhitenedFit) -> list[str]:
    """List what the recordings say of themselves, and where they disagree."""
    notes = [note for recording in fit.problem.recordings for note in recording.notes]
    learned = min(data.learned for data in fit.problem.intervals)
    notes += [LEFT.format(learned)] if learned < MUCH_LESS else []
    return notes + describe_worst_dissent(compare_recordings(fit))


def _describe_split(unknowns: Unknowns, theta: Floats, errors: dict[str, float]) -> list[str]:
    """One sentence where kv was split into viscous friction and back-EMF."""
    if not unknowns.splits_kv or isnan(errors[VISCOUS_SHARE.name]):
        return []
    share = float(theta[unknowns.names.index(VISCOUS_SHARE.name)])
    by = " and ".join(name for name in unknowns.effects if EFFECT_BY_NAME[name].splits_kv)
    error = ceil(1000.0 * errors[VISCOUS_SHARE.name]) / 10.0  # nobody needs it to more than a tenth of a percent
    return [SPLIT.format(100.0 * share, error, by)]


def _describe_winding(fit: WhitenedFit, errors: dict[str, float]) -> list[str]:
    """One sentence where viscous friction in kv, of which nothing is known, would make ka and τ_e other ones.

    Speed answers voltage with the poles of ka·τ_e·s² + (ka + viscous·τ_e)·s + kv, in which three are two.
    """
    values, split = fit.estimate.parameters.values, fit.problem.unknowns.splits_kv
    if WINDING not in values or split or isnan(errors[WINDING]) or not values[WINDING] > 0.0:
        return []
    kv, ka, slow = values["kv"], values["ka"], values[WINDING]
    root = 1.0 - 4.0 * VISCOUS_PART * kv * slow / ka
    less = 0.5 * ka * (1.0 + sqrt(root)) if root > 0.0 else 0.5 * ka
    if not ka - less > max(MATTERS * ka, SURE_ERRORS * errors["ka"]):
        return []
    return [BESIDE_WINDING.format(100.0 * VISCOUS_PART, less, slow * ka / less)]


def _own(effect: str) -> tuple[ParameterSpec, ...]:
    return EFFECT_BY_NAME[effect].parameters


def find_bounds_hit(estimate: Estimate) -> dict[str, bool]:
    """Find the parameters that ended on the edge of the search box.

    Of what steady states do not show, the box is next to nothing: its edge is as good a place as any.
    """
    unknowns, theta = estimate.problem.unknowns, estimate.theta
    steady = have_steady_states(estimate.problem.recordings)
    span = unknowns.high - unknowns.low
    at_wall = (theta - unknowns.low < ON_BOUND * span) | (unknowns.high - theta < ON_BOUND * span)
    middle = 0.5 * (unknowns.low + unknowns.high)
    return {
        name: bool(at_wall[i]) and _is_a_wall(name, theta[i] < middle[i], steady)
        for i, name in enumerate(unknowns.names)
    }


def _is_a_wall(name: str, at_low: bool, steady: bool) -> bool:
    """A parameter at the value where its effect vanishes is an answer, not the edge of the search."""
    spec = SPEC_BY_NAME.get(name)
    if spec is not None and spec.of_motion and steady:
        return False
    return spec is None or not (at_low and spec.low == spec.off)


def _suggest_experiment(not_identifiable: tuple[str, ...], alike: dict[str, tuple[str, ...]]) -> str:
    """The profile that would show what this recording cannot; empty if nothing is open."""
    for effect in EFFECT_BY_NAME.values():
        if any(spec.name in not_identifiable for spec in effect.parameters):
            return effect.shown_by
    if not_identifiable:
        return "staircase"
    return suggest_profile(rival for rivals in alike.values() for rival in rivals)
