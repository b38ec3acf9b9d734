"""The emulated board in real time: its serial port is a pseudo-terminal, its clock is the computer's."""

import threading
import time
from dataclasses import dataclass

from motor_board.emulation.chip import FREQUENCY, Hang
from motor_board.emulation.emulator import Emulator
from motor_board.emulation.faults import Faults
from motor_board.emulation.port import Port
from motor_board.emulation.serial_line import SerialLine
from motor_board.errors import BoardError

PERIOD = 1_000_000  # [ns] between two looks at the port
MOST_BEHIND = 40_000_000  # [ns] held up for longer, the board's time stands still: no command could reach it meanwhile


@dataclass(frozen=True)
class Truth:
    """What only the emulator knows."""

    start: int  # [ns] CLOCK_MONOTONIC at the chip's cycle 0 (moves if the emulator is held up)
    rate: float  # [cycle/ns]
    cycle: int
    clock_zero: int  # cycle at which the board's own clock was last at 0
    resets: int
    speed: float  # [rad/s] true shaft speed
    angle: float  # [rad]
    voltage: float  # [V] at the pins
    held_up: int  # times that the emulator did not keep up
    busy: float  # share of the time spent emulating

    def named(self, to_ros: int) -> dict[str, float]:
        """For people, with units; `to_ros` [ns] turns CLOCK_MONOTONIC into ROS time."""
        return {
            "board clock zero [ns, ROS time]": self.start + to_ros + round(self.clock_zero / self.rate),
            "clock rate": self.rate / 16e-3,
            "true speed [rad/s]": self.speed,
            "true angle [rad]": self.angle,
            "voltage at the pins [V]": self.voltage,
            "resets": self.resets,
            "held up": self.held_up,
            "busy": round(self.busy, 3),
        }


class LiveBoard:
    """Runs an emulator in a thread of its own, with a port and faults."""

    def __init__(self, emulator: Emulator, port: Port, seed: int = 0) -> None:
        self._emulator, self._port = emulator, port
        self._in, self._out = SerialLine(seed), SerialLine(seed + 1)
        self._faults = Faults()
        emulator.run(1)  # compiled now, not while the clock runs
        self._start = time.monotonic_ns()
        self._rate = FREQUENCY * 1e-9
        self._held_up, self._busy = 0, 0
        self._reset_asked, self._hang_asked = threading.Event(), threading.Event()
        self._ended = threading.Event()
        self.error: BoardError | None = None  # what ended the thread
        self._thread = threading.Thread(target=self._run, name="board", daemon=True)
        port.plug()
        self._thread.start()

    @property
    def faults(self) -> Faults:
        """The switches in force; assign to change them."""
        return self._faults

    @faults.setter
    def faults(self, faults: Faults) -> None:
        self._faults = faults

    def reset(self) -> None:
        """Press the board's reset button."""
        self._reset_asked.set()

    def hang(self) -> None:
        """Let the firmware fall into an endless loop."""
        self._hang_asked.set()

    def truth(self) -> Truth:
        """A look behind the scenes."""
        chip, shaft = self._emulator.chip, self._emulator.shaft
        running = max(time.monotonic_ns() - self._start, 1)
        return Truth(
            start=self._start,
            rate=self._rate,
            cycle=chip.cycle,
            clock_zero=chip.clock_zero,
            resets=chip.resets,
            speed=shaft.speed,
            angle=shaft.angle,
            voltage=shaft.voltage,
            held_up=self._held_up,
            busy=self._busy / running,
        )

    def close(self) -> None:
        """Stop, and take the port away."""
        self._ended.set()
        self._thread.join()
        self._port.close()
        self._emulator.close()

    def _run(self) -> None:
        due = time.monotonic_ns()
        try:
            while not self._ended.is_set():
                began = time.monotonic_ns()
                self._step()
                ended = time.monotonic_ns()
                self._busy += ended - began
                due = max(due + PERIOD, ended)
                time.sleep((due - ended) * 1e-9)
        except BoardError as error:
            self.error = error
        except OSError as error:
            self.error = BoardError(f"the emulated board's port has failed ({error.strerror}): start it again.")

    def _step(self) -> None:
        """Bring the board up to now, with what has come and gone meanwhile."""
        faults = self._faults
        self._switch(faults)
        received = self._port.read()
        now = time.monotonic_ns()
        self._emulator.run(self._goal(now))
        out = self._emulator.chip.drain()
        self._out.send(b"" if faults.stuck_telemetry else out, faults, now)
        self._port.write(self._out.receive(now))
        self._in.send(received, faults, now)
        self._emulator.chip.feed(self._in.receive(now))  # after it ran: no byte arrives before it was sent

    def _switch(self, faults: Faults) -> None:
        """Follow the switches and buttons."""
        if faults.plugged != self._port.plugged:
            self._in.cut()
            self._out.cut()
            self._port.plug() if faults.plugged else self._port.unplug()
        self._emulator.encoder_connected, self._emulator.stray_edges = faults.encoder_connected, faults.stray_edges
        self._emulator.wiring = faults
        opened = self._port.opened()
        if opened:  # what the board has said until now is lost, also where it was held up and says it only now
            self._emulator.run(self._goal(time.monotonic_ns()))
            self._emulator.chip.drain()
            self._in.cut()
            self._out.cut()
        if self._reset_asked.is_set() or (opened and faults.reset_on_open):
            self._reset_asked.clear()
            self._emulator.reset()
        if self._hang_asked.is_set():
            self._hang_asked.clear()
            self._emulator.chip.hang(Hang.LOOPING)
        rate = FREQUENCY * 1e-9 * (1.0 + faults.clock_error * 1e-6)
        if rate != self._rate:
            self._start = time.monotonic_ns() - round(self._emulator.chip.cycle / rate)
            self._rate = rate

    def _goal(self, now: int) -> int:
        """The chip's cycle at `now`."""
        cycle = self._emulator.chip.cycle
        behind = now - self._start - round(cycle / self._rate)
        if behind > MOST_BEHIND:
            self._start += behind - PERIOD
            self._held_up += 1
        return round((now - self._start) * self._rate)
