"""`identify`: fit a motor model to bags."""

import argparse
import os
import sys
from collections.abc import Callable, Sequence
from datetime import datetime, timezone
from pathlib import Path
from typing import TYPE_CHECKING

from motor_identification.cli.options.mapping import add_mapping_options, make_source
from motor_identification.cli.options.physical import add_physical_options, read_physical
from motor_identification.estimation.request import Request, SearchConfig
from motor_model.effects import EFFECT_BY_NAME, EFFECTS
from motor_model.errors import MotorError
from motor_model.regular_file import say_refusal
from motor_ros.command.number_types import whole_between
from motor_ros.command.parser import CommandParser, listed_names
from motor_ros.command.shell import ended_by_interrupt, shell
from motor_ros.output_files import add_force_option, check_outputs

if TYPE_CHECKING:
    from motor_identification.uncertainty.result import Fit

LONG = (
    "{} is looked for in a spectrum over the angle and fitted from every line of it: this can take minutes. "
    "Ctrl-C ends it.\n"
)
REPORT_FILES = ("report.html", "fit.png", "fit.json", "model.yaml")
LIMITS = SearchConfig()


def parser() -> argparse.ArgumentParser:
    """Make the command line's parser."""
    effects = "\n".join(f"  {effect.name:22}{effect.summary}" for effect in EFFECTS)
    parser = CommandParser(
        "motor_identification",
        "identify",
        "Fit a motor model to recorded bags: particle swarm over the whole box, then least squares.",
        "example:\n  ros2 run motor_identification identify bag --effects coulomb_friction --report report\n\n"
        f"effects:\n{effects}",
    )
    parser.add_argument("bags", nargs="+", metavar="BAG", help="recordings of one motor")
    add_effects_option(parser, "--effects", "beyond kv and ka, separated by commas")
    parser.add_argument("--topic-namespace", default="", metavar="NS", help="of the recorded motor")
    add_mapping_options(parser)
    parser.add_argument("--start", type=float, default=0.0, metavar="S", help="from here [s] (default: the beginning)")
    parser.add_argument("--stop", type=float, default=0.0, metavar="S", help="to here [s] (default: the end)")
    add, most = parser.add_argument, "of a swarm at most (default %(default)s)"
    add("--particles", type=whole_between(2, 100_000), default=LIMITS.particles, metavar="N", help=most)
    add("--epochs", type=whole_between(1, 1_000_000), default=LIMITS.epochs, metavar="N", help=most)
    add(
        "--seed",
        type=whole_between(0, 2**63 - 1),
        default=LIMITS.seed,
        metavar="N",
        help="of the swarm (default %(default)s)",
    )
    add_physical_options(parser)
    parser.add_argument("--output", metavar="FILE", help="write the model here (YAML)")
    parser.add_argument("--json", metavar="FILE", help="write everything that was found here")
    parser.add_argument(
        "--report", metavar="DIR", help="write report.html, fit.png, the model and the numbers into this directory"
    )
    add_force_option(parser)
    return parser


def add_effects_option(parser: argparse.ArgumentParser, name: str, meaning: str) -> None:
    """Add an option that takes names of effects, which TAB completes."""
    action = parser.add_argument(name, default="", metavar="A,B", help=meaning)
    action.completer = listed_names([effect.name for effect in EFFECTS])  # type: ignore[attr-defined]


def list_effects(option: str, given: str) -> tuple[str, ...]:
    """List the names that an option was given, separated by commas.

    Raises:
        MotorError: there are commas, and no name.
    """
    names = tuple(name.strip() for name in given.split(",") if name.strip())
    if given.strip() and not names:
        raise MotorError(f"{option} {given} names no effect: name some, or leave it out (see --help).")
    return names


def main(args: list[str] | None = None) -> int:
    """`ros2 run motor_identification identify`."""
    options = parser().parse_args(args)
    return shell(lambda: _identify(options))


