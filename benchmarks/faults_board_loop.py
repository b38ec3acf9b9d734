"""The same loop around the emulated board: the real firmware, the driver's logic and the controller, in lockstep.

The pins of the emulated chip are looked at on its own clock. The port is looked at every quarter of a millisecond.
"""

from collections import deque
from dataclasses import dataclass, field

from faults_loop import DEFAULTS, TIMEOUT, Moment
from faults_motor import MOTORS, Motor

from motor_board.build import FirmwareConfig, firmware
from motor_board.emulation.chip import FREQUENCY
from motor_board.emulation.emulator import Emulator
from motor_board.emulation.shaft import EncoderConfig
from motor_control.configuration import config_of
from motor_control.controller import controller
from motor_driver.config import Config
from motor_driver.driver import Driver
from motor_ros.gate import Gate

LOOK = FREQUENCY // 4000  # [cycle]
MOST_LATE = 1.0  # [s]
REPEAT = 0.01  # [s] the driver's own timer


@dataclass
class BoardLoop:
    """Everything between a reference and the pins; faults are switched by whoever runs it."""

    rate: float  # [Hz]
    motor: Motor = MOTORS[2]
    channels: int = 1
    supply: float = 0.0  # [V] 0: the motor's voltage, and not measured
    told: float = 0.0  # [V] supply_voltage
    alive: bool = True  # the controller
    driving: bool = True  # the driver
    plugged: bool = True
    powered: bool = True  # the board
    stuck: bool = False  # telemetry
    holds_back: float | None = None  # [s] since when the link hands bytes on later and later
    raw: float | None = None  # [V] sent in the controller's place
    reference: float | None = None  # [rad/s] to be sent once
    moments: list[Moment] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.emulator = self._board()
        self._in: deque[tuple[float, bytes]] = deque()  # [s] when each is handed on
        self._out: deque[tuple[float, bytes]] = deque()
        self.start()
        self.state, self._reason, self._sent, self._worked = controller.State(), "", 0, 0.0

    def _board(self, number: int = 0) -> Emulator:
        """A board with that number, and a motor on it."""
        scale = 60_000 if self.supply else 0
        build = FirmwareConfig(
            board_id=number, edges_per_revolution=96, channels=self.channels, supply_full_scale=scale
        )
        encoder = EncoderConfig(seed=3, channels=self.channels, slot_irregularity=0.01)
        board = Emulator(firmware(build), self.motor.parameters(self.supply), encoder)
        board.chip.supply(5.0 * self.supply / 60.0)
        return board

    def exchange(self, number: int) -> None:
        """Another board, with another motor, has been where this one is, for as long."""
        old, self.emulator = self.emulator, self._board(number)
        self.emulator.run(old.chip.cycle)
        self.emulator.chip.drain()
        old.close()

    def enable(self) -> None:
        """Call motor/enable."""
        if not (self.gate.refusal(self._now) or self.driver.refusal()):
            self.gate = self.gate.enable(True)

    def plug(self) -> None:
        """The port opens."""
        self.plugged = True
        self.driver.opened("the port", self._now)

    def start(self) -> None:
        """The driver starts, or starts again."""
        motor = {"max_voltage": self.motor.voltage, "supply_voltage": self.told}
        config = Config(sample_rate=self.rate, single_channel=self.channels == 1, **motor)
        self.driver, self.gate, self._begun = Driver(config), Gate(True, TIMEOUT, 1.0 / self.rate), 0
        self.plug()

    @property
    def time(self) -> float:
        """[s]."""
        return self.emulator.chip.cycle / FREQUENCY

    @property
    def _now(self) -> int:
        return 1 + self.emulator.chip.cycle * 125 // 2

    def run(self, seconds: float) -> None:
        """Let time pass."""
        end = self.emulator.chip.cycle + round(seconds * FREQUENCY)
        while self.emulator.chip.cycle < end:
            self._step()

    def _step(self) -> None:
        self.emulator.run(self.emulator.chip.cycle + LOOK)
        if not self.powered:
            self.emulator.power_up()
        data = self._pass_on(self._in, self.emulator.chip.drain())
        if self.driving:
            self._drive(b"" if self.stuck or not self.plugged else data)
        shaft, said = self.emulator.shaft, self._trouble() or self.gate.problem(self._now) or self._reason
        self.moments.append(Moment(self.time, shaft.voltage, shaft.speed, said))
        if late := self._pass_on(self._out, b""):
            self.emulator.chip.feed(late)

    def _trouble(self) -> str:
        """Why the board that answers is not to run; "" if it is."""
        return self.driver.session.handshake.refusal if self.driver.session else ""

    def _pass_on(self, line: deque[tuple[float, bytes]], data: bytes) -> bytes:
        """Bytes go onto a line of the link: those that it hands on now."""
        if self.holds_back is None:
            return data
        if data:
            line.append((self.time + min(0.5 * (self.time - self.holds_back), MOST_LATE), data))
        return b"".join(line.popleft()[1] for _ in range(len(line)) if line[0][0] <= self.time)

    def _drive(self, data: bytes) -> None:
        readings = self.driver.received(data, self._now) if data and self.driver.session else []
        if self.driver.runs_begun > self._begun:
            self._begun, self.gate = self.driver.runs_begun, self.gate.come_up(self._now)
        for reading in readings:
            self._answer(reading.sample)
        if not readings and self.time - self._worked < REPEAT:
            return
        self._worked = self.time
        self._watch()
        order = self.driver.step(self._now, self.gate.enabled, self.gate.voltage(self._now))
        if order.stop:
            self.gate = self.gate.stop(order.stop)
        if self.plugged:
            self.emulator.chip.feed(self._pass_on(self._out, order.data))

    def _answer(self, sample) -> None:  # type: ignore[no-untyped-def]
        if self.raw is not None:
            self._reason = ""
            self._command(self.raw)
        elif self.alive:
            values = {**DEFAULTS, **self.motor.settings(self.driver.info, model=False)}
            fresh, self.reference = self.reference, None
            config = config_of(values, self.driver.info)  # type: ignore[arg-type]
            output, self.state = controller.update(config, self.state, sample, fresh, self.time)
            self._take(output)

    def _watch(self) -> None:
        if self.alive and self.raw is None:
            values = {**DEFAULTS, **self.motor.settings(self.driver.info, model=False)}
            output, self.state = controller.watch(
                config_of(values, self.driver.info),  # type: ignore[arg-type]
                self.state,
                self.time,
            )
            if output is not None:
                self._take(output)

    def _take(self, output) -> None:  # type: ignore[no-untyped-def]
        self._reason = output.reason if output.state != "running" else ""
        if output.begins:
            self._command(0.0)
        if output.drives:
            self._command(output.terms.voltage)

    def _command(self, voltage: float) -> None:
        self._sent += 1
        self.gate = self.gate.take(voltage, self._now, "", self._sent)
