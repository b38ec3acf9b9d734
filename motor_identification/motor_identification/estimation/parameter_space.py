"""Define the parameter space of a fit: the box that is searched, and how θ in it becomes a motor."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import log1p
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motor_identification.estimation.extent import measure_extent
from motor_identification.measurement.initial_speed import estimate_initial_speed
from motor_identification.recording import Floats, Recording, once
from motor_model.effect import Extent, ParameterSpec
from motor_model.effects import INDEX, VISCOUS_SHARE, do_split_kv, normalised, specs_of
from motor_model.parameters import Parameters, neutral

SLOW_SPEED = 0.03  # of the largest speed: slower, a ripple holds the shaft or turns it back
KV, BACK_EMF = INDEX["kv"], INDEX["torque_constant"]


class _Plan(NamedTuple):
    """How θ becomes parameter vectors (P,): a fit asks thousands of times."""

    neutral: Floats  # (P,) a motor with every effect off
    places: NDArray[np.int64]  # in it, of every searched parameter that it has,
    own: NDArray[np.int64]  # and their number among the searched ones
    floors: tuple[tuple[int, int], ...]  # places of what is at least as large as another
    starts: int  # where in θ initial speeds begin


@dataclass(frozen=True)
class Unknowns:
    """The searched parameters, some by their logarithm, then what belongs to one recording only.

    That is, of every recording but the first, its own values of what is `of_recording`; then the initial speeds of
    those that start turning.
    """

    effects: tuple[str, ...]
    specs: tuple[ParameterSpec, ...]
    low: Floats  # (D,) of the box, logarithms where the parameter is searched by it
    high: Floats  # (D,)
    extent: Extent
    max_voltage: float
    turning: NDArray[np.bool_]  # (R,) which recordings start on a moving motor
    gear: float = 1.0  # encoder turns per turn of the output

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the physical parameters, in the order of θ; initial speeds come after them."""
        return tuple(spec.name for spec in self.specs)

    @property
    def splits_kv(self) -> bool:
        """Whether the share of kv that is viscous friction is an unknown, too."""
        return VISCOUS_SHARE in self.specs

    @cached_property
    def columns(self) -> NDArray[np.int64]:
        """Where in θ each recording has each parameter, shape (R, number of parameters)."""
        columns = np.tile(np.arange(len(self.specs)), (len(self.turning), 1))
        own = np.flatnonzero([spec.of_recording for spec in self.specs])
        more = len(self.turning) - 1
        columns[1:, own] = len(self.specs) + np.arange(more * len(own)).reshape(more, len(own))
        return columns

    @cached_property
    def logarithmic(self) -> NDArray[np.bool_]:
        """Which of the D unknowns are searched by their logarithm."""
        flags = np.zeros(len(self.low), dtype=bool)
        flags[: len(self.specs)] = [spec.logarithmic for spec in self.specs]
        return flags

    def decode(self, thetas: Floats) -> tuple[Floats, Floats]:
        """Decode θ (S, D) → parameter vectors (S, R, P) and initial speeds (S, R) [rad/s] in R recordings."""
        values = np.where(self.logarithmic, np.exp(np.where(self.logarithmic, thetas, 0.0)), thetas)
        plan = self._plan
        vectors = np.empty((len(thetas), len(self.turning), len(plan.neutral)))
        vectors[:] = plan.neutral
        vectors[:, :, plan.places] = values[:, self.columns[:, plan.own]]
        for own, least in plan.floors:
            vectors[:, :, own] = np.maximum(vectors[:, :, own], vectors[:, :, least])
        if self.splits_kv:
            share = values[:, self.columns[:, self.names.index(VISCOUS_SHARE.name)]]
            vectors[:, :, BACK_EMF] = vectors[:, :, KV] * (1.0 - share)
        starts = np.zeros((len(thetas), len(self.turning)))
        starts[:, self.turning] = values[:, plan.starts :]
        return vectors, starts

    @cached_property
    def _plan(self) -> "_Plan":
        floors = [(INDEX[spec.name], INDEX[spec.at_least]) for spec in self.specs if spec.at_least is not None]
        own = [i for i, name in enumerate(self.names) if name in INDEX]
        return _Plan(
            neutral(self.max_voltage, gear_ratio=self.gear),
            np.array([INDEX[self.names[i]] for i in own], dtype=np.int64),
            np.array(own, dtype=np.int64),
            tuple(floors),
            len(self.low) - int(self.turning.sum()),
        )

    def parameters(self, theta: Floats, name: str) -> Parameters:
        """The motor at θ (D,), as the first recording has it."""
        vector = self.decode(theta[None])[0][0, 0]
        values = {spec: float(vector[INDEX[spec]]) for spec in self.names if spec in INDEX}
        constant = float(vector[BACK_EMF]) if self.splits_kv else 0.0
        return Parameters(values, self.effects, self.max_voltage, name, torque_constant=constant, gear_ratio=self.gear)

    def scale_supply(self, theta: Floats, by: float) -> Floats:
        """θ (D,) of the motor that moves as this one does by a supply that is larger by a share: less of every volt."""
        moved = theta.copy()
        for i, spec in enumerate(self.specs):
            if spec.unit.startswith("V"):
                columns = self.columns[:, i]
                moved[columns] = theta[columns] - log1p(by) if spec.logarithmic else theta[columns] / (1.0 + by)
        return moved

    def value_errors(self, theta: Floats, theta_errors: Floats) -> dict[str, float]:
        """Standard errors of the parameters from those of θ: a logarithm's is a relative one."""
        values = np.exp(np.where(self.logarithmic, theta, 0.0))
        scaled = np.where(self.logarithmic, values * theta_errors, theta_errors)
        return {name: float(scaled[i]) for i, name in enumerate(self.names)}


