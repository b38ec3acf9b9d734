"""Models of made-up gaps and likelihoods: what rules of acceptance are tested on, on either side of each."""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from types import SimpleNamespace
from typing import Any, cast

import numpy as np

from motor_identification.diagnosis.candidate_model import Model, Score
from motor_identification.diagnosis.candidate_test import CandidateTest
from motor_identification.discrepancy.structure import Structure
from motor_identification.estimation.estimate import Estimate
from motor_identification.measurement.intervals import index_intervals
from motor_identification.noise.error_model import ErrorModel, Lag
from motor_identification.noise.likelihood import Noise
from motor_identification.uncertainty.result import Whiteness
from motor_identification.uncertainty.standard_errors import Uncertainty
from motor_identification.validation.held_out import HeldOut
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters

STEP = 0.0625  # [s] of an interval, exact in binary: two of them are a lasting one
COUNT = 40  # intervals
FLOOR = 1.0  # [rad/s]
LASTING_FLOOR = 0.5 * FLOOR  # two intervals have the same two ends, and twice the time


def stub_held(gap: float, lasting: float | None = None, miscounted: int = 0) -> HeldOut:
    """Held-out motion with this gap and this gap in lasting intervals [rad/s], beside a floor of 1 rad/s.

    A steady error lasts, one that alternates from interval to interval does not.
    """
    steady = gap if lasting is None else lasting
    assert steady <= gap
    start = STEP * np.arange(COUNT)
    blur = np.full(COUNT, FLOOR * STEP / np.sqrt(2.0))
    data = index_intervals(start, start + STEP, np.full(COUNT, 10.0), blur)
    signs = np.where(np.arange(COUNT) % 2 == 0, 1.0, -1.0)
    speed = 10.0 + steady + signs * np.sqrt(gap**2 - steady**2)
    angle = np.append(0.0, np.cumsum(speed * STEP))
    motor = Parameters({"kv": PAPER_KV, "ka": PAPER_KA})
    return HeldOut((), (data,), (angle,), motor, (np.ones(COUNT, dtype=bool),), miscounted)


@dataclass(frozen=True)
class StubModel(Model):
    """A model without an estimate; all that is left above the floor is structure, unless it is said to be random."""

    random: bool = False
    not_identifiable: tuple[str, ...] = ()

    @property
    def uncertainty(self) -> Uncertainty:  # type: ignore[override]
        nothing = np.zeros(0)
        return Uncertainty(nothing, nothing, self.not_identifiable, cast(Whiteness, None))

    @property
    def errors(self) -> ErrorModel:  # type: ignore[override]
        return ErrorModel(0.0, 0.0, 0.0, 1.0)

    @property
    def structure(self) -> tuple[Structure, ...]:  # type: ignore[override]
        return (Structure("speed", 1.0, 1000.0),) if self.above_floor and not self.random else ()

    @property
    def is_random(self) -> bool:
        return True

    @property
    def lag(self) -> Lag:
        return Lag(PAPER_KV / PAPER_KA, PAPER_KA)

    @property
    def effects(self) -> tuple[str, ...]:
        return () if self.estimate is None else self.estimate.problem.unknowns.effects


def stub_model(
    gap: float, lasting: float | None = None, likelihood: float = 0.0, estimate: Estimate | None = None
) -> Model:
    """A model of this gap and logarithmic likelihood, without a disc."""
    return StubModel(cast(Estimate, estimate), stub_held(gap, lasting), Noise(0.0, 0.0), Score(likelihood))


def rescored(model: Model, **changed: object) -> Model:
    """The model with other parts of its score."""
    return replace(model, score=replace(model.score, **changed))


def same_errors(error: float) -> Any:
    """The same standard error of everything."""
    return SimpleNamespace(errors=np.full(20, error))


def short_by(slots: Sequence[float], gap: float = 1.0, slot: float = 0.3) -> Model:
    """A model on intervals of one slot [rad] each, some of which are short by so many slots and are not scored.

    The motor turns by 0.625 rad in an interval.
    """
    model = stub_model(gap, 0.0)
    (data,), count = model.held.intervals, len(model.held.counted)
    missed = np.zeros(count)
    missed[: len(slots)] = slots
    edge = np.column_stack([np.arange(count), np.arange(1, count + 1)])
    short = replace(data, slot=slot, edge=edge, speed=data.speed - missed * slot / data.duration)
    marks = missed != 0.0
    held = replace(model.held, intervals=(short,), scored=(~marks,), miscounted=int(marks.sum()))
    return replace(model, held=held)


def stub_test(effect: str, before: Model, gap: float, evidence: float, lasting: float | None = None) -> CandidateTest:
    """A test of an effect that lowers the gap to this, with this evidence."""
    return CandidateTest(effect, before, stub_model(gap, lasting, before.likelihood + evidence))


@dataclass(frozen=True)
class NamedModel(StubModel):
    """A stub of said effects."""

    names: tuple[str, ...] = ()

    @property
    def effects(self) -> tuple[str, ...]:
        return self.names


def with_effects(model: Model, *effects: str) -> Model:
    """The stub as one that has these effects."""
    return NamedModel(**{field.name: getattr(model, field.name) for field in fields(model)}, names=effects)


def late_by(rows: float) -> Estimate:
    """An estimate of a motor that is late by so many rows, by whatever makes it late."""
    parameters = SimpleNamespace(value=lambda name: 0.001 * rows)
    return cast(Estimate, SimpleNamespace(parameters=parameters, problem=SimpleNamespace(sample_period=0.001)))
