"""The terminal of `check`: bytes between port and run, keys to it, its words to the screen."""

import argparse
import os
import select
import signal
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress

from motor_driver.check import words
from motor_driver.check.first_run import FirstRun
from motor_driver.check.look import Prompt
from motor_driver.check.settings import Settings, config_of
from motor_driver.frames.codes import Decay, Pwm
from motor_driver.link import open_port
from motor_driver.ports.port_error import COMMAND
from motor_model.errors import MotorError
from motor_ros.run import Interrupt

LOOK_EVERY = 0.004  # [s]
MOST_READ = 4096
OFF_TIME = 0.3  # [s] in which the board says that its output is off
UNREAD = "nobody reads what the check says any more"
STOPPED = "The check has stopped the motor: {}."


def run_on(options: argparse.Namespace, settings: Settings, port: str, roll_call: bool = False) -> FirstRun:
    """Run on a port to the end, with the output off; at a roll call its board only says who it is.

    Raises:
        PortError: it cannot be opened.
        KeyboardInterrupt: somebody pressed Ctrl-C, or ended us otherwise; the motor is off.
        MotorError: nobody reads what is said; the motor is off.
    """
    with _interruptible() as interrupt:
        return _Terminal(options, settings, port, interrupt, roll_call).run()


@contextmanager
def _interruptible() -> Iterator[Interrupt]:
    """Within, Ctrl-C is noted, and the motor is switched off in order."""
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)}
    try:
        yield Interrupt()
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


class _Terminal:
    """Passes bytes between port and run, keys to it, and its words to the screen."""

    def __init__(
        self,
        options: argparse.Namespace,
        settings: Settings,
        port: str,
        interrupt: Interrupt,
        roll_call: bool = False,
    ) -> None:
        decay = Decay[options.decay.upper()]
        self._interrupt, self._settings, self._name = interrupt, settings, port
        self._port = open_port(port, options.baud, COMMAND)
        config = config_of(settings, options.baud, decay, Pwm.SILENT if options.silent_pwm else Pwm.STANDARD)
        self._run = FirstRun(settings, config, port, time.monotonic_ns(), roll_call)
        self._shown, self._ended, self._hung_up, self._typed = 0, False, False, b""
        if settings.hand and sys.stdin is None:  # it was closed before we started
            self._run.hear("")
        self._prompt: Prompt | None = None
        self._readers = select.poll()
        with suppress(OSError):  # no file: nobody can close it
            self._readers.register(sys.stdout, 0)  # hang-ups and errors are told unasked

    def run(self) -> FirstRun:
        """Until it has come to its end, with the output off."""
        try:
            while not self._run.done and not self._run.driver.unsuitable(time.monotonic_ns()):
                self._step()
                self._show()
                if self._readers.poll(0):
                    raise BrokenPipeError
                if self._interrupt:
                    self._run.abort(self._interrupt.cause)
                    break
        except BrokenPipeError as error:  # a person who sees nothing cannot answer, nor say stop
            raise MotorError(STOPPED.format(UNREAD)) from error
        finally:
            self._leave()
        self._show()
        if self._interrupt:
            raise KeyboardInterrupt
        return self._run

    def _leave(self) -> None:
        """Switch off, and see that the board has."""
        self._run.abort("the check has failed")
        end = time.monotonic() + OFF_TIME
        while not self._ended and time.monotonic() < end:
            self._step()
            if self._run.off:
                break
        self._port.close()

    def _step(self) -> None:
        """Take what has come, then send what is due."""
        listens = self._settings.hand and not self._ended and not self._hung_up  # a terminal's end is always ready
        keys = [sys.stdin] if listens and sys.stdin else []
        try:
            ready, _, _ = select.select([self._port, *keys], [], [], LOOK_EVERY)
            data = os.read(self._port.fileno(), MOST_READ) if self._port in ready else None
            if data == b"":
                raise OSError
            if keys and sys.stdin in ready:
                self._hear_keys()
            now = time.monotonic_ns()
            if data:
                self._run.received(data, now)
            os.write(self._port.fileno(), self._run.step(now))
        except BlockingIOError:
            return
        except OSError:
            self._ended = True
            self._run.driver.closed(f"The serial port {self._name} is gone: plug the board in again.")
            self._run.abort(f"the serial port {self._name} is gone")

    def _hear_keys(self) -> None:
        """Take what was typed; nothing, or an error of its own, is the end of the terminal.

        Without a newline it is no answer yet, and nobody waits for the rest: the board has to hear of us meanwhile.
        """
        try:
            typed = os.read(sys.stdin.fileno(), MOST_READ)
        except OSError:
            typed = b""
        if not typed:
            self._hung_up = True
            self._run.hear("")
        *lines, self._typed = (self._typed + typed).split(b"\n")
        for line in lines:
            self._run.hear(line.decode(errors="replace") + "\n")

    def _show(self) -> None:
        """Say what is new."""
        check = self._run.check
        if check is None:
            return
        if self._shown == 0:
            print(words.plan_of(self._settings))
        rows = [words.board_row(check.board, self._name), *check.record.rows]
        for row in rows[self._shown :]:
            print(words.line_of(row), flush=True)
        self._shown = len(rows)
        prompt = self._run.prompt
        if prompt is not None and prompt is not self._prompt and self._settings.hand:
            print(words.prompt_of(prompt, self._settings), flush=True)
        self._prompt = prompt
