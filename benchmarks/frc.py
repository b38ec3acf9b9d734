"""An FRC robot's drivetrain: kv, ka and ks of either side beside SysId's own regression on the same log.

The log's sensor has no lag worth naming. Those of most such robots come in frames, held for 20 ms and 65 to 90 ms
late: a copy of the log is given both, to see what they do to either method. Another directory with `frc/…` can be the
argument.
"""

import argparse
import json
import os
import tempfile
from dataclasses import replace
from math import tau
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy: small matrices

import numpy as np
from machine import commit, machine
from regression import regress_all

from motor_identification.identify import Request, identify
from motor_identification.logs.columns.said import Said
from motor_identification.logs.imported import import_log
from motor_identification.recording import Recording, check, recording_of

RESULTS = Path(__file__).with_name("results")
DATA = Path(__file__).resolve().parents[1] / "tests" / "data"
SIDES = ("left", "right")
HELD, LATE = 0.020, 0.065  # [s]
EFFECTS = ("coulomb_friction", "transport_delay")


def recordings(file: Path, side: str, motion: str, unit: str) -> list[Recording]:
    """The four tests of one side, by its positions or its velocities."""
    said = Said(voltage=f"{side} voltage [V]", motion=f"{side} {motion} [{unit}]")
    (motor,) = import_log(file, said).motors
    return [check(recording_of(run.samples, motor.log.info, run.label)) for run in motor.log.runs]


def delayed(file: Path, folder: Path) -> Path:
    """A copy whose positions and velocities are held and late."""
    log = json.loads(file.read_text(encoding="utf-8"))
    for name, rows in log.items():
        if isinstance(rows, list):
            table = np.array(rows)
            time = table[:, 0]
            made = time[0] + np.floor((time - time[0]) / HELD + 1e-9) * HELD - LATE
            for column in range(3, 7):
                table[:, column] = np.interp(made, time, table[:, column])
            log[name] = table.tolist()
    copy = folder / file.name
    copy.write_text(json.dumps(log), encoding="utf-8")
    return copy


def sysid(file: Path, side: str) -> dict[str, float]:
    """SysId's regression, by the velocities that it takes too; per metre."""
    runs = recordings(file, side, "velocity", "m/s")
    turn = tau / 0.4878
    return regress_all([replace(run, speed=run.speed / turn) for run in runs], friction=True)


def ours(file: Path, side: str) -> dict[str, float]:
    """Our fit by the positions; per metre."""
    fit = identify(recordings(file, side, "position", "m"), Request(EFFECTS))
    turn = tau / 0.4878
    values = fit.parameters.values
    return {"kv": values["kv"] * turn, "ka": values["ka"] * turn, "ks": values["ks"], "delay": values["delay"]}


def row(side: str, log: str, method: str, found: dict[str, float]) -> str:
    delay = f"{1e3 * found['delay']:.0f}" if "delay" in found else ""
    return f"| {side} | {log} | {method} | {found['kv']:.3f} | {found['ka']:.3f} | {found['ks']:.3f} | {delay} |"


def study(data: Path) -> list[str]:
    """Lines of the table."""
    rows = []
    file = data / "frc" / "drivetrain_sysid.json"
    with tempfile.TemporaryDirectory() as folder:
        late = delayed(file, Path(folder))
        for side in SIDES:
            for log, source in (("as recorded", file), (f"held {HELD * 1e3:.0f} ms, {LATE * 1e3:.0f} ms late", late)):
                rows.append(row(side, log, "SysId's regression", sysid(source, side)))
                rows.append(row(side, log, "ours", ours(source, side)))
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("data", type=Path, nargs="?", default=DATA)
    rows = study(parser.parse_args().data)
    page = f"""# An FRC drivetrain beside SysId's regression

`python benchmarks/frc.py` (commit {commit()}; {machine()}). SysId's JSON of a 2025 robot
([tests/data](../../tests/data/README.md)), read by
`import_log drivetrain_sysid.json --output drivetrain`; its regression as in [regression](regression.md), on the log's
velocities; ours: kv, ka, Coulomb friction and a delay, on its positions.

| side | log | method | kv [V·s/m] | ka [V·s²/m] | ks [V] | delay [ms] |
|---|---|---|---|---|---|---|
{chr(10).join(rows)}

Why they differ: kv and ks agree within 4 and 6 %, in either log. ka does not. The regression takes the acceleration
from differences of a noisy, quantised velocity and drops what it cannot use: its ka hangs on the samples that are left
(0.20 and 0.44 V·s²/m of two sides that move together), and where the sensor is late, every acceleration stands beside
a later voltage (0.12 and 0.10). Ours compares simulated with measured positions: its ka moves by 6 % when the sensor
becomes late.

What ours does not find: the delay of the copy. Slow tests alone give it (at the full rate of the log 64 and 90 ms for
the 65 that were made). The steps do not, and hold it at a few milliseconds: no first-order motor moves as this robot
does at 6 to 8 V (alone they want 2.6 to 5 V of friction), be it a limit of current or a slip of its wheels.
`identify` says that the recordings disagree.
"""
    (RESULTS / "frc.md").write_text(page, encoding="utf-8")
    print(*rows, sep="\n")


if __name__ == "__main__":
    main()
