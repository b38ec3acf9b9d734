"""The whole job beside the regression that the field uses: time and errors of kv, ka and ks from half a minute.

The peer is what WPILib's SysId does with a motor's log, re-expressed: the acceleration is the central difference of the
sampled speed over three samples, samples without voltage, without acceleration, with less speed than its noise, or
between a step and the largest acceleration after it are dropped, and ordinary least squares fits

    dω/dt = −(kv/ka) ω + (1/ka) u − (ks/ka) sign ω

(wpilibsuite/sysid, FeedforwardAnalysis.cpp and FilteringUtils.cpp; what its own tests never contain, a motor driven
against its motion, is dropped too). Both read the same bag, one of all profiles and one of the tests that SysId asks
for; either time is that of a whole process, Python's start and imports included.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy: small matrices

from machine import machine

if TYPE_CHECKING:
    from motor_identification.recording import Floats, Recording

EDGES = (20, 48, 96, 200, 1000)
SEEDS = (0, 1, 2)
TRUE = {"kv": 0.0955, "ka": 0.0055, "ks": 0.4}  # [V·s/rad], [V·s²/rad], [V]
EFFECTS = "coulomb_friction"
FIVE = "coulomb_friction,quadratic_drag,transport_delay"
RATE = 200.0  # [Hz]
JUMP = 0.1  # of the largest voltage: a step
RISE = 10  # samples after a step in which the largest acceleration is looked for: later it is noise
WINDOW = 9  # samples whose mean the noise of the speed is measured against
RESULTS = Path(__file__).with_name("results")


def regress(recording: "Recording", friction: bool) -> dict[str, float]:
    """The gains that regression gives for a recording; without friction, a single step is enough for it."""
    return regress_all([recording], friction)


def regress_all(recordings: "list[Recording]", friction: bool) -> dict[str, float]:
    """The gains that regression gives for the tests of one motor."""
    import numpy as np

    equations = [equations_of(recording, friction) for recording in recordings]
    columns, accelerations = (np.concatenate([rows[k] for rows in equations]) for k in (0, 1))
    alpha, beta, *gamma = np.linalg.lstsq(columns, accelerations, rcond=None)[0]
    gains = {"kv": -alpha / beta, "ka": 1.0 / beta, **({"ks": -gamma[0] / beta} if gamma else {})}
    return {name: float(value) for name, value in gains.items()}


def equations_of(recording: "Recording", friction: bool) -> "tuple[Floats, Floats]":
    """Speed, voltage and sign, and the acceleration that they are to explain, in the samples that are kept."""
    import numpy as np

    time, speed, voltage = recording.time, recording.speed, recording.voltage
    acceleration = np.zeros(len(speed))
    acceleration[1:-1] = (speed[2:] - speed[:-2]) / (time[2:] - time[:-2])
    ripple = speed - np.convolve(speed, np.full(WINDOW, 1.0 / WINDOW), mode="same")
    noise = 1.4826 * float(np.median(np.abs(ripple)))
    kept = (voltage * speed > 0.0) & (acceleration != 0.0) & (np.abs(speed) > noise)
    jumps = np.flatnonzero(np.abs(np.diff(voltage, prepend=0.0)) > JUMP * np.abs(voltage).max())
    for begin, end in zip(jumps, np.append(jumps[1:], len(voltage)), strict=False):
        kept[begin : begin + int(np.argmax(np.abs(acceleration[begin : min(end, begin + RISE)])))] = False
    columns = [speed, voltage, *([np.sign(speed)] if friction else [])]
    return np.column_stack(columns)[kept], acceleration[kept]


def rich() -> "Floats":
    """[V] every profile in turn."""
    import numpy as np

    from motor_model.excitation import profile

    chosen = profile("rich")
    return chosen.voltage(np.arange(0.0, chosen.duration, 1.0 / RATE) - 0.1, 12.0)


def four_tests() -> "Floats":
    """[V] the tests that SysId asks for: a slow ramp and a step, either way, with rests between."""
    import numpy as np

    rest, ramp, step = np.zeros(300), np.arange(0.0, 8.0, 1.0 / RATE), np.full(400, 7.0)
    return np.concatenate([rest, ramp, rest, -ramp, rest, step, rest, -step, rest])


EXCITATIONS = {"rich": rich, "SysId's four tests": four_tests}


def make(folder: Path, excitation: str, edges: int, seed: int) -> Path:
    """A bag with about half a minute of a simulated motor with friction and 1 % irregular slots."""
    from recordings import write_bags

    from motor_model.parameters import Parameters
    from motor_model.sensing.board import BoardConfig

    bag = folder / f"{list(EXCITATIONS).index(excitation)}_{edges}_{seed}"
    commands = [float(command) for command in EXCITATIONS[excitation]()]
    config = BoardConfig(sample_rate=RATE, edges_per_revolution=edges, slot_irregularity=0.01, seed=seed)
    write_bags({bag: len(commands)}, commands, Parameters(TRUE, (EFFECTS,)), config)
    return bag


def timed(command: list[str]) -> float:
    """[s] wall time of a process that must succeed."""
    begin = time.perf_counter()
    subprocess.run([sys.executable, *command], check=True, stdout=subprocess.DEVNULL)
    return time.perf_counter() - begin


def identified(bag: Path, effects: str = EFFECTS) -> tuple[dict[str, float], float]:
    """Our gains and the time of `identify`."""
    answer = bag / "fit.json"
    seconds = timed(["-m", "motor_identification.cli.identify", str(bag), "--effects", effects, "--json", str(answer)])
    parameters = json.loads(answer.read_text(encoding="utf-8"))["model"]["parameters"]
    return {name: parameters[name]["value"] for name in TRUE}, seconds


def regressed(bag: Path) -> tuple[dict[str, float], float]:
    """The regression's gains and its time."""
    answer = bag / "regression.json"
    seconds = timed([__file__, "--regress", str(bag), str(answer)])
    return json.loads(answer.read_text(encoding="utf-8")), seconds


