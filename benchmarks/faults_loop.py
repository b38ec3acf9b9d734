"""A speed loop in one process, faster than real time: simulated board, the plant's gate and checks, the controller.

The true speed and the voltage at the pins are looked at from the instant of a fault until the pins stay at 0 V.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field, replace

from faults_motor import Motor

from motor_control.configuration import config_of
from motor_control.controller import controller
from motor_control.controller.reference.demand import Kind
from motor_control.parameters import ROWS
from motor_model.sample import Sample
from motor_model.sensing.board import BoardConfig, SimulatedBoard
from motor_model.sensing.motion_check import MotionCheck
from motor_ros.gate import APART, Gate

DEFAULTS = {row.name: row.default for row in ROWS}
FOR_GOOD = 0.5  # [s] of 0 V in the end
TIMEOUT = 0.1  # [s] command_timeout
Line = Callable[[Sample], Sample]


@dataclass(frozen=True)
class Moment:
    """What was true at a sample."""

    time: float  # [s]
    voltage: float  # [V] at the pins
    speed: float  # [rad/s] true
    said: str


@dataclass
class Loop:
    """Everything between a reference and a shaft; faults are switched by whoever runs it."""

    motor: Motor
    rate: float  # [Hz]
    model: bool = False
    single_channel: bool = True
    supply: float = 0.0  # [V] 0: the motor's voltage
    seed: int = 1
    edges: int = 96  # a turn
    quadrature: int = 1  # counts a period
    load: dict[str, float] = field(default_factory=dict)  # of the motor's effects
    line: Line = lambda sample: sample  # what the encoder's cable makes of a sample
    delay: float = 0.0  # [s] samples reach the controller so much later
    heard: bool = True  # samples reach the controller
    alive: bool = True  # the controller
    raw: float | None = None  # [V] that somebody sends on motor/voltage in the controller's place
    to_and_fro: bool = False  # that voltage turns its sign at every sample
    reference: float | None = None  # [rad/s] to be sent once
    moments: list[Moment] = field(default_factory=list)
    rival: Sample | None = None  # of a second plant, once it speaks
    measured: bool = False  # the supply, which nobody has said
    goes_on: float | None = None  # [rad/s] somebody answers every stop at once, and asks for this
    alternate: bool = False  # somebody asks for an angle before every other sample, and for the speed before the others
    second: float | None = None  # [V] that another sender sends beside the first one, with numbers far from its
    every: int = 1  # samples from each command of that one, and of who sends `raw`, to its next; they send by turns
    deaf: bool = False  # no voltage reaches the plant, and who sends does not know
    asleep: float = 0.0  # [s] for which the controller's computer, and its clock, has stood still in all

    def __post_init__(self) -> None:
        known = self.supply if not self.measured else 0.0
        self.limit = min(self.motor.voltage, known or self.motor.voltage)
        self._samples = self._commands = self._others = 0
        self.come_up()
        parameters = self.motor.parameters(self.supply)
        info = replace(self._board_config.info(parameters), max_voltage=self.limit)
        known = self.motor.parameters() if self.model else None
        self.config = config_of({**DEFAULTS, **self.motor.settings(info, self.model)}, info, known)  # type: ignore[dict-item]
        self.state = controller.State()
        self._queue: deque[tuple[float, Sample]] = deque()
        self._reason = ""

    def come_up(self) -> None:
        """The plant starts, or starts again."""
        self.board = SimulatedBoard(self.motor.parameters(self.supply, **self.load), self._board_config)
        self.gate = Gate(True, TIMEOUT, 1.0 / self.rate).come_up(self._now)
        self.check = MotionCheck(self.limit, self.single_channel)

    @property
    def _board_config(self) -> BoardConfig:
        return BoardConfig(
            sample_rate=self.rate,
            edges_per_revolution=self.edges,
            slot_irregularity=0.01,
            seed=self.seed,
            single_channel=self.single_channel,
            quadrature=self.quadrature,
        )

    @property
    def time(self) -> float:
        """[s]."""
        return self._samples / self.rate

    @property
    def _now(self) -> int:
        return 1 + round(self.time * 1e9)

    def run(self, seconds: float) -> None:
        """Let time pass."""
        for _ in range(round(seconds * self.rate)):
            self._step()

    def drop_samples(self) -> None:
        """Let the controller hear none of the samples that wait: its topic keeps the newest one."""
        self._queue.clear()

    def _step(self) -> None:
        voltage = min(max(self.gate.voltage(self._now), -self.limit), self.limit)
        true = self.board.sample(voltage)
        sample = self.line(replace(true, supply_voltage=self.supply) if self.measured else true)
        self.check = self.check.see(sample)
        if self.check.stop and self.gate.enabled:
            self.gate = self.gate.stop_motor(self.check.stop, self._now)
        if self.goes_on is not None:
            self._go_on(self.goes_on)
        self._queue.append((self.time + self.delay, sample))
        turn = self._samples % self.every
        if self.raw is not None:
            if turn == 0:
                self._command(-self.raw if self.to_and_fro and self._samples % 2 else self.raw)
            self._reason = ""
        elif self.alive:
            self._control()
        if self.second is not None and turn == self.every // 2:
            self._others += 1
            self.gate = self.gate.take(self.second, self._now, "", 10 * APART + self._others)
        said = self.gate.problem(self._now) or self._reason
        self.moments.append(Moment(self.time, true.voltage, self.board.speed, said))
        self._samples += 1

    def _control(self) -> None:
        awake = self.time - self.asleep  # [s] on the clock of its computer
        came = [self._queue.popleft()[1] for _ in range(len(self._queue)) if self._queue[0][0] <= self.time + 1e-9]
        if self.rival is not None:
            self.rival = replace(self.rival, sample_time=self.rival.sample_time + round(1e9 / self.rate))
            came.append(self.rival)
        for sample in came if self.heard else []:
            fresh, self.reference = self.reference, None
            if self.alternate:
                fresh = self._ask_in_turn()
            output, self.state = controller.update(self.config, self.state, sample, fresh, awake)
            self._reason = output.reason if output.state != "running" else ""
            if output.drives:
                self._command(output.terms.voltage)
        output, self.state = controller.watch(self.config, self.state, awake)  # type: ignore[assignment]
        if output is not None:
            self._reason = output.reason
            if output.drives:
                self._command(0.0)

    def _go_on(self, reference: float) -> None:
        """Answer a stop by motor/enable, motor/reset and a fresh reference, as soon as each is taken."""
        if not (self.gate.enabled or self.gate.refusal(self._now)):
            self.gate = self.gate.enable(True)
        self.state = controller.reset(self.state, self.time)[1]
        if self.state.demand is None:
            self.state = controller.refer(self.state, 0.0, self.time)  # so that what follows begins, however soon
            self.reference = reference

    def _ask_in_turn(self) -> float | None:
        """A speed for every other sample; before the others an angle far away."""
        if self._samples % 2:
            return 0.5 * self.motor.top
        self.state = controller.refer(self.state, 1e3, self.time, Kind.POSITION)
        return None

    def _command(self, voltage: float) -> None:
        self._commands += 1
        if self.deaf:
            return
        self.gate = self.gate.take(voltage, self._now, "", self._commands)


@dataclass(frozen=True)
class Outcome:
    """From a fault to 0 V at the pins for good."""

    after: float | None  # [s] None: never
    speed: float  # [rad/s] largest true one meanwhile
    voltage: float  # [V] largest one meanwhile
    said: str


def outcome(moments: list[Moment], fault: float) -> Outcome:
    """What happened since a fault at a time [s]."""
    since = [moment for moment in moments if moment.time >= fault]
    driven = [k for k, moment in enumerate(since) if moment.voltage != 0.0]
    end = driven[-1] + 1 if driven else 0
    if since[-1].time - since[min(end, len(since) - 1)].time < FOR_GOOD:
        end = len(since)
    during = since[: end + 1]
    said = next((moment.said for moment in since[end:] if moment.said), "")
    return Outcome(
        None if end == len(since) else since[end].time - fault,
        max(abs(moment.speed) for moment in during),
        max(abs(moment.voltage) for moment in during),
        said,
    )
