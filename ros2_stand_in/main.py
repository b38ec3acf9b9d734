"""Finds the verb that was typed, parses its arguments and runs it."""

import argparse
import importlib
import os
import sys
from collections.abc import Sequence

from motor_model.errors import MotorError
from motor_model.program.internal_error import report
from motor_ros.loopback import stay_on_this_machine
from motor_ros.terminal import escaped_output
from ros2_stand_in.verb_table import VERBS, Verb

ABOUT = """\
This is the motor workbench's stand-in for machines without the real ros2 command.
It talks to real ROS 2 nodes; where the real command is installed, that is used and every line below works with it too.
"""
USAGE_ERROR = 2
INTERRUPTED = 130
READER_GONE = 141


def main(words: Sequence[str]) -> int:
    """Run one command line (without the leading `ros2`) and return its exit status."""
    stay_on_this_machine()  # no stranger's node moves a motor
    if sys.stdout is not None:  # it may have been closed
        sys.stdout.reconfigure(line_buffering=True)  # type: ignore[union-attr]
    with escaped_output():
        return _answered(list(words))


def _answered(words: list[str]) -> int:
    try:
        status = _run(words)
        sys.stdout.flush()
        return status
    except MotorError as error:
        print(error, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return INTERRUPTED
    except BrokenPipeError:  # such as `ros2 topic echo /motor/speed | head`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return READER_GONE
    except Exception as error:
        print(report(error), file=sys.stderr)
        return 1


def _run(words: list[str]) -> int:
    if not words or words[0] in ("-h", "--help"):
        print(f"usage: ros2 VERB ...\n\n{ABOUT}\n{_table(VERBS)}\n\n'ros2 VERB --help' explains each.")
        return 0
    named = [verb for verb in VERBS if verb.words.split()[0] == words[0]]
    if not named:
        return _unknown(f"ros2 has no verb '{words[0]}'", dict.fromkeys(verb.words.split()[0] for verb in VERBS))
    if named[0].words == words[0]:
        return _call(named[0], words[1:])
    if len(words) == 1 or words[1] in ("-h", "--help"):
        print(f"usage: ros2 {words[0]} VERB ...\n\n{ABOUT}\n{_table(named)}")
        return 0
    for verb in named:
        if verb.words == f"{words[0]} {words[1]}":
            return _call(verb, words[2:])
    return _unknown(f"ros2 {words[0]} has no verb '{words[1]}'", [verb.words.split()[1] for verb in named])


def _table(verbs: Sequence[Verb]) -> str:
    return "\n".join(f"  {verb.words:<18}{verb.help}" for verb in verbs)


def _unknown(what: str, known: "Sequence[str] | dict[str, None]") -> int:
    print(f"{what} in the motor workbench's stand-in; it has: {', '.join(known)}.", file=sys.stderr)
    return USAGE_ERROR


def _call(verb: Verb, words: list[str]) -> int:
    module_name, _, function = verb.place.partition(":")
    module = importlib.import_module(f"ros2_stand_in.verbs.{module_name}")
    parser = argparse.ArgumentParser(prog=f"ros2 {verb.words}", description=verb.help)
    getattr(module, f"{function}_arguments")(parser)
    status: int = getattr(module, function)(parser.parse_args(words))
    return status
