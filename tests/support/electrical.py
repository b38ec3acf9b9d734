"""A motor in ohms and newton-metres on the independent plant, with an ammeter; and fits of its motion."""

from functools import cache

from plant import profiles, record
from plant.ammeter import Ammeter

from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.request import SearchConfig
from motor_identification.estimation.search.global_search import search_globally
from motor_identification.estimation.whitened_fit import WhitenedFit, fit_whitened
from motor_identification.recording import Recording, check
from motor_model.physical.quantities import lumped_values

Values = dict[str, float]
# A gearless 12 V motor of 4 cm: what its data sheet would say.
PHYSICAL: Values = {
    "resistance": 2.3,
    "torque_constant": 0.065,
    "viscous_friction": 2.5e-5,
    "inertia": 1.4e-4,
    "friction_torque": 0.01,
}
LUMPED = lumped_values(PHYSICAL)
ELECTRIC = {name: PHYSICAL[name] for name in ("resistance", "torque_constant")}
NOISE, OFFSET, STEP = 0.015, 0.03, 0.012  # [A] of the ammeter
FRICTION = ("coulomb_friction",)


def measured(
    values: Values | None = None, seed: int = 1, drive: profiles.Profile | None = None, sample_rate: float = 200.0
) -> Recording:
    """A checked recording with a current of the motor, with other lumped or electric `values` than its own."""
    motor = LUMPED | ELECTRIC | (values or {})
    drive = drive or profiles.joined(profiles.staircase(12.0, 4, 0.3), profiles.random(12.0, 3.0, seed))
    how = {"seed": seed, "irregularity": 0.01, "sample_rate": sample_rate}
    return check(record(motor, *drive, **how, ammeter=Ammeter(NOISE, OFFSET, STEP))[0])  # type: ignore[arg-type]


def fit_motion(recording: Recording, effects: tuple[str, ...] = FRICTION) -> WhitenedFit:
    """A fit of the motion alone."""
    problem = make_problem([recording], effects)
    return fit_whitened(search_globally(problem, SearchConfig(16, 30))[0])


@cache
def known() -> tuple[Recording, WhitenedFit]:
    """The motor without inductance, and the fit of its motion."""
    recording = measured()
    return recording, fit_motion(recording)
