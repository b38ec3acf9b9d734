"""Carry an estimate from stage to stage of a fit: the problem, θ, and the simulations that it took."""

from dataclasses import dataclass, replace

from motor_identification.estimation.problem import Problem
from motor_identification.noise.error_model import Lag
from motor_identification.recording import Floats
from motor_model.parameters import Parameters

SUPPLY_STEP = 0.01  # for derivatives: a battery is as far from another


@dataclass(frozen=True)
class Estimate:
    """A problem, the unknowns θ estimated for it, and the simulations of one motor that led there."""

    problem: Problem
    theta: Floats  # (D,)
    simulations: int = 0

    @property
    def cost(self) -> float:
        """[rad²/s²] the time-weighted mean square of the speed residuals (output error)."""
        return self.problem.cost(self.theta)

    @property
    def increments(self) -> tuple[Floats, ...]:
        """Simulated minus measured travel [rad] in the intervals of every recording."""
        return self.problem.increments(self.theta)

    @property
    def angles(self) -> tuple[Floats, ...]:
        """[rad] what the disc shows at the times of every recording's intervals."""
        return self.problem.angles(self.theta)

    @property
    def supply_responses(self) -> tuple[Floats, ...]:
        """[rad] what a supply adds to those angles that is larger by its own size, to first order."""
        more = self.problem.angles(self.problem.unknowns.scale_supply(self.theta, SUPPLY_STEP))
        return tuple((after - before) / SUPPLY_STEP for before, after in zip(self.angles, more, strict=True))

    @property
    def parameters(self) -> Parameters:
        """The motor, as the first recording has it."""
        return self.problem.unknowns.parameters(self.theta, self.problem.recordings[0].info.name)

    @property
    def lag(self) -> Lag:
        """The motor as a first-order lag."""
        values = self.parameters.values
        return Lag(values["kv"] / values["ka"], values["ka"])

    def on(self, problem: Problem) -> "Estimate":
        """Apply the same θ to another problem with the same unknowns."""
        return replace(self, problem=problem)
