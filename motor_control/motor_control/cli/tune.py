"""`tune`: the gains of the speed controller from a motor model."""

import argparse
import sys
from pathlib import Path

from motor_control.tuning.design import Tuning, Wish, tune
from motor_control.tuning.speed_feedback import MEASURED, OBSERVER, Encoder
from motor_model import model_file
from motor_model.parameters import Parameters
from motor_ros.command.number_types import positive
from motor_ros.command.parser import CommandParser
from motor_ros.command.shell import shell
from motor_ros.output_files import add_force_option, check_outputs


def share(text: str) -> float:
    """Return a number from 0 to below 1, as an argparse type."""
    number = float(text)
    if not 0.0 <= number < 1.0:
        raise argparse.ArgumentTypeError(f"{text} is not a share from 0 to below 1")
    return number


def parser() -> argparse.ArgumentParser:
    """Make the command line's parser."""
    parser = CommandParser(
        "motor_control",
        "tune",
        "Design the gains of the speed controller from a motor model, and predict the loop.",
        "example, and the gains in use:\n"
        "  ros2 run motor_control tune model.yaml --speed-source observer --output gains.yaml --figure gains.png\n"
        "  ros2 run motor_control motor_control --ros-args --params-file gains.yaml",
    )
    parser.add_argument("model", metavar="MODEL", help="model file (YAML), as 'identify --output' writes it")
    parser.add_argument(
        "--output",
        type=Path,
        metavar="FILE",
        help="write the gains here (ROS 2 parameter file)",
    )
    parser.add_argument("--figure", type=Path, metavar="FILE", help="draw the predicted step here (PNG, PDF or SVG)")
    _add_wish(parser)
    add_force_option(parser)
    _add_encoder(parser)
    return parser


def _add_wish(parser: argparse.ArgumentParser) -> None:
    """What the loop is to be like."""
    parser.add_argument(
        "--time-constant",
        type=positive,
        metavar="S",
        help="closed-loop time constant [s] (default: the shortest that delay and encoder allow)",
    )
    parser.add_argument(
        "--speed-source",
        choices=(MEASURED, OBSERVER),
        default=MEASURED,
        help="speed that the law uses (default measured: from the period between edges)",
    )
    parser.add_argument(
        "--lowest-speed",
        type=positive,
        metavar="RAD_S",
        help="slowest reference of interest [rad/s] (default: 6 %% of the speed at full voltage, or 20 edges/s)",
    )
    parser.add_argument(
        "--oscillation",
        type=positive,
        default=0.02,
        metavar="SHARE",
        help="speed ripple, peak to peak, that an irregular disc may cause (default 0.02)",
    )


def _add_encoder(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument_group("how the plant measures").add_argument
    add("--sample-rate", type=positive, default=200.0, metavar="HZ", help="of the plant (default 200)")
    add("--edges-per-revolution", type=int, default=96, metavar="N", help="of one polarity (default 96)")
    add("--slot-irregularity", type=share, default=0.01, metavar="SHARE", help="of a slot, 1 sigma (default 0.01)")
    add("--edge-resolution", type=positive, default=4e-6, metavar="S", help="of the edges' timer [s] (default 4e-6)")


def main(args: list[str] | None = None) -> int:
    """`ros2 run motor_control tune`."""
    options = parser().parse_args(args)
    return shell(lambda: _tune(options))


def _tune(options: argparse.Namespace) -> int:
    from motor_control.tuning.gain_file import save_gains
    from motor_control.tuning.table import as_table, cautions

    check_outputs([path for path in (options.output, options.figure) if path], options.force)
    parameters = model_file.load(options.model)
    encoder = Encoder(
        options.edges_per_revolution, options.slot_irregularity, options.edge_resolution, parameters.gear_ratio
    )
    wish = Wish(
        sample_period=1.0 / options.sample_rate,
        lowest_speed=options.lowest_speed,
        time_constant=options.time_constant,
        oscillation=options.oscillation,
        source=options.speed_source,
    )
    tuning = tune(parameters, encoder, wish)
    said = [as_table(tuning), *(f"\n{caution}" for caution in cautions(tuning, parameters))]
    try:  # files first: who reads what is said may go at any line
        if options.output:
            save_gains(options.output, tuning, Path(options.model), options.force)
            said.append(f"gains: {options.output}")
        if options.figure:
            _draw(options, tuning, parameters)
            said.append(f"figure: {options.figure}")
    finally:
        print(*said, sep="\n")
    return 0


def _draw(options: argparse.Namespace, tuning: Tuning, parameters: Parameters) -> None:
    """Rehearse the large step with the controller as its node would be set up, and draw it."""
    from motor_control.configuration import config_of
    from motor_control.parameters import ROWS
    from motor_control.tuning.figure import draw_tuning
    from motor_control.tuning.simulated_loop import rehearse
    from motor_model.sensing.board import BoardConfig

    board = BoardConfig(
        name=parameters.name,
        sample_rate=options.sample_rate,
        edges_per_revolution=options.edges_per_revolution,
        edge_resolution=options.edge_resolution,
        slot_irregularity=options.slot_irregularity,
    )
    values = {row.name: row.default for row in ROWS} | {"kp": tuning.gains.kp, "ki": tuning.gains.ki}
    observed = tuning.wish.source == OBSERVER
    values |= {"speed_source": tuning.wish.source, "model": options.model if observed else "", "feedforward": observed}
    step = tuning.large_step
    config = config_of(values, board.info(parameters), parameters if observed else None)
    rehearsal = rehearse(parameters, board, config, lambda _: step.reference, float(step.time[-1]))
    draw_tuning(tuning, rehearsal, parameters.name, options.figure)


if __name__ == "__main__":
    sys.exit(main())
