"""Every public log of tests/data imported by one line: what was assumed, and what it shows.

Another directory with the same files can be the argument.
"""

import argparse
import os
import shlex
from collections.abc import Iterator
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy: small matrices

from machine import commit

from motor_identification.cli.options.log import add_log_options
from motor_identification.cli.options.log_said import read_log_options
from motor_identification.logs.imported import Imported, import_log

RESULTS = Path(__file__).with_name("results")
DATA = Path(__file__).resolve().parents[1] / "tests" / "data"
MOUSE = "--supply-voltage 7.9 --unit rpm"
# What has to be said of each file, and why.
LINES: dict[str, tuple[str, str]] = {
    "undc/prbs_2026-08-14.csv": ("", ""),
    "undc/prbs_2026-08-18.csv": ("", ""),
    "undc/prbs_coast_2024-08-03.csv": ("", ""),
    "undc/prbs_coast_2024-08-05.csv": ("", ""),
    "undc/step_open_2026-08-18.csv": ("", ""),
    "undc/step_closed_2026-08-11.csv": ("--voltage-before", "never asked: this controller logs its last voltage"),
    "undc/stairs_closed_2026-08-11.csv": ("--voltage-before", "the same"),
    "undc/profile_closed_2026-08-18.csv": ("--voltage-before", "the same"),
    "undc/static_2026-08-17.csv": ("--unit deg/s", "no name and no step tells the unit of a static curve"),
    "undc/static_coast_2024-08-05.csv": ("--unit deg/s", "the same"),
    "esp32/step_response.csv": ("", ""),
    "ev3/steps_1s.csv": ("--supply-voltage 7.4", "a duty in %, and no battery's column"),
    "micromouse/testPid1.csv": (MOUSE, "a duty and no battery's column; counts are as whole in deg/s as in rpm"),
    "micromouse/testPid3.csv": (MOUSE, "the same"),
    "micromouse/controllerDelayImpact1ms.csv": (MOUSE, "the same"),
    "micromouse/controllerDelayImpact10ms.csv": (MOUSE, "the same"),
    "micromouse/wheelSpeedCalibration3.csv": ("", ""),
    "frc/drivetrain_sysid.json": ("", ""),
}  # fmt: skip


def imported(file: Path, options: str) -> Imported:
    parser = argparse.ArgumentParser()
    add_log_options(parser)
    arguments = parser.parse_args([str(file), "--dry-run", *shlex.split(options)])
    return import_log(file, read_log_options(parser, arguments))


def lines(data: Path) -> Iterator[str]:
    for name, (options, why) in LINES.items():
        log = imported(data / name, options)
        yield f"\n## {name}\n"
        if why:
            yield f"Said: {why}.\n"
        yield "```"
        yield f"import_log {name} --output bag{' ' if options else ''}{options}"
        yield "```\n"
        yield "```"
        said = [*log.findings]
        for motor in log.motors:
            said += [f"\nMotor {motor.label}:" if motor.label else "", *motor.log.findings]
        yield "\n".join(line.replace(f"{data}/", "") for line in said if line)
        yield "```"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("data", type=Path, nargs="?", default=DATA)
    data = parser.parse_args().data
    plain = sum(options in ("", "--voltage-before") for options, _ in LINES.values())
    page = [
        "# Logs from anywhere, each by one line",
        "",
        f"`python benchmarks/logs.py` at {commit()} makes this page: what `import_log` says of every public log in "
        f"[tests/data](../../tests/data/README.md). {plain} of {len(LINES)} need no option to be read; of the others "
        "the command asks for what is missing, in one sentence. `--voltage-before` it finds where voltages jump.",
        *lines(data),
    ]
    (RESULTS / "logs.md").write_text("\n".join(page) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