def _identify(options: argparse.Namespace) -> int:
    from tqdm import tqdm

    from motor_identification.service.job import Job, run_job

    effects = list_effects("--effects", options.effects)
    report = [os.path.join(options.report, name) for name in REPORT_FILES] if options.report else []
    check_outputs(filter(None, (options.output, options.json, *report)), options.force, options.report)
    search = SearchConfig(options.particles, options.epochs, options.seed)
    request = Request(effects, search, os.cpu_count() or 1, read_physical(options))
    job = Job(make_source(options), request)
    print(announce_effort(effects), end="", file=sys.stderr)
    with tqdm(total=100, desc="search", delay=2.0, disable=None, bar_format="{desc} {bar} {percentage:3.0f} %") as bar:

        def show(stage: str, share: float) -> None:
            bar.set_description(stage, refresh=False)
            bar.update(round(100 * share) - bar.n)

        with ended_by_interrupt("The identification was interrupted; nothing was written."):
            fit = run_job(job, show)
    return _present(options, fit)


def announce_effort(effects: Sequence[str]) -> str:
    """Say which effects make a fit long, on a line of its own; empty where none does."""
    slow = [name for name in effects if name in EFFECT_BY_NAME and EFFECT_BY_NAME[name].periodic]
    slow = [name for name in slow if not EFFECT_BY_NAME[name].on_disc]  # its number of cycles is not searched
    return LONG.format(" and ".join(slow)) if slow else ""


def _present(options: argparse.Namespace, fit: "Fit") -> int:
    from motor_identification.reporting.fit_json import fit_to_json
    from motor_identification.reporting.fit_model_file import save_model
    from motor_identification.reporting.fit_text import describe_residual, format_fit, list_cautions
    from motor_identification.reporting.json_values import write_json
    from motor_identification.reporting.physical_text import format_physical, list_physical_notes

    created = datetime.now(timezone.utc).isoformat(timespec="seconds")
    written, troubles = [], []
    tasks: tuple[tuple[str, str | None, Callable[[Path], object]], ...] = (
        ("model", options.output, lambda path: save_model(path, fit, created)),
        ("", options.json, lambda path: write_json(path, fit_to_json(fit))),
        ("report", options.report, lambda path: _report(path, fit, options, created)),
    )
    for name, place, write in tasks:  # first: whoever reads what is printed may stop reading
        try:
            if place:
                done = write(Path(place))
                written += [f"{name}: {done or place}"] if name else []
        except MotorError as error:  # the fit is worth more
            troubles.append(str(error))
    print(format_fit(fit))
    print(f"\n{describe_residual(fit)}; {fit.evaluations} simulations in {fit.duration:.2f} s")
    if fit.physical is not None:
        print(f"\n{format_physical(fit.physical)}\n")
    limits = list_physical_notes(fit.physical) if fit.physical is not None else ()
    for line in (*list_cautions(fit), *limits, *written):
        print(line)
    if troubles:
        raise MotorError(" ".join(troubles))
    return 0


def _report(directory: Path, fit: "Fit", options: argparse.Namespace, created: str) -> Path:
    """Page, picture, JSON and model file side by side; returns the page."""
    from motor_identification.reporting.fit_figure import draw_fit
    from motor_identification.reporting.fit_json import fit_to_json
    from motor_identification.reporting.fit_model_file import save_model
    from motor_identification.reporting.html import Files, write_fit_report
    from motor_identification.reporting.json_values import write_json

    try:
        directory.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise MotorError(f"cannot make the directory {directory} {say_refusal(error)}.") from error
    source = make_source(options)
    recordings = [source.read(bag) for bag in source.uris]
    draw_fit(recordings[0], fit, directory / "fit.png")
    write_json(directory / "fit.json", fit_to_json(fit))
    save_model(directory / "model.yaml", fit, created)
    files = Files(options.output or str(directory / "model.yaml"), source)
    return write_fit_report(fit, recordings, directory, files)


if __name__ == "__main__":
    sys.exit(main())
