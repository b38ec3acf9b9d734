"""From one minute to one hour at 200 Hz: time to read a bag beside the stock MCAP reader, to identify, and memory.

One simulated motor with friction and a disc with 1 % irregular slots runs through the `rich` profile repeatedly,
at a new voltage each time; what it reports goes into bags of 1, 5, 15 and 60 minutes, flushed as often as `record`
does. Every measurement is a process of its own (its peak memory is that of reading and fitting alone), the first one of
each kind is not counted: it fills the caches.
"""

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

from machine import machine

MINUTES = (1, 5, 15, 60)
RATE = 200.0  # [Hz]
EFFECTS = ("coulomb_friction",)
TRUE = {"kv": 0.0955, "ka": 0.0055, "ks": 0.4}  # [V·s/rad], [V·s²/rad], [V]
SPEED = "/motor/speed"
REPEATS = {1: 3, 5: 3}  # best of so many for the short ones
RESULTS = Path(__file__).with_name("results")
HEAD = (
    "| minutes | messages | stock reader | ours | ratio | identify | its CPU time | simulations | per message "
    "| without the search | peak memory | kv | ka | ks |",
    "|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|",
)


def commands(count: int) -> Iterator[float]:
    """[V] `rich`, again and again, each time with a peak of its own."""
    import numpy as np

    from motor_model.excitation import profile

    rich, random = profile("rich"), np.random.default_rng(7)
    shape = rich.voltage(np.arange(0.0, rich.duration, 1.0 / RATE), 1.0)
    sent = 0
    while sent < count:
        peak = random.uniform(6.0, 12.0)
        for share in shape[: count - sent]:
            yield float(peak * share)
        sent += len(shape)


def make(folder: Path) -> dict[str, object]:
    """Write all bags from one run of the simulated board."""
    from recordings import write_bags

    from motor_model.parameters import Parameters
    from motor_model.sensing.board import BoardConfig

    bags = {folder / str(minutes): round(60 * minutes * RATE) for minutes in MINUTES}
    config = BoardConfig(sample_rate=RATE, slot_irregularity=0.01, seed=1)
    write_bags(bags, commands(max(bags.values())), Parameters(TRUE, EFFECTS), config)
    return {}


def stock(bag: Path) -> dict[str, object]:
    """Every message on the speed's topic out of the stock reader, not decoded."""
    from mcap.reader import make_reader

    (path,) = bag.glob("*.mcap")
    begin = time.perf_counter()
    with path.open("rb") as stream:
        count = sum(len(message.data) > 0 for _, _, message in make_reader(stream).iter_messages(topics=[SPEED]))
    return {"seconds": time.perf_counter() - begin, "messages": count}


def read(bag: Path) -> dict[str, object]:
    """The same bag as arrays, checked."""
    from motor_identification.bag import read_recording

    begin = time.perf_counter()
    recording = read_recording(bag)
    return {"seconds": time.perf_counter() - begin, "messages": len(recording)}


def fit(bag: Path) -> dict[str, object]:
    """What `identify BAG --effects coulomb_friction` does; the time is that of reading and fitting."""
    from motor_identification.bag import Source
    from motor_identification.identify import Request
    from motor_identification.service.job import Job, run_job

    stages: list[tuple[str, float]] = []
    begin = time.perf_counter()
    request = Request(EFFECTS, workers=os.cpu_count() or 1)
    job = Job(Source((str(bag),)), request)
    found = run_job(job, lambda stage, share: stages.append((stage, time.perf_counter() - begin)))
    return {
        "seconds": time.perf_counter() - begin,
        "cpu": time.process_time(),
        "fit": found.duration,
        "evaluations": found.evaluations,
        "irregularity": found.slot_irregularity[0],
        "errors": {name: found.parameters.value(name) / value - 1.0 for name, value in TRUE.items()},
        "sigmas": {name: found.standard_errors[name] / value for name, value in TRUE.items()},
        "swarm ended": next((at for stage, at in stages if stage != "swarm"), 0.0),
        "notes": found.notes,
    }


