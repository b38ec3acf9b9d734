"""`check`: a safe first run with a new board."""

import argparse
import json
import os
import select
import signal
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from motor_driver.check import result, words
from motor_driver.check.first_run import FirstRun
from motor_driver.check.look import Answer, Prompt
from motor_driver.check.settings import Settings, config_of
from motor_driver.frames import BAUD, Decay, Pwm
from motor_driver.link import candidates, open_port
from motor_driver.parameters import MOST_ID
from motor_driver.ports.port_error import PortError
from motor_driver.ports.search import the_only
from motor_model.errors import MotorError
from motor_model.gearing.gear import parse_gear_ratio
from motor_model.regular_file import write_text
from motor_ros.command import CommandParser, between, positive, shell, whole_between
from motor_ros.output_files import add_force_option, check_outputs
from motor_ros.run import Interrupt

LOOK_EVERY = 0.004  # [s]
MOST_READ = 4096
OFF_TIME = 0.3  # [s] in which the board says that its output is off
ANSWERS = {"": Answer.DONE, "y": Answer.YES, "n": Answer.NO}


def parser() -> argparse.ArgumentParser:
    """The command line."""
    parser = CommandParser(
        "motor_driver",
        "check",
        "Check a new board step by step: supply, encoder, a little voltage both ways. Says what is wired wrong, and "
        "writes the driver's parameter file if all is right. The driver must not run at the same time.",
        "example: ros2 run motor_driver check --max-voltage 12 --edges-per-revolution 96 --output motor.yaml",
    )
    add = parser.add_argument
    add("--port", default="", metavar="PORT", help="the board's serial port (default: the only one on USB)")
    add("--board-id", type=whole_between(0, MOST_ID), metavar="N", help="number the board was flashed with")
    add("--baud", type=whole_between(9600, 4_000_000), default=BAUD, metavar="N", help=f"default {BAUD}")
    add("--max-voltage", type=between(0.1, 100.0), default=12.0, metavar="V", help="of the motor (default 12)")
    add("--supply-voltage", type=between(0.0, 100.0), default=0.0, metavar="V", help="default: as --max-voltage")
    add(
        "--edges-per-revolution",
        type=whole_between(1, 100_000),
        metavar="N",
        help="encoder edges of one polarity per turn (default: as flashed)",
    )
    add(
        "--pulses-per-revolution",
        type=whole_between(1, 65535),
        metavar="N",
        help="periods of one channel per turn of the encoder's shaft (the same as edges of one polarity)",
    )
    add("--quadrature", type=int, choices=(1, 2, 4), default=1, help="with which the driver is to count (default 1)")
    add("--gear-ratio", default="1", metavar="R", help="encoder turns per turn of the output: 34.014, 9291/273")
    add("--channels", type=int, choices=(1, 2), help="of the encoder (default: as flashed)")
    add("--silent-pwm", action="store_true", help="PWM above hearing")
    add("--decay", choices=[decay.name.lower() for decay in Decay], default="brake", help="default brake")
    add("--current-gain", type=between(-10.0, 10.0), default=0.0, metavar="V/A", help="of a current sensor on A1")
    add("--current-offset", type=between(0.0, 5.0), default=2.5, metavar="V", help="of it (default 2.5)")
    add("--turns", type=whole_between(1, 100), default=1, metavar="N", help="to turn the shaft by hand (default 1)")
    add("--time-limit", type=positive, default=30.0, metavar="S", help="for an answer (default 30)")
    add("--no-hand", action="store_true", help="nobody is there to turn the shaft or to answer")
    add(
        "--name",
        default="",
        help="of the motor, for the parameter file (default: left out)",
    )
    add("--output", type=Path, metavar="FILE", help="write the driver's parameters here, if all is right")
    add("--json", type=Path, metavar="FILE", help="write all that was found here")
    add_force_option(parser)
    return parser


def main(args: list[str] | None = None) -> int:
    """`ros2 run motor_driver check`."""
    options = parser().parse_args(args)
    return shell(lambda: _check(options))


