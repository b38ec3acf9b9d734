"""First runs on simulated and emulated boards that are wired in some way, with somebody beside them who obeys."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import copysign, tau

import numpy as np

from motor_board.build import FirmwareConfig, firmware
from motor_board.emulation.chip import FREQUENCY
from motor_board.emulation.emulator import Emulator
from motor_board.emulation.shaft import EncoderConfig
from motor_board.emulation.wiring import Wiring
from motor_driver.check.check import Check
from motor_driver.check.first_run import FirstRun
from motor_driver.check.look import Act, Answer, Look, Prompt
from motor_driver.check.settings import Settings, config_of
from motor_driver.frames.codes import BAUD
from motor_driver.frames.from_board import Hello
from motor_model.gearing.gear import exact_gear
from motor_model.parameters import Parameters
from motor_model.sensing.board import BoardConfig, SimulatedBoard
from motor_model.sensing.encoder import Lines

HANDS_SPEED = 3.0  # [rad/s]
GIVES_UP = 2.0  # [s] a hand on a shaft that does not move
FULL_SCALE = 60_000  # [mV] of the supply's divider


def motor(top: float = 174.0, voltage: float = 12.0, tau_s: float = 0.08, friction: float = 0.06) -> Parameters:
    """A motor by its top speed [rad/s], voltage [V], time constant [s], and friction as a share of the voltage."""
    kv = voltage * (1.0 - friction) / top
    ks = friction * voltage
    values = {"kv": kv, "ka": kv * tau_s, "ks": ks, "breakaway_voltage": 1.4 * ks, "stribeck_speed": 0.05 * top}
    return Parameters(values, ("static_friction",), max_voltage=voltage)


@dataclass
class Person:
    """Turns the shaft when asked, to within a few degrees, and says what it does."""

    parameters: Parameters
    turns: float = 1.0  # with the error of the hand
    begun: float | None = None  # [s] of the present prompt
    prompt: Prompt | None = None
    start: float = 0.0  # [rad]
    way: int = 0  # of the latest motion
    still_since: float = 0.0
    said: bool = False

    def obey(self, prompt: Prompt | None, time: float, angle: float, speed: float) -> tuple[float, Answer | None]:
        """[V] with which the hand turns the shaft, and what it answers now."""
        if prompt is not self.prompt:
            self.prompt, self.begun, self.start, self.still_since, self.said = prompt, time, angle, time, False
        moving = abs(speed) > 0.02
        if moving:
            self.still_since = time
        if moving and prompt is None:
            self.way = 1 if speed > 0.0 else -1
        if self.said or prompt in (None, Prompt.HANDS_OFF):
            return 0.0, None
        if prompt is Prompt.TURN:
            return self._turn(time, angle, speed)
        if self.begun is None or time - self.begun < 0.3:
            return 0.0, None
        self.said = True
        right = moving if prompt is Prompt.TURNS else self.way > 0
        return 0.0, Answer.YES if right else Answer.NO

    def _turn(self, time: float, angle: float, speed: float) -> tuple[float, Answer | None]:
        left = self.turns * tau - (angle - self.start)
        if left < 0.02 or time - self.still_since > GIVES_UP:
            self.said = True
            return 0.0, Answer.DONE if left < 0.02 else Answer.NO
        wanted = min(6.0 * left + 0.1, HANDS_SPEED)
        kv, ka = self.parameters.values["kv"], self.parameters.values["ka"]
        friction = max(self.parameters.value("ks"), self.parameters.value("breakaway_voltage"))
        return kv * wanted + copysign(1.1 * friction, wanted) + ka * (wanted - speed) / 0.05, None


def hello(channels: int = 1, edges: int = 0, board_id: int = 0) -> Hello:
    """What a board says of itself."""
    return Hello(1, 2, 0, 1, board_id, edges, channels, 500, 255, 0, 10_000, 2_000, 100, 1, 1, 1)


@dataclass
class SimulatedRun:
    """The state machine alone, by plain calls, on the simulated motor."""

    settings: Settings = field(default_factory=Settings)
    parameters: Parameters = field(default_factory=motor)
    wiring: Wiring = field(default_factory=Wiring)
    channels: int = 1
    edges: int = 96
    gear: float = 1.0
    supply: float = float("nan")  # [V] measured
    seed: int = 0
    turns: float = 1.0

    def __post_init__(self) -> None:
        config = BoardConfig(
            edges_per_revolution=self.edges,
            single_channel=self.channels == 1,
            seed=self.seed,
            gear=exact_gear(self.gear),
        )
        stuck = {"ks": 1e4, "breakaway_voltage": 1e4} if self.wiring.shaft_stuck else {}
        true = replace(self.parameters, values={**self.parameters.values, **stuck}, max_voltage=1e3)
        self.board = SimulatedBoard(true, config)
        self.check = Check(self.settings, hello(self.channels))
        self.person = Person(self.parameters, self.turns)
        self.acts: list[tuple[float, Act, float]] = []  # [s], what was done, [rad/s] true speed

    def run(self, seconds: float = 120.0) -> Check:
        """Until it is done; at most so long."""
        volts, act, answer = 0.0, Act(), None
        for k in range(round(seconds * 200.0)):
            sample = self.board.sample(volts)
            time = sample.sample_time * 1e-9
            count, edge_time = self._sensed(sample.edge_count, sample.edge_time * 1e-9, time)
            look = Look(time, count, edge_time, act.voltage, act.on, self.supply, answer=answer)
            act = self.check.see(look)
            hand, answer = self.person.obey(act.prompt, time, self.board.angle, self.board.speed)
            if not self.settings.hand:
                hand, answer = 0.0, None
            share = self.wiring.drive(act.voltage / self.settings.max_voltage if act.on else 0.0)
            volts = share * self.settings.max_voltage + hand
            self.acts.append((time, act, self.board.speed))
            if self.check.done:
                break
            assert k < seconds * 200 - 1, "it did not come to its end"
        return self.check

    def _sensed(self, count: int, edge_time: float, time: float) -> tuple[int, float]:
        """What the board counts, wired as it is."""
        if not self.wiring.a_connected:
            count, edge_time = 0, 0.0
        if not self.wiring.b_connected and self.channels == 2:
            count = -(count % 2)
        if self.wiring.channels_swapped:
            count = -count
        if self.wiring.hum > 0.0:
            rises, falls = (int(np.floor(time * self.wiring.hum - part)) for part in (0.0, 0.4))
            times = (rises, falls + 0.4) if self.channels == 2 else (rises,)
            edge_time = max((edge_time, *(at / self.wiring.hum for at in times)))
            count += rises if self.channels == 1 else rises - falls
        return count, edge_time


@dataclass
class EmulatedRun:
    """The real firmware on the emulated chip, driver and check, in lockstep; times are the chip's."""

    settings: Settings = field(default_factory=Settings)
    parameters: Parameters = field(default_factory=motor)
    wiring: Wiring = field(default_factory=Wiring)
    config: FirmwareConfig = field(default_factory=FirmwareConfig)
    edges: int = 96
    gear: float = 1.0
    supply: float = 12.0  # [V]
    seed: int = 0
    turns: float = 1.0

    def __post_init__(self) -> None:
        two = self.config.channels == 2
        encoder = EncoderConfig(
            self.edges,
            0.01,
            self.seed,
            channels=self.config.channels,
            lines=Lines(0.45, 0.22) if two else None,
            gear=exact_gear(self.gear),
        )
        fed = replace(self.parameters, max_voltage=self.supply)
        self.emulator = Emulator(firmware(self.config), fed, encoder)
        self.emulator.supply(5e3 * self.supply / FULL_SCALE)
        self.emulator.wiring = self.wiring
        self.person = Person(self.parameters, self.turns)
        self.run_ = FirstRun(self.settings, config_of(self.settings, BAUD, 0), "the port", self.now)
        self.pins: list[tuple[float, float]] = []  # [s], [V] that the pins ask for
        self.asked: list[tuple[float, float]] = []  # [s], [V] that the check asks for

    @property
    def now(self) -> int:
        """[ns] the host's clock."""
        return 1 + self.emulator.chip.cycle * 125 // 2

    def run(self, seconds: float = 120.0) -> FirstRun:
        """Until it is done, or has a problem, and 0.1 s more."""
        end, ends = self.now + round(seconds * 1e9), None
        while ends is None or self.now < ends:
            assert self.now < end, "it did not come to its end"
            self._step()
            if ends is None and (self.run_.done or self.run_.problem(self.now)):
                ends = self.now + 100_000_000
        self.emulator.close()
        return self.run_

    def _step(self) -> None:
        chip, shaft, run = self.emulator.chip, self.emulator.shaft, self.run_
        self.emulator.run(chip.cycle + FREQUENCY // 1000)
        run.received(chip.drain(), self.now)
        seconds = self.now * 1e-9
        hand, answer = self.person.obey(run.prompt, seconds, shaft.angle, shaft.speed)
        if self.settings.hand:
            self.emulator.wiring = replace(self.wiring, hand=hand)
            if answer is not None:
                run.answer(answer)
        chip.feed(run.step(self.now))
        self.pins.append((seconds, self.emulator.chip.pins.share * self.supply))
        act = run.check.act if run.check else Act()
        self.asked.append((seconds, act.voltage if act.on else 0.0))