TASKS: dict[str, Callable[[Path], dict[str, object]]] = {"make": make, "stock": stock, "read": read, "fit": fit}


def measured(task: str, path: Path) -> dict[str, float]:
    """Run one task in a process of its own."""
    begin = time.perf_counter()
    done = subprocess.run(
        [sys.executable, __file__, "--task", task, str(path)], check=True, stdout=subprocess.PIPE, text=True
    )
    result = json.loads(done.stdout.splitlines()[-1])
    return {**result, "process": time.perf_counter() - begin}


def best(task: str, path: Path, times: int) -> dict[str, float]:
    """The quickest of several runs."""
    return min((measured(task, path) for _ in range(times)), key=lambda result: result["seconds"])


def row(minutes: int, folder: Path) -> tuple[str, dict[str, float]]:
    """A line of the table, and what was measured for it."""
    bag, times = folder / str(minutes), REPEATS.get(minutes, 1)
    ours, theirs, whole = (best(task, bag, times) for task in ("read", "stock", "fit"))
    errors = [f"{whole['errors'][name]:+.1e} ± {whole['sigmas'][name]:.1e}" for name in TRUE]
    cells = [
        f"{minutes}",
        f"{ours['messages']:,}",
        f"{theirs['seconds']:.2f} s",
        f"{ours['seconds']:.2f} s",
        f"{ours['seconds'] / theirs['seconds']:.2f}",
        f"{whole['process']:.1f} s",
        f"{whole['cpu']:.1f} s",
        f"{whole['evaluations']}",
        f"{1e6 * whole['seconds'] / ours['messages']:.0f} µs",
        f"{1e6 * (whole['seconds'] - whole['swarm ended']) / ours['messages']:.0f} µs",
        f"{whole['peak'] / 2**20:.0f} MiB",
        *errors,
    ]
    print(f"  fit {whole['fit']:.2f} s, swarm ended after {whole['swarm ended']:.2f} s; {whole['notes']}", flush=True)
    return f"| {' | '.join(cells)} |", {"per message": whole["seconds"] / ours["messages"], **whole}


def report(folder: Path) -> None:
    """Measure, print and write the table."""
    for task in ("read", "stock", "fit"):
        measured(task, folder / str(MINUTES[0]))
    lines = [
        "# From one minute to one hour",
        "",
        f"`rich` repeated at 200 Hz, kv, ka and ks of a motor with friction, 1 % irregular slots. {machine()}.",
        "`identify` is the whole process, start and reading included; errors are relative, beside the standard errors "
        "that the fit states.",
        "",
        *HEAD,
    ]
    print("\n".join(lines), flush=True)
    costs = []
    for minutes in MINUTES:
        line, result = row(minutes, folder)
        lines.append(line)
        costs.append(result["per message"])
        print(line, flush=True)
    lines += ["", f"Time per message, the longest beside the shortest: {costs[-1] / costs[0]:.2f}."]
    print(lines[-1])
    RESULTS.mkdir(exist_ok=True)
    (RESULTS / "hour.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def main() -> int:
    """`python benchmarks/hour.py [--bags DIR]`."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bags", type=Path, help="keep the bags here, and use those that are here already")
    parser.add_argument("--task", choices=TASKS, help=argparse.SUPPRESS)
    parser.add_argument("path", type=Path, nargs="?", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.task:
        result = TASKS[options.task](options.path)
        peak = 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss  # Linux counts KiB
        print(json.dumps({**result, "peak": peak}))
        return 0
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.bags or Path(temporary)
        if not (folder / str(max(MINUTES))).exists():
            print("making the bags, which takes minutes", flush=True)
            measured("make", folder)
        report(folder)
    return 0


if __name__ == "__main__":
    sys.exit(main())