def _check(options: argparse.Namespace) -> int:
    check_outputs([path for path in (options.output, options.json) if path], options.force)
    pulses = options.pulses_per_revolution or options.edges_per_revolution
    if options.pulses_per_revolution and options.edges_per_revolution not in (None, pulses):
        raise MotorError("--pulses-per-revolution and --edges-per-revolution are the same thing here: say one of them.")
    settings = Settings(
        max_voltage=options.max_voltage,
        supply_voltage=options.supply_voltage,
        edges_per_revolution=pulses,
        quadrature=options.quadrature,
        gear=parse_gear_ratio(options.gear_ratio),
        gear_said=options.gear_ratio.strip(),
        single_channel=None if options.channels is None else options.channels == 1,
        board_id=options.board_id,
        current_gain=options.current_gain,
        current_offset=options.current_offset,
        hand=not options.no_hand and sys.stdin.isatty(),
        turns=options.turns,
        hand_time=options.time_limit,
    )
    run, port = _run(options, settings)
    return _end(options, settings, run, port)


def _run(options: argparse.Namespace, settings: Settings) -> tuple[FirstRun, str]:
    """The run on the port that was named, or on the one whose board has the number.

    Raises:
        MotorError: there is none, or nobody knows which.
    """
    try:
        found = candidates(options.port, search=settings.board_id is not None)
        matches = found if len(found) == 1 else [port for port in found if _matches(options, settings, port)]
        port = the_only(matches, found)
        with _interruptible() as interrupt:
            return _Terminal(options, settings, port, interrupt).run(), port
    except PortError as error:  # nobody tries again here
        raise MotorError(str(error).replace("; retrying", "")) from error


def _matches(options: argparse.Namespace, settings: Settings, port: str) -> bool:
    """Whether the board on a port has the number; a port in use is somebody else's."""
    try:
        with _interruptible() as interrupt:
            return _Terminal(options, settings, port, interrupt, roll_call=True).run().driver.matches
    except PortError:
        return False


def _end(options: argparse.Namespace, settings: Settings, run: FirstRun, port: str) -> int:
    """Write and say what was found."""
    now = time.monotonic_ns()
    if run.check is None:
        sentence = run.problem(now) or f"Nothing on {port} answers."
        if options.json:
            _write(options.json, json.dumps(result.refused_json(settings, port, run.code, sentence), indent=1) + "\n")
        raise MotorError(sentence)
    said = (run.check, options.name, port, options.decay, options.silent_pwm)
    print(words.verdict_of(run.check))
    if options.json:
        _write(options.json, json.dumps(result.as_json(*said), indent=1, ensure_ascii=False) + "\n")
    if run.check.right and options.output:
        _write(options.output, result.parameter_text(*said))
        print(f"parameters: {options.output}")
        print(f"next: ros2 run motor_driver motor_driver --ros-args --params-file {options.output}")
    return 0 if run.check.right else 1


def _write(path: Path, text: str) -> None:
    try:
        write_text(path, text)
    except OSError as error:
        raise MotorError(f"cannot write {path}: {error.strerror}.") from error


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
        self._port = open_port(port, options.baud)
        config = config_of(settings, options.baud, decay, Pwm.SILENT if options.silent_pwm else Pwm.STANDARD)
        self._run = FirstRun(settings, config, port, time.monotonic_ns(), roll_call)
        self._shown, self._ended = 0, False
        self._prompt: Prompt | None = None

    def run(self) -> FirstRun:
        """Until it has come to its end, with the output off."""
        try:
            while not self._run.done and not self._run.driver.unsuitable(time.monotonic_ns()):
                self._step()
                self._show()
                if self._interrupt:
                    self._run.abort("Ctrl-C")
                    break
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
        keys = [sys.stdin] if self._settings.hand and not self._ended else []
        try:
            ready, _, _ = select.select([self._port, *keys], [], [], LOOK_EVERY)
            data = os.read(self._port.fileno(), MOST_READ) if self._port in ready else None
            if data == b"":
                raise OSError
            if keys and sys.stdin in ready:
                self._hear_keys(sys.stdin.readline())
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

    def _hear_keys(self, line: str) -> None:
        answer = ANSWERS.get(line.strip().lower()[:1])
        if answer is not None:
            self._run.answer(answer)

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


if __name__ == "__main__":
    sys.exit(main())
