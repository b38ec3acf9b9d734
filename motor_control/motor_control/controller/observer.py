"""The observer: an identified model and the encoder's edges make the speed, and how certain it is, at any instant.

An edge is an exact angle at an exact time; between edges the model moves on. A Kalman filter over angle, speed and load
joins the two (Anderson & Moore, "Optimal Filtering", 1979; what is special to an encoder stands in `kalman`):

    mean        every effect of the model, delay and inductance included, by the model's own compiled step
    covariance  by the line through it; the load is a random walk, so no unknown load leaves a lasting error
    jump        where edges show that the load has jumped, it is taken up at once (`kalman.jump`)
    edges       at their own times, between two samples; what their number leaves open, the motion tells
    silence     no edge: the shaft is still within a slot; a motor that friction holds has the speed 0

What belongs to a recording and not to the motor is left out: the load step, and the phases of ripple and eccentricity,
which count as noise instead.
"""

from dataclasses import dataclass, field, replace
from math import ceil, copysign, inf, nan, sqrt, tau

import numpy as np
from numpy.typing import NDArray

from motor_control.checks import at_least
from motor_control.filter.direction_hypotheses import Pair
from motor_control.filter.filter_state import Noise
from motor_control.filter.prediction import carried
from motor_control.filter.sample_update import first_pair, read
from motor_model.effects import INDEX
from motor_model.errors import MotorError
from motor_model.parameters import Parameters
from motor_model.sample import Info, Measurement, Sample

WALK = 0.002  # [V²/s] of the load
SHAKE = 1e-6  # [V²·s] of the torque
HOLE = 0.2  # of a slot: standard deviation of where a hole's other flank is
MOST_COMMANDS = 1000  # that may be on their way through the delay
FASTEST = 10.0  # times what the supply gives: no motor turns so fast
NONE = (nan, 0.0)  # no edge


@dataclass(frozen=True, slots=True)
class State:
    """What the observer remembers of the samples up to one of them."""

    pair: Pair
    latched: NDArray[np.float64]  # (M, 2) seconds before the sample, volts; the newest first
    sample_time: int  # [ns]
    edge_count: int
    edge_time: int  # [ns]


@dataclass(frozen=True, slots=True)
class Estimate:
    """What the law and the user see."""

    speed: float  # [rad/s] at the instant at which the voltage sent now will act
    sigma: float  # [rad/s] one standard deviation of it
    innovation: float  # [rad] angle at the latest edge less its prediction
    load: float  # [V] beyond the model's
    stands: bool  # no edge comes although the model would have it move


@dataclass(frozen=True)
class Observer:
    """The observer of one motor; `begin`, `update` and `predict` are functions of their arguments alone.

    Raises:
        MotorError: the plant does not stamp its edges, or the irregularity is not a number of at least 0.
    """

    parameters: Parameters
    info: Info
    slot_irregularity: float = 0.01  # share of a slot
    vector: NDArray[np.float64] = field(init=False, repr=False, compare=False)
    noise: Noise = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        at_least(0.0, slot_irregularity=self.slot_irregularity)
        if self.info.measurement is not Measurement.EDGES:
            raise MotorError("the observer needs edges with time stamps, and this plant does not have them.")
        vector, slot = self.parameters.vector(), tau / self.info.edges_per_revolution
        ripple, off_centre = vector[INDEX["ripple_voltage"]], vector[INDEX["eccentricity"]]
        for name in ("ripple_voltage", "eccentricity", "step_voltage"):
            vector[INDEX[name]] = 0.0
        flank = sqrt((self.slot_irregularity * slot) ** 2 + 0.5 * off_centre**2 + (1e-4 * slot) ** 2)
        object.__setattr__(self, "vector", vector)
        noise = Noise(
            slot=slot,
            flank=flank,
            turn=HOLE * slot,
            tick=self.info.edge_resolution,
            walk=WALK + float(ripple) ** 2,
            shake=SHAKE,
            missing=bool(vector[INDEX["miss_rate"]] > 0.0),
            single=self.info.single_channel,
        )
        object.__setattr__(self, "noise", noise)

    def begin(self, sample: Sample, speed: float) -> State:
        """A motor of which only a speed [rad/s] is known, at a sample."""
        latched = _fitted(np.array([[0.0, sample.voltage]]), self._rows())
        fastest = FASTEST * float(self.vector[INDEX["max_voltage"]] / self.vector[INDEX["kv"]])
        speed = min(max(float(speed), -fastest), fastest)
        pair = first_pair(self.noise, speed, copysign(1.0, speed) if speed else 0.0)
        return State(pair, latched, sample.sample_time, sample.edge_count, sample.edge_time)

    def update(self, state: State, sample: Sample) -> tuple[Estimate, State]:
        """The state at a sample after that of `state`, and the speed when a voltage sent now will act."""
        dt = (sample.sample_time - state.sample_time) * 1e-9
        earlier, latest = self._edges(state, sample)
        pair, latched, speed, sigma = read(
            self.vector,
            self.noise,
            state.pair,
            state.latched,
            dt,
            sample.voltage,
            earlier,
            latest,
            self.info.sample_period,
        )
        after = State(pair, latched, sample.sample_time, sample.edge_count, sample.edge_time)
        belief = pair.likely
        return Estimate(speed, sigma, belief.trail.innovation, belief.load, belief.trail.still), after

    def predict(self, state: State, lead: float) -> tuple[float, float]:
        """Speed and its standard deviation [rad/s], `lead` [s] >= 0 after the state's sample if its voltage stays."""
        then = carried(self.vector.copy(), self.noise, state.pair.likely, state.latched, 0.0, lead)
        return then.motor.speed, sqrt(max(then.spread.ss, 0.0))

    def renewed(self, state: State) -> State:
        """What this observer may take over from another model's state: the motion, not the load."""
        motor = state.pair.likely.motor
        pair = first_pair(self.noise, motor.speed, motor.direction)
        return replace(state, pair=pair, latched=_fitted(state.latched, self._rows()))

    def _rows(self) -> int:
        """How many commands may still be on their way."""
        delay = float(self.vector[INDEX["delay"]])
        return min(ceil(delay / self.info.sample_period) + 2, MOST_COMMANDS)

    def _edges(self, state: State, sample: Sample) -> tuple[tuple[float, float], tuple[float, float]]:
        """The last two edges since a state, as [s] after it and the steps to each from the one before."""
        steps = sample.edge_count - state.edge_count
        if steps < 0 and self.noise.single:
            steps = 0  # a count that nobody can explain
        if sample.edge_time == state.edge_time or sample.edge_time == 0:
            return NONE, NONE
        at = (sample.edge_time - state.sample_time) * 1e-9 + 0.5 * self.noise.tick
        before = at - sample.edge_period
        if abs(steps) < 2 or sample.edge_period <= 0.0 or before < 0.0:
            return NONE, (at, float(steps))
        one = copysign(1.0, steps)
        return (before, steps - one), (at, one)


def _fitted(latched: NDArray[np.float64], rows: int) -> NDArray[np.float64]:
    """The newest commands, in so many rows."""
    fitted = np.zeros((rows, 2))
    fitted[:, 0] = -inf
    fitted[: min(rows, len(latched))] = latched[:rows]
    return fitted
