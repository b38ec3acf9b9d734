"""The paper's loop on the emulated board: the real firmware on its chip, the motor with friction on its pins."""

import numpy as np
from paper_loop import MAX_VOLTAGE, Assumption, Run, law

from motor_board.build import FirmwareConfig, chip_library, firmware
from motor_board.emulation.chip import FREQUENCY
from motor_board.emulation.emulator import CurrentSensor, Emulator
from motor_board.emulation.shaft import EncoderConfig
from motor_driver.config import Config
from motor_driver.frames.from_board import Hello, Telemetry
from motor_driver.frames.from_host import Command, Enable, Identify
from motor_driver.frames.table import Frame
from motor_driver.protocol import Arrival, Decoder, Encoder
from motor_driver.readout import Readout
from motor_model.parameters import Parameters
from motor_model.sample import Sample

MS = FREQUENCY // 1000  # [cycle]
STEP = MS // 20  # [cycle] between two looks at the port
PATIENCE = 250  # [ms] for what a board does at its start


class EmulatedBoard:
    """A board in lockstep with its user: nothing happens but what is run."""

    def __init__(
        self, motor: Parameters, rate: float, irregularity: float, seed: int, current_gain: float = 0.0
    ) -> None:
        """With a `current_gain` [V/A] the board senses the current."""
        elf = firmware(FirmwareConfig(current_sense=current_gain > 0.0))
        self._emulator = Emulator(elf, motor, EncoderConfig(slot_irregularity=irregularity, seed=seed))
        self._emulator.sensor = CurrentSensor(current_gain)
        self._encode, self._decode = Encoder(), Decoder()
        config = Config(sample_rate=rate, max_voltage=MAX_VOLTAGE, current_gain=current_gain)
        self._run(8 * MS)
        self._emulator.chip.feed(b"\0")
        board = self._ask(Identify(), Hello)
        self._ask(config.configure(board), Hello)
        self._readout = Readout(config, board)
        self.info = config.info(board)
        latest = self._next()
        while not latest.enabled:
            self._send(Enable(1, latest.boot, latest.latch))
            latest = self._next()

    @property
    def speed(self) -> float:
        """[rad/s] true."""
        return self._emulator.shaft.speed

    def sample(self) -> Sample:
        """Run to the next telemetry."""
        frame = self._next()
        self._readout.clock.hear(frame.time, self._emulator.chip.cycle * 1_000_000_000 // FREQUENCY)
        return self._readout.sample(frame)

    def command(self, voltage: float) -> None:
        """Ask for a voltage [V], to be latched at the next sample tick."""
        self._send(Command(self._readout.duty(voltage)))

    def close(self) -> None:
        self._emulator.close()

    def _run(self, cycles: int) -> list[Frame]:
        chip = self._emulator.chip
        self._emulator.run(chip.cycle + cycles)
        events = self._decode.receive(chip.drain())
        return [event.frame for event in events if isinstance(event, Arrival)]

    def _send(self, frame: Frame) -> None:
        self._emulator.chip.feed(self._encode.send(frame))

    def _ask(self, question: Frame, kind: type[Frame]) -> Hello:
        self._send(question)
        return self._wait(Hello)

    def _next(self) -> Telemetry:
        return self._wait(Telemetry)

    def _wait(self, kind):  # type: ignore[no-untyped-def]
        end = self._emulator.chip.cycle + PATIENCE * MS
        while self._emulator.chip.cycle < end:
            for frame in self._run(STEP):
                if isinstance(frame, kind):
                    return frame
        raise RuntimeError(f"the board has sent no {kind.__name__}")


def available() -> str:
    """Why there is no emulated board here; empty if there is one."""
    from motor_board.errors import BoardError

    try:
        firmware(), chip_library()
    except BoardError as error:
        return str(error)
    return ""


def run_emulated(pair: tuple[float, float], assumption: Assumption, motor: Parameters, seed: int = 0) -> Run:
    """One second from rest with a gain pair on the emulated board, its disc 1 % irregular."""
    board = EmulatedBoard(motor, assumption.rate, 0.01, seed)
    answer = law(pair, assumption)
    rows = np.empty((round(assumption.rate), 4))
    for k in range(len(rows)):
        sample = board.sample()
        voltage = answer(sample, k / assumption.rate)
        board.command(voltage)
        rows[k] = k / assumption.rate, board.speed, sample.speed, voltage
    board.close()
    return Run(rows[:, 0], rows[:, 1], rows[:, 2], rows[:, 3])
