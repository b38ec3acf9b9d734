"""Identify a motor in physical units from recordings with a measured current, starting from a fit of the motion."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import isnan, nan

from motor_identification.estimation.whitened_fit import WhitenedFit, fit_whitened
from motor_identification.physical.current_samples import select_current
from motor_identification.physical.joint_fit import INDUCTANCE, LAG, JointFit, add_inductance, fit_with_current
from motor_identification.physical.propagation import Values, propagate_errors
from motor_identification.physical.warm_winding import describe_warm_winding
from motor_identification.uncertainty.identifiability import PRESENT_SIGMA
from motor_identification.uncertainty.result import Fit
from motor_identification.uncertainty.standard_errors import Uncertainty, estimate_uncertainty
from motor_identification.uncertainty.summary import find_bounds_hit
from motor_model.effects import ELECTRICAL, SPEC_BY_NAME
from motor_model.physical.quantities import CONSTANT, RESISTANCE, physical_values
from motor_model.physical.quantities import INDUCTANCE as INDUCTANCE_SPEC
from motor_model.physical.result import PhysicalResult

NO_INDUCTANCE = (
    "The inductance is not identifiable: neither current nor motion shows a lag of L/R. Sample faster, or record the "
    "profile 'prbs'."
)
AT_LIMIT = (
    "The {} is at the limit of its search range: do not trust the quantities; check that voltage, current and speed "
    "are of the same motor, and their units."
)
LATE = "current_lag"
OLDER = "The current is {:.2f} ± {:.2f} ms older than its sample, which is taken into account."
LATER = "The current is {:.2f} ± {:.2f} ms younger than its sample, which is taken into account."


@dataclass(frozen=True)
class Judged:
    """A joint fit and how sure it is."""

    fit: JointFit
    sure: Uncertainty

    @property
    def has_inductance(self) -> bool:
        """Whether there is any lag of the armature. What cannot be told of it makes the resistance less sure, too."""
        return LAG in self.fit.problem.unknowns.names and not find_bounds_hit(self.fit.estimate)[LAG]

    @property
    def shows_inductance(self) -> bool:
        """Whether that lag is determined."""
        return self.has_inductance and LAG not in self.sure.not_identifiable


def identify_with_current(motion: WhitenedFit, summarise: Callable[[WhitenedFit], Fit]) -> Fit:
    """Fit motion and current together, from a fit of the motion: parameters, their errors, and the physics in them.

    The inductance is looked for even where it was not asked for: whoever measures a current wants R and L. `summarise`
    says what is to be said of a fit of the motion.

    Raises:
        RecordingError: a recording has no current, or one that is not this motor's.
    """
    currents = tuple(select_current(recording) for recording in motion.problem.recordings)
    judged = _judge(fit_with_current(motion, currents))
    if INDUCTANCE.name not in motion.problem.unknowns.effects:
        tries = [fit_with_current(start, currents) for start in add_inductance(motion)]
        lagging = _judge(min(tries, key=lambda one: one.sum_of_currents))
        if lagging.has_inductance:
            judged, motion = lagging, fit_whitened(lagging.fit.motion)
    return _complete(summarise(motion), judged)


def _judge(fit: JointFit) -> Judged:
    return Judged(fit, estimate_uncertainty(fit, fit.residuals.jacobian(fit.theta)))


def _complete(fit: Fit, judged: Judged) -> Fit:
    unknowns, theta, sure = judged.fit.electrical, judged.fit.theta, judged.sure
    values, errors = unknowns.values(theta), unknowns.value_errors(theta, sure.errors)
    electrical = {spec.name for spec in ELECTRICAL}
    open_ones = tuple(name for name in sure.not_identifiable if name not in electrical)
    lumped = {name: error for name, error in errors.items() if name in SPEC_BY_NAME}
    return replace(
        fit,
        parameters=judged.fit.estimate.parameters,
        standard_errors=lumped,
        correlations=sure.correlations_of(unknowns.names),
        on_bound={name: hit for name, hit in find_bounds_hit(judged.fit.estimate).items() if name in SPEC_BY_NAME},
        not_identifiable=open_ones,
        evaluations=judged.fit.estimate.simulations,
        physical=_physical(judged, values, errors),
    )


def _physical(judged: Judged, values: dict[str, float], errors: dict[str, float]) -> PhysicalResult:
    def quantities(some: Values) -> dict[str, float]:
        return physical_values(some, some[RESISTANCE.name], some[CONSTANT.name])

    correlations = judged.sure.correlations_of(judged.fit.electrical.names)
    found, sure = quantities(values), propagate_errors(quantities, values, errors, correlations)
    open_ones = [name for name, error in sure.items() if isnan(error)]
    notes = [samples.note for samples in judged.fit.residuals.currents if samples.note]
    notes += describe_warm_winding(judged.fit)
    hit = find_bounds_hit(judged.fit.estimate)
    notes += [AT_LIMIT.format(name.replace("_", " ")) for name in (RESISTANCE.name, CONSTANT.name) if hit[name]]
    late, error = values.get(LATE, 0.0), errors.get(LATE, 0.0)
    if late < 0.0 or late > PRESENT_SIGMA * error:
        notes.append((LATER if late < 0.0 else OLDER).format(1e3 * abs(late), 1e3 * error))
    if not judged.shows_inductance:
        open_ones = list(dict.fromkeys((*open_ones, INDUCTANCE_SPEC.name)))
        found[INDUCTANCE_SPEC.name], sure[INDUCTANCE_SPEC.name] = nan, nan
        notes.append(NO_INDUCTANCE)
    noise = judged.fit.residuals.sigma
    return PhysicalResult("current", found, sure, tuple(open_ones), noise, tuple(notes))
