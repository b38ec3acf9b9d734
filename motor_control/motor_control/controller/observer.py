"""Observe speed and load: a Kalman filter of an identified model and the encoder's edges.

An edge is an exact angle at an exact time; between edges the model moves on. A Kalman filter over angle, speed and load
joins the two (Anderson & Moore, "Optimal Filtering", 1979; what is special to an encoder stands in `filter`):

    mean        every effect of the model, delay and inductance included, by the model's own compiled step
    covariance  by the line through it; the load is a random walk, so no unknown load leaves a lasting error
    jump        where edges show that the load has jumped, it is taken up at once (`filter.load_jump`)
    edges       at their own times, between two samples; what their number leaves open, the motion tells
    silence     no edge: the shaft is still within a slot; a motor that friction holds has the speed 0

What belongs to a recording and not to the motor is left out: the load step, and the phases of ripple and eccentricity,
which count as noise instead.
"""

from dataclasses import dataclass, field, replace
from math import ceil, copysign, inf, nan, sqrt

import numpy as np
from numpy.typing import NDArray

from motor_control.checks import at_least
from motor_control.filter.filter_state import Noise
from motor_control.filter.load_jump import no_jumps
from motor_control.filter.packed_state import Memory, unpack_hypotheses
from motor_control.filter.prediction import Commands
from motor_control.filter.sample_update import Edge, Speed, predict_speed, start_filter, update_at_sample
from motor_model.effects import INDEX
from motor_model.errors import MotorError
from motor_model.parameters import Parameters
from motor_model.sample import Info, Measurement, Sample

WALK = 0.002 / 144.0  # [1/s] of the load, in supplies squared: the same motor at another voltage is seen the same
SHAKE = 1e-6 / 144.0  # [s] of the torque, in supplies squared
HOLE = 0.2  # of a slot: standard deviation of where a hole's other flank is
MOST_COMMANDS = 1000  # that may be on their way through the delay
FASTEST = 10.0  # times what the supply gives: no motor turns so fast
NO_EDGE = Edge(nan, 0.0, False)


@dataclass(frozen=True, slots=True)
class State:
    """What the observer remembers of the samples up to one of them."""

    memory: Memory  # the filter's
    commands: Commands  # that may still be on their way through the delay
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
        vector, slot = self.parameters.vector(), self.info.edge_angle
        ripple, off_centre = vector[INDEX["ripple_voltage"]], vector[INDEX["eccentricity"]]
        for name in ("ripple_voltage", "eccentricity", "step_voltage"):
            vector[INDEX[name]] = 0.0
        supply = float(vector[INDEX["max_voltage"]])
        flank = sqrt(
            (self.slot_irregularity * slot) ** 2 + 0.5 * (off_centre / float(self.info.gear)) ** 2 + (1e-4 * slot) ** 2
        )
        object.__setattr__(self, "vector", vector)
        noise = Noise(
            slot=slot,
            flank=flank,
            turn=HOLE * slot,
            tick=self.info.edge_resolution,
            walk=WALK * supply**2 + float(ripple) ** 2,
            shake=SHAKE * supply**2,
            missing=bool(vector[INDEX["miss_rate"]] > 0.0),
            single=self.info.single_channel,
        )
        object.__setattr__(self, "noise", noise)

    def begin(self, sample: Sample, speed: float) -> State:
        """Begin at a sample with a motor of which only a speed [rad/s] is known."""
        commands = _fit_commands(Commands(np.zeros(1), np.array([sample.voltage])), self._rows())
        fastest = FASTEST * float(self.vector[INDEX["max_voltage"]] / self.vector[INDEX["kv"]])
        speed = min(max(float(speed), -fastest), fastest)
        memory = start_filter(self.vector, self.noise, speed, copysign(1.0, speed) if speed else 0.0, no_jumps())
        return State(memory, commands, sample.sample_time, sample.edge_count, sample.edge_time)

    def update(self, state: State, sample: Sample) -> tuple[Estimate, State]:
        """Update the state at the next sample, and estimate the speed when a voltage sent now will act."""
        dt = (sample.sample_time - state.sample_time) * 1e-9
        after = update_at_sample(
            self.vector,
            self.noise,
            state.memory,
            state.commands,
            dt,
            sample.voltage,
            self._edges(state, sample),
            self.info.sample_period,
        )
        estimate = Estimate(after.ahead.mean, after.ahead.sigma, after.innovation, after.load, after.stands)
        return estimate, State(after.memory, after.commands, sample.sample_time, sample.edge_count, sample.edge_time)

    def predict(self, state: State, lead: float) -> Speed:
        """Predict the speed `lead` [s] >= 0 after the state's sample if its voltage stays."""
        return predict_speed(self.vector, self.noise, state.memory, state.commands, lead)

    def adopt(self, state: State) -> State:
        """Adopt what another model's state knows of the motion, not of the load."""
        motor = unpack_hypotheses(state.memory).likely.estimate.motor
        memory = start_filter(self.vector, self.noise, motor.speed, motor.direction, no_jumps())
        return replace(state, memory=memory, commands=_fit_commands(state.commands, self._rows()))

    def _rows(self) -> int:
        """Count the commands that may still be on their way."""
        delay = float(self.vector[INDEX["delay"]])
        return min(ceil(delay / self.info.sample_period) + 2, MOST_COMMANDS)

    def _edges(self, state: State, sample: Sample) -> tuple[Edge, Edge]:
        """Find the last two edges since a state."""
        steps = sample.edge_count - state.edge_count
        if steps < 0 and self.noise.single:
            steps = 0  # a count that nobody can explain
        if sample.edge_time == state.edge_time or sample.edge_time == 0:
            return NO_EDGE, NO_EDGE
        at = (sample.edge_time - state.sample_time) * 1e-9 + 0.5 * self.noise.tick
        before = at - sample.edge_period
        mean = self.info.quadrature > 1  # the period is over several edges, and tells no time of another one
        if abs(steps) < 2 or sample.edge_period <= 0.0 or before < 0.0 or mean:
            return NO_EDGE, Edge(at, float(steps), sample.edge_period == 0.0 and abs(steps) == 1)
        one = copysign(1.0, steps)
        return Edge(before, steps - one, False), Edge(at, one, False)


def _fit_commands(commands: Commands, rows: int) -> Commands:
    """Keep the newest commands, in so many rows."""
    times, voltages, kept = np.full(rows, -inf), np.zeros(rows), min(rows, len(commands.times))
    times[:kept], voltages[:kept] = commands.times[:kept], commands.voltages[:kept]
    return Commands(times, voltages)
