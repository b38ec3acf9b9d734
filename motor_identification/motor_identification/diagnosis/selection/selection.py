"""Hold a stepwise selection: its steps, the model they lead to, and how that is fitted again after each."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import sqrt

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_fit import judge_beside_torque, validate_model
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import CandidateTest
from motor_identification.diagnosis.effect_test import list_candidates
from motor_identification.diagnosis.fits.disturbed_fit import fit_beside_torque
from motor_identification.diagnosis.fits.effect_fit import place_instants
from motor_identification.diagnosis.fits.score_scan import Promise, scan_scores
from motor_identification.discrepancy.structure import Structure
from motor_identification.estimation.direction_correction import correct_directions
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds, measure_scatter
from motor_identification.estimation.miscounts import exclude_miscounts, find_miscounts, fit_robustly
from motor_identification.validation.hold_out import HoldOut
from motor_identification.validation.instants import needs_instant
from motor_model.effects import EFFECT_BY_NAME


@dataclass(frozen=True)
class SelectionStep:
    """One effect that was selected."""

    before: Model
    found: CandidateTest
    tests: tuple[CandidateTest, ...]  # of all effects that were tried there, best first
    rivals: tuple[str, ...]  # effects that would do as well
    explains: float  # share of the excess over the floor that it takes away; of two that were found together, both do


@dataclass(frozen=True)
class Selection:
    """The steps of a stepwise selection, the model they lead to, and what it is judged by."""

    steps: tuple[SelectionStep, ...]
    model: Model
    hold_out: HoldOut
    workers: int  # effects that are tried at a time
    refused: bool = False  # whether something likely takes away too little of what lasts, as far as the sensor tells
    outside: Structure | None = None  # of what is outside the table, for which a finding stood in

    @property
    def structure(self) -> tuple[Structure, ...]:
        """What can be predicted of what is left, the most telling variable first."""
        return (*([] if self.outside is None else [self.outside]), *self.model.structure)

    @property
    def complete(self) -> bool:
        """Whether nothing is left that can be predicted, and no effect was dropped that stood in for something."""
        return self.model.complete and self.outside is None

    @cached_property
    def promises(self) -> tuple[tuple[Promise, ...], tuple[Promise, ...]]:
        """What each effect that its model can be given, and each two, would gain beside what it leaves; best first.

        Not what has a phase or an instant, which have scans of their own.
        """
        model = self.model
        left = [
            effect
            for effect in list_candidates(model.effects, model.held, model.beside_torque)
            if not EFFECT_BY_NAME[effect].periodic and not needs_instant(effect)
        ]
        return scan_scores(model.estimate, model.errors_beside_torque, left)

    def add(self, steps: Sequence[SelectionStep]) -> "Selection":
        """Add steps, and fit the model that they lead to once more on corrected recordings."""
        last, every = steps[-1].found.model, (*self.steps, *steps)
        if last.beside_torque:
            return begin_beside_torque(last, self.hold_out, self.workers, every)
        return begin_selection(last.estimate, self.hold_out, self.workers, every)

    def replace_step(self, step: SelectionStep, by: SelectionStep | None, model: Model) -> "Selection":
        """Put another step, or none, instead of one; steps that the model does not have go too."""
        steps = [by if one is step else one for one in self.steps]
        kept = tuple(one for one in steps if one and one.found.effect in model.effects)
        return replace(self, steps=kept, model=model)


def begin_beside_torque(
    model: Model, hold_out: HoldOut, workers: int, steps: tuple[SelectionStep, ...] = ()
) -> Selection:
    """Correct directions by a model, and fit, learn and judge it beside a random torque until nothing is gained.

    The errors that a fit is whitened by are those of the model before it: of what was fitted without a torque, they may
    be of a motor that is not there yet. Measured: a delay and an inductance that do each other's work went on by 100 of
    log likelihood in three fits, and any effect that was tried beside the first, of no size, was likelier by 92.
    """
    begun = _begin_once_beside_torque(model, hold_out, workers, steps)
    for _ in range(thresholds.SETTLING_ROUNDS):
        again = _begin_once_beside_torque(begun.model, begun.hold_out, workers, steps)
        if again.model.likelihood - begun.model.likelihood < thresholds.SETTLED_LIKELIHOOD:
            break
        begun = again
    return begun


def _begin_once_beside_torque(
    model: Model, hold_out: HoldOut, workers: int, steps: tuple[SelectionStep, ...]
) -> Selection:
    """Correct directions by a model, and fit, learn and judge it again beside a random torque.

    Nothing is left out: the density of what is left has wide tails.
    """
    errors = model.errors_beside_torque
    estimate = place_instants(fit_beside_torque(correct_directions(model.estimate), errors), errors)
    hold_out = hold_out.correct_directions(estimate)
    again = judge_beside_torque(validate_model(hold_out, estimate), hold_out, errors, thresholds.FINAL_EVALUATIONS)
    return Selection(steps, again, hold_out, workers)


def begin_selection(
    estimate: Estimate, hold_out: HoldOut, workers: int, steps: tuple[SelectionStep, ...] = ()
) -> Selection:
    """Correct directions by an estimate, exclude miscounted intervals, fit again, and validate that.

    As long as the model lacks more, only few intervals are plainly off by whole slots. Where nothing else is left once
    all that look like it have gone, they were miscounted.
    """
    directed = correct_directions(estimate)
    careful = fit_speeds(directed.on(directed.problem.without(find_miscounts(directed))))
    hold_out = hold_out.correct_directions(careful)
    model = validate_model(hold_out, careful)
    robust = fit_robustly(careful.on(directed.problem))
    if robust is not None and may_be_miscounted(robust, model.floor):
        clean = exclude_miscounts(robust)
        corrected = hold_out.correct_directions(clean)
        rest = validate_model(corrected, clean)
        if rest.at_floor:
            return Selection(steps, rest, corrected, workers)
    return Selection(steps, model, hold_out, workers)


def may_be_miscounted(robust: Estimate, floor: float) -> bool:
    """Decide whether most intervals of a robust fit are near the floor [rad/s]: a few miscounted ones may be all."""
    scatter = measure_scatter(robust).robust * sqrt(len(robust.problem.weight))  # of unweighted residuals
    return scatter < thresholds.MISCOUNTED_GAP * floor
