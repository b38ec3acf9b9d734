"""A simulated board: the motor, its disc, the timer that stamps edges, and the sampling that reports them."""

from collections import deque
from dataclasses import dataclass
from fractions import Fraction
from math import nan, tau

import numpy as np

from motor_model.dynamics.bridge import effective_voltage
from motor_model.dynamics.current import current_at
from motor_model.dynamics.state import State, at_rest
from motor_model.effects import INDEX
from motor_model.gearing.gear import edge_angle, exact_gear
from motor_model.parameters import Parameters
from motor_model.sample import Info, Measurement, Sample
from motor_model.sensing.current_sense import make_current_sense
from motor_model.sensing.edge_record import LATEST, NO_EDGES, POWER_UP, record_edges
from motor_model.sensing.encoder import Lines, make_disc, make_lines_disc, turn
from motor_model.sensing.speed_rule import SpeedState, single_channel_speed, speed_magnitude

DELAY, MISS_RATE = INDEX["delay"], INDEX["miss_rate"]
MOST_EDGES = 4096  # in one sample; at 200 Hz that is 54,000 rad/s on 96 edges


@dataclass(frozen=True, slots=True)
class BoardConfig:
    """How the board samples and what its encoder is like."""

    name: str = "motor"
    sample_rate: float = 200.0  # [Hz]
    edges_per_revolution: int = 96  # counted in a turn of the encoder's shaft
    single_channel: bool = True
    edge_resolution: float = 4e-6  # [s] timer tick
    slot_irregularity: float = 0.0  # share of a slot
    seed: int = 0  # of the disc, the starting angle and missed edges
    start_angle: float | None = None  # [rad] of the disc; None: drawn from the seed
    quadrature: int = 1  # counts in a period of one channel; 2 and 4 need both channels
    gear: Fraction | None = None  # encoder turns per turn of the output; None: as the motor's
    lines: Lines = Lines()  # with quadrature 2 and 4

    def gear_of(self, parameters: Parameters) -> Fraction:
        """The gear between this encoder and the output of that motor."""
        return exact_gear(parameters.gear_ratio) if self.gear is None else self.gear

    def info(self, parameters: Parameters) -> Info:
        """What a reader of the samples has to know."""
        return Info(
            name=self.name,
            source="simulation",
            measurement=Measurement.EDGES,
            edges_per_revolution=self.edges_per_revolution,
            single_channel=self.single_channel,
            edge_resolution=self.edge_resolution,
            sample_period=1.0 / self.sample_rate,
            max_voltage=parameters.max_voltage,
            decay="coast" if parameters.value("coast_share") > 0.0 else "brake",
            quadrature=self.quadrature,
            gear_ratio=float(self.gear_of(parameters)),
        )


class SimulatedBoard:
    """Steps a motor from sample to sample and reports what a real board would; knows no wall clock."""

    def __init__(self, parameters: Parameters, config: BoardConfig) -> None:
        self._p = parameters.vector()
        self._config = config
        gear = config.gear_of(parameters)
        self._p[INDEX["gear_ratio"]] = float(gear)
        if config.quadrature > 1:
            pulses = config.edges_per_revolution // config.quadrature
            shape = (pulses, config.quadrature, config.slot_irregularity, config.seed, float(gear), config.lines)
            self._disc = make_lines_disc(*shape)
        else:
            self._disc = make_disc(config.edges_per_revolution, config.slot_irregularity, config.seed, float(gear))
        self._random = np.random.default_rng([config.seed, 1])
        drawn = float(self._random.uniform(0.0, tau))
        self._offset = drawn if config.start_angle is None else config.start_angle
        self._slot = edge_angle(config.edges_per_revolution, gear)
        self._state: State = at_rest(0.0)
        self._acting = 0.0  # [V] the effective voltage that brought the motor here
        self._current_sense = make_current_sense(parameters, config.seed)
        self._samples = 0
        self._commands: deque[tuple[float, float]] = deque([(-np.inf, 0.0)])  # [s], [V], as latched
        self._edges, self._stamps, self._speed_state = NO_EDGES, np.zeros(LATEST, dtype=np.int64), SpeedState()
        self._times, self._directions = np.empty(MOST_EDGES), np.empty(MOST_EDGES, dtype=np.int64)

    @property
    def speed(self) -> float:
        """[rad/s] the true shaft speed, which no encoder reports."""
        return float(self._state.speed)

    @property
    def angle(self) -> float:
        """[rad] the true shaft angle since power-up."""
        return float(self._state.angle)

    @property
    def current(self) -> float:
        """[A] the true current, which no sensor reports; NaN where the motor's resistance is unknown."""
        if self._p[INDEX["resistance"]] == 0.0:
            return nan
        t = max(self._samples - 1, 0) / self._config.sample_rate
        return float(current_at(self._p, self._acting, self._state, t))

    def sample(self, command: float) -> Sample:
        """Move on to the next sample, latch the command [V] there, and report."""
        if self._samples > 0:
            self._move((self._samples - 1) / self._config.sample_rate, self._samples / self._config.sample_rate)
        limit = float(self._p[INDEX["max_voltage"]])
        voltage = float(min(max(command, -limit), limit))
        now = POWER_UP + round(self._samples * 1e9 / self._config.sample_rate)
        if voltage != self._commands[-1][1]:
            self._commands.append((self._samples / self._config.sample_rate, voltage))
        current = self.current
        self._samples += 1
        return Sample(
            sample_time=now,
            speed=self._speed(voltage, now),
            voltage=voltage,
            edge_count=self._edges.edges,
            edge_time=self._edges.time,
            edge_period=self._edges.period,
            current=self._current_sense.read(current) if self._current_sense is not None else nan,
        )

    def _move(self, start: float, end: float) -> None:
        """Turn the motor through all delayed commands that act between two times [s]."""
        delay = float(self._p[DELAY])
        while len(self._commands) > 1 and self._commands[1][0] + delay <= start:
            self._commands.popleft()
        switches = [at + delay for at, _ in self._commands][1:]
        t = start
        for (_, command), until in zip(self._commands, [*switches, np.inf], strict=True):
            stop = min(until, end)
            if stop > t:
                self._turn(command, t, stop - t)
                t = stop

    def _turn(self, command: float, t: float, dt: float) -> None:
        u = self._acting = effective_voltage(self._p, command)
        disc = self._disc
        self._state, count = turn(
            *(self._p, u, self._state, t, dt, disc.forward, disc.backward, self._offset),
            *(self._times, self._directions, not self._config.single_channel and self._config.quadrature == 1),
        )
        times, directions = self._times[:count], self._directions[:count]
        if self._p[MISS_RATE] > 0.0:
            rising = np.flatnonzero(np.abs(directions) == 1)
            missed = rising[self._random.random(len(rising)) < self._p[MISS_RATE]]
            times, directions = np.delete(times, missed), np.delete(directions, missed)
        how = (self._config.edge_resolution, self._config.single_channel, self._config.quadrature)
        self._edges = record_edges(self._edges, self._stamps, times, directions, *how)

    def _speed(self, voltage: float, now: int) -> float:
        magnitude = speed_magnitude(self._slot, now, self._edges.time, self._edges.period, self._config.quadrature)
        if not self._config.single_channel:
            return self._edges.direction * magnitude
        speed, self._speed_state = single_channel_speed(self._speed_state, magnitude, voltage, now)
        return speed