def row(folder: Path, excitation: str, edges: int) -> str:
    """A line of the table: RMS errors over discs and starting angles, and the quickest run of each."""
    bags = [make(folder, excitation, edges, seed) for seed in SEEDS]
    cells = [excitation, f"{edges}"]
    for method in (identified, regressed):
        found, seconds = zip(*(method(bag) for bag in bags), strict=True)
        for name, true in TRUE.items():
            cells.append(f"{(sum((gains[name] / true - 1.0) ** 2 for gains in found) / len(found)) ** 0.5:.1e}")
        cells.append(f"{min(seconds):.2f} s")
    return f"| {' | '.join(cells)} |"


def report(folder: Path) -> None:
    """Measure, print and write the table."""
    warm = make(folder, "rich", 96, 99)
    for effects in (EFFECTS, FIVE):
        identified(warm, effects)
    lines = [
        "# The whole job beside SysId's regression, re-expressed",
        "",
        "28 s at 200 Hz, kv, ka and ks of a motor with friction, 1 % irregular slots; RMS relative errors over "
        f"{len(SEEDS)} discs.",
        f"Times are whole processes, start and reading included, the quickest of {len(SEEDS)}. {machine()}.",
        "",
        "| recording | edges/rev | identify: kv | ka | ks | time | regression: kv | ka | ks | time |",
        "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|",
    ]
    print("\n".join(lines), flush=True)
    for excitation in EXCITATIONS:
        for edges in EDGES:
            lines.append(row(folder, excitation, edges))
            print(lines[-1], flush=True)
    five = min(identified(warm, FIVE)[1] for _ in SEEDS)
    lines += ["", f"`identify` with five parameters (drag and delay too), 96 edges: {five:.2f} s."]
    print(lines[-1])
    RESULTS.mkdir(exist_ok=True)
    (RESULTS / "regression.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def main() -> int:
    """`python benchmarks/regression.py`."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--regress", nargs=2, type=Path, metavar=("BAG", "JSON"), help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.regress:
        from motor_identification.bag import read_recording

        bag, answer = options.regress
        answer.write_text(json.dumps(regress(read_recording(bag), friction=True)), encoding="utf-8")
        return 0
    with tempfile.TemporaryDirectory() as folder:
        report(Path(folder))
    return 0


if __name__ == "__main__":
    sys.exit(main())