def map_theta(old: Unknowns, theta: Floats, new: Unknowns, values: Mapping[str, Floats]) -> Floats:
    """Map θ (D,) to other unknowns of the same recordings; `values` has what only these have, per recording."""
    moved = np.zeros(len(new.low))
    for i, name in enumerate(new.names):
        if name in old.names:
            moved[new.columns[:, i]] = theta[old.columns[:, old.names.index(name)]]
    starts = int(new.turning.sum())
    # Behind another timing a motor may turn at its first sample that did not before: then around what it shows there.
    speeds = np.zeros(len(new.turning))
    speeds[new.turning] = 0.5 * (new.low + new.high)[len(moved) - starts :]
    both = old.turning & new.turning
    before = np.zeros(len(old.turning))
    before[old.turning] = theta[len(theta) - int(old.turning.sum()) :]
    speeds[both] = before[both]
    moved[len(moved) - starts :] = speeds[new.turning]
    return set_values(new, moved, {name: values[name] for name in new.names if name not in old.names})


def set_values(unknowns: Unknowns, theta: Floats, values: Mapping[str, Floats]) -> Floats:
    """Set parameters of θ (D,), for all recordings or per recording, within the box."""
    moved = theta.copy()
    for name, value in values.items():
        i = unknowns.names.index(name)
        moved[unknowns.columns[:, i]] = np.log(value) if unknowns.specs[i].logarithmic else value
    return np.clip(moved, unknowns.low, unknowns.high)


def _turning_speeds(recordings: Sequence[Recording]) -> Floats:
    """[rad/s] at the first sample of recordings that begin on a moving motor, 0 of the others, shape (R,)."""
    return np.array([_turning_speed(recording) for recording in recordings])


_turning_speed = once(estimate_initial_speed)


def make_unknowns(recordings: Sequence[Recording], effects: tuple[str, ...], split: bool = False) -> Unknowns:
    """Make the unknowns of these effects, in a box scaled by the largest voltage, the largest speed and the duration.

    split: whether kv is split into back-EMF and viscous friction, too, where any of the effects tells them apart.
    The initial speed of a motor that already turns at the first sample is searched around what it shows there.

    Raises:
        ModelError: an effect is not in the table.
    """
    extent = measure_extent(recordings)
    specs = specs_of(effects)
    if split and do_split_kv(effects):
        specs = (*specs, VISCOUS_SHARE)
    low, high = [], []
    for spec in specs:
        bounds = spec.box(extent)
        low.append(float(np.log(bounds[0]) if spec.logarithmic else bounds[0]))
        high.append(float(np.log(bounds[1]) if spec.logarithmic else bounds[1]))
    for _ in recordings[1:]:
        own = [i for i, spec in enumerate(specs) if spec.of_recording]
        low += [low[i] for i in own]
        high += [high[i] for i in own]
    starts = _turning_speeds(recordings)
    for start in starts[starts != 0.0]:
        margin = 0.5 * abs(start) + 0.02 * extent.speed
        low.append(float(start - margin))
        high.append(float(start + margin))
    most = max(extent.voltage, *(recording.info.full_voltage for recording in recordings))
    gear = float(recordings[0].info.gear)
    return Unknowns(normalised(effects), specs, np.array(low), np.array(high), extent, most, starts != 0.0, gear)
