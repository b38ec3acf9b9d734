"""`explore`: experiment, diagnose, the experiment that the diagnosis asks for, diagnose again, in one command."""

import argparse
import os
import signal
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from motor_identification.cli.identify import add_effects_option, list_effects
from motor_identification.cli.options.plant import add_plant_options, passed_on
from motor_model.excitation import PROFILES
from motor_ros.command.parser import CommandParser
from motor_ros.command.shell import shell

if TYPE_CHECKING:
    from motor_identification.cli._diagnosed import Files
    from motor_identification.diagnosis.result import Diagnosis


def parser() -> argparse.ArgumentParser:
    """Make the command line's parser."""
    parser = CommandParser(
        "motor_identification",
        "explore",
        "Drive a motor through a profile, diagnose the recording, drive the profile that the diagnosis "
        "suggests, and diagnose all recordings together, until nothing is open. Drives the live plant (motor_sim or "
        "motor_driver), or with --model a simulated motor offline. The motor stands still whenever nothing is "
        "recorded, and however this ends.",
        "DIRECTORY gets a bag for every round, and after each report.html, model.yaml and diagnosis.json.\n"
        "Profiles: see experiment --help.\n\n"
        "example:\n  ros2 run motor_identification explore explored --voltage 6",
    )
    parser.add_argument("directory", metavar="DIRECTORY", help="for everything; must not exist, or be empty")
    parser.add_argument("--profile", choices=list(PROFILES), default="rich", metavar="P", help="first (default rich)")
    parser.add_argument("--rounds", type=_rounds, default=3, metavar="N", help="experiments at most (default 3)")
    add_effects_option(parser, "--known-effects", "in the model already, separated by commas")
    add_plant_options(parser)
    return parser


def _rounds(text: str) -> int:
    if int(text) < 1:
        raise argparse.ArgumentTypeError("at least 1")
    return int(text)


def main(args: list[str] | None = None) -> int:
    """`ros2 run motor_identification explore`."""
    options = parser().parse_args(args)
    return shell(lambda: _explore(options))


def _explore(options: argparse.Namespace) -> int:
    from motor_identification.cli._diagnosed import Files
    from motor_model.effects import normalised

    normalised(list_effects("--known-effects", options.known_effects))  # a wrong name is refused before anything moves
    directory, files = _made(Path(options.directory)), Files(report=options.directory)
    profiles: list[str] = []
    bags: list[str] = []
    following = options.profile
    try:
        while following:
            profiles.append(following)
            bags.append(str(directory / f"{len(profiles)}_{following}"))
            status = _recorded(following, bags[-1], options)
            if status != 0:
                return status
            diagnosis = _diagnosed(bags, options, files)
            following, why = _following(diagnosis, profiles, options.rounds)
            print(why)
    except KeyboardInterrupt:
        print(f"Interrupted; what was recorded is in {directory}.", file=sys.stderr)
        raise
    return 0


def _recorded(profile: str, bag: str, options: argparse.Namespace) -> int:
    """One experiment; returns its exit status."""
    from motor_identification.cli import experiment

    handlers = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)}
    try:
        return experiment.main([profile, "--output", bag, *passed_on(options)])
    finally:  # a live experiment has handlers of its own, under which nothing later could be interrupted
        for number, handler in handlers.items():
            signal.signal(number, handler)


def _diagnosed(bags: list[str], options: argparse.Namespace, files: "Files") -> "Diagnosis":
    from motor_identification.bag import Source
    from motor_identification.cli._diagnosed import diagnosed
    from motor_identification.identify import Request
    from motor_identification.service.job import DiagnosisJob

    namespace = "" if options.model is not None else options.topic_namespace  # offline there is none
    request = Request(list_effects("--known-effects", options.known_effects), workers=os.cpu_count() or 1)
    interrupted = f"Interrupted; what was recorded is in {options.directory}."
    return diagnosed(DiagnosisJob(Source(tuple(bags), namespace), request=request), files, interrupted)


def _made(directory: Path) -> Path:
    from motor_model.errors import MotorError
    from motor_model.regular_file import say_refusal

    try:
        directory.mkdir(parents=True, exist_ok=True)
        if any(directory.iterdir()):
            raise MotorError(f"{directory} is not empty: name a directory that does not exist yet.")
    except OSError as error:
        raise MotorError(f"cannot make the directory {directory} {say_refusal(error)}.") from error
    return directory


def _following(diagnosis: "Diagnosis", done: list[str], rounds: int) -> tuple[str, str]:
    """The profile to record next, empty if there is none, and why in a sentence."""
    wanted = diagnosis.suggested_experiment
    if not wanted:
        return "", "No further experiment is needed."
    if wanted in done:
        return "", f"'{wanted}' was suggested again: repeating it would not show more of this motor."
    if wanted not in PROFILES:
        return "", f"'{wanted}' was suggested, which is not a profile: record it by hand and diagnose all bags."
    if len(done) == rounds:
        return "", f"'{wanted}' was suggested next; --rounds {rounds} ends here."
    return wanted, f"\nRound {len(done) + 1}: '{wanted}', as suggested."


if __name__ == "__main__":
    sys.exit(main())
