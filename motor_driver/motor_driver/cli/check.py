"""`check`: a safe first run with a new board."""

import argparse
import json
import sys
import time
from contextlib import suppress
from pathlib import Path

from motor_driver.check import result, words
from motor_driver.check.first_run import FirstRun
from motor_driver.check.settings import Settings
from motor_driver.cli._check_options import parser, settings_of
from motor_driver.cli._check_terminal import run_on
from motor_driver.link import candidates
from motor_driver.ports.port_error import COMMAND, PortError
from motor_driver.ports.search import the_only
from motor_model.errors import MotorError
from motor_model.regular_file import say_refusal, write_text
from motor_ros.command.shell import shell
from motor_ros.output_files import check_outputs


def main(args: list[str] | None = None) -> int:
    """`ros2 run motor_driver check`."""
    options = parser().parse_args(args)
    return shell(lambda: _check(options))


def _check(options: argparse.Namespace) -> int:
    check_outputs([path for path in (options.output, options.json) if path], options.force)
    settings = settings_of(options)
    run, port = _run(options, settings)
    return _end(options, settings, run, port)


def _run(options: argparse.Namespace, settings: Settings) -> tuple[FirstRun, str]:
    """The run on the port that was named, or on the one whose board has the number.

    Raises:
        MotorError: there is none, or nobody knows which.
    """
    try:
        found = candidates(options.port, settings.board_id is not None, COMMAND)
        matches = found if len(found) == 1 else [port for port in found if _matches(options, settings, port)]
        port = the_only(matches, found, COMMAND)
        return run_on(options, settings, port), port
    except PortError as error:
        raise MotorError(str(error)) from error


def _matches(options: argparse.Namespace, settings: Settings, port: str) -> bool:
    """Whether the board on a port has the number; a port in use is somebody else's."""
    try:
        return run_on(options, settings, port, roll_call=True).driver.matches
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
    chosen = result.Chosen(port, options.name, options.decay, options.silent_pwm)
    said = [words.verdict_of(run.check)]
    if options.json:
        _write(options.json, json.dumps(result.as_json(run.check, chosen), indent=1, ensure_ascii=False) + "\n")
    if run.check.right and options.output:
        _write(options.output, result.parameter_text(run.check, chosen))
        said.append(f"parameters: {options.output}")
        said.append(f"next: ros2 run motor_driver motor_driver --ros-args --params-file {options.output}")
    with suppress(BrokenPipeError):  # who does not read to the end is told by the exit status all the same
        print("\n".join(said), flush=True)
    return 0 if run.check.right else 1


def _write(path: Path, text: str) -> None:
    try:
        write_text(path, text)
    except OSError as error:
        raise MotorError(f"cannot write {path} {say_refusal(error)}.") from error


if __name__ == "__main__":
    sys.exit(main())
