"""`diagnose`: find the effects that a motor's model lacks, from bags."""

import argparse
import os
import sys
from math import inf

from motor_identification.cli.identify import add_effects_option, list_effects
from motor_identification.cli.options.mapping import add_mapping_options, make_source
from motor_model.effects import EFFECTS
from motor_ros.command.parser import CommandParser
from motor_ros.command.shell import shell
from motor_ros.output_files import add_force_option


def parser() -> argparse.ArgumentParser:
    """Make the command line's parser."""
    effects = "\n".join(f"  {effect.name:22}{effect.summary}" for effect in EFFECTS)
    parser = CommandParser(
        "motor_identification",
        "diagnose",
        "Find where simulation and measurement disagree, name the effects that are missing from the\n"
        "model, and show on data that no fit has seen how far they close the gap. (`explore` also\n"
        "drives the motor, and records what a diagnosis asks for.)",
        "example:\n  ros2 run motor_identification diagnose bag --output model.yaml --report diagnosis\n\n"
        f"effects:\n{effects}",
    )
    parser.add_argument("bags", nargs="+", metavar="BAG", help="recordings of one motor")
    parser.add_argument(
        "--validate", nargs="+", default=[], metavar="BAG", help="validate on these (default: parts of the others)"
    )
    add_effects_option(parser, "--known-effects", "in the model already, separated by commas")
    parser.add_argument("--topic-namespace", default="", metavar="NS", help="of the recorded motor")
    add_mapping_options(parser)
    parser.add_argument("--start", type=float, default=0.0, metavar="S", help="from here [s], not of --validate")
    parser.add_argument("--stop", type=float, default=0.0, metavar="S", help="to here [s], not of --validate")
    parser.add_argument(
        "--budget", type=float, default=inf, metavar="S", help="seconds after which it says the best it has so far"
    )
    parser.add_argument("--output", metavar="FILE", help="write the model here (YAML)")
    parser.add_argument("--json", metavar="FILE", help="write everything that was found here")
    parser.add_argument("--report", metavar="DIR", help="write report.html, the model and the JSON into this directory")
    add_force_option(parser)
    return parser


def main(args: list[str] | None = None) -> int:
    """`ros2 run motor_identification diagnose`."""
    options = parser().parse_args(args)
    return shell(lambda: _diagnose(options))


def _diagnose(options: argparse.Namespace) -> int:
    from motor_identification.cli._diagnosed import Files, diagnosed
    from motor_identification.identify import Request
    from motor_identification.service.job import DiagnosisJob

    files = Files(options.output, options.json, options.report)
    files.check(options.force)
    job = DiagnosisJob(
        source=make_source(options),
        validation=tuple(options.validate),
        request=Request(
            list_effects("--known-effects", options.known_effects),
            workers=os.cpu_count() or 1,
            time_limit=options.budget,
        ),
    )
    diagnosed(job, files, "The diagnosis was interrupted; nothing was written.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
