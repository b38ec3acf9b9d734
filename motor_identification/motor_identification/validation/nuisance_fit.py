"""A motor fitted elsewhere, on other recordings: what belongs to each of them is estimated on blocks of it.

That is the initial speed, phases, the time of a load step; the motor itself is not touched.
"""

from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import least_squares

from motor_identification.estimation.parameter_space import Unknowns, carried
from motor_identification.estimation.problem import Problem
from motor_identification.measurement.measured_angle import Track
from motor_identification.periodic import periodic_fit
from motor_identification.recording import Bools, Floats
from motor_model.effects import DURATION, EFFECT_BY_NAME

TIMES = 24  # at which an instant is tried


@dataclass(frozen=True)
class _Own:
    """Residuals as a function of what belongs to the recordings alone, on the blocks that are for that."""

    problem: Problem
    place: Floats
    free: Bools
    used: Bools

    def whole(self, part: Floats) -> Floats:
        place = self.place.copy()
        place[self.free] = part
        return place

    def residuals(self, part: Floats) -> Floats:
        weighted = np.sqrt(self.problem.weight) * self.problem.residuals(self.whole(part))
        return np.asarray(weighted[self.used])

    def cost(self, place: Floats) -> float:
        return float(np.sum(self.residuals(place[self.free]) ** 2))


def transferred(
    problem: Problem, fitted: Unknowns, place: Floats, own_blocks: tuple[Bools, ...]
) -> tuple[Problem, Floats]:
    """A motor fitted elsewhere on the recordings of a problem without effects."""
    here = problem.with_effects(periodic_fit.without_periodic(fitted.effects))
    there = _fitted(here, _moved(fitted, place, here.unknowns), own_blocks)
    for effect in fitted.effects:
        if EFFECT_BY_NAME[effect].periodic:
            here, there = _with_phases(here, there, effect, fitted, place, own_blocks)
    return here, there


def _moved(old: Unknowns, place: Floats, new: Unknowns) -> Floats:
    """The motor's own parameters among the unknowns of other recordings; the rest in the middle of its box."""
    moved = 0.5 * (new.low + new.high)
    for i, name in enumerate(new.names):
        if not new.specs[i].of_recording:
            moved[i] = place[old.names.index(name)]
    return moved


def _fitted(problem: Problem, place: Floats, own_blocks: tuple[Bools, ...]) -> Floats:
    """The place with what belongs to the recordings fitted on their own blocks."""
    unknowns = problem.unknowns
    free = np.ones(len(unknowns.low), dtype=bool)
    free[[i for i, spec in enumerate(unknowns.specs) if not spec.of_recording]] = False
    own = _Own(problem, place, free, np.concatenate(own_blocks))
    if not free.any():
        return place
    for i, spec in enumerate(unknowns.specs):
        if spec.of_recording and spec.scale == DURATION:
            own = replace(own, place=_with_instants(own, i))
    low, high = unknowns.low[free], unknowns.high[free]
    margin = 1e-9 * (high - low)
    start = np.clip(own.place[free], low + margin, high - margin)
    solution = least_squares(own.residuals, start, bounds=(low, high), x_scale=high - low, max_nfev=30, diff_step=1e-5)
    return own.whole(solution.x)


def _with_instants(own: _Own, parameter: int) -> Floats:
    """The place with an instant of each recording, such as that of a load step, at the best of many times."""
    place, columns = own.place, own.problem.unknowns.columns[:, parameter]
    for recording, column in zip(own.problem.recordings, columns, strict=True):
        trials = np.tile(place, (TIMES, 1))
        trials[:, column] = np.linspace(0.0, recording.duration, TIMES)
        place = min(trials, key=own.cost)
    return place


def _with_phases(
    bare: Problem, there: Floats, effect: str, fitted: Unknowns, place: Floats, own_blocks: tuple[Bools, ...]
) -> tuple[Problem, Floats]:
    """A periodic effect joins, with the phases that fit best on measured angles, or, if that is better, on its own."""
    names = [spec.name for spec in EFFECT_BY_NAME[effect].parameters if not spec.of_recording]
    values = {name: np.array(float(place[fitted.names.index(name)])) for name in names}
    larger, used = bare.with_effects((*bare.unknowns.effects, effect)), np.concatenate(own_blocks)
    nothing = np.zeros(len(larger.unknowns.low), dtype=bool)
    choices: list[tuple[float, Problem, Floats]] = []
    tracks: tuple[Track, ...] = ()
    for _ in range(periodic_fit.ROUNDS):
        cycles = float(values.get("ripple_cycles", np.array(1.0)))
        tracks, found = periodic_fit.phases(bare, there, effect, cycles, tracks)
        start = carried(bare.unknowns, there, larger.unknowns, {**values, **found})
        for trial in (replace(larger, tracks=tracks), replace(larger, tracks=())):
            end = _fitted(trial, start, own_blocks)
            choices.append((_Own(trial, end, nothing, used).cost(end), trial, end))
        _cost, best, end = min(choices, key=lambda row: row[0])
        tracks = best.anchored(end, best.unknowns.effects).tracks  # this motor bridges the gaps better
    return best, end
