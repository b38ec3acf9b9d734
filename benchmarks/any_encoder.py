"""Whether any encoder will do: time and accuracy of `identify` and `diagnose` from 6 to 8,192 edges a turn, in one run.

The motor of the paper with friction and a delayed bridge, `rich` at 200 Hz, run by the tests' independent plant on a
disc 0.5 % irregular; in one process with one worker, so that CPU time is what one core needs. The same beside a ripple,
beside physics that the table does not have, at 1 kHz, and for ten minutes. `hour.py` has an hour and its memory.
"""

import argparse
import os
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from time import process_time

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy: small matrices
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "support"))

import numpy as np
from machine import machine
from plant import profiles, record

from motor_identification.diagnose import diagnose
from motor_identification.identify import Request, identify
from motor_identification.recording import Recording, check
from motor_model.parameters import PAPER_KA, PAPER_KV

RESULTS = Path(__file__).with_name("results") / "any_encoder.md"
EDGES, USUAL = (6, 96, 1000, 2880, 8192), 96
KNOWN = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.4, "delay": 0.006}
EFFECTS = ("coulomb_friction", "transport_delay")
RIPPLE = {"ripple_voltage": 0.3, "ripple_cycles": 7.3, "ripple_phase": 0.4}
CASES: dict[str, dict[str, float]] = {
    "friction, delay": {},
    "and ripple": RIPPLE,
    "and a slewing bridge": {"slew_rate": 150.0},
}
MOST_RATIO = 3.0  # of the time that 96 edges take
LONG = (("25 s at 1 kHz", 25.0, 1000.0, 30.0), ("10 minutes at 200 Hz", 600.0, 200.0, 90.0))  # [s], [Hz], [s] at most


@dataclass(frozen=True)
class Run:
    """CPU seconds of one job, and what came out."""

    seconds: float
    said: str


def recorded(edges: int, more: Mapping[str, float], duration: float = 0.0, rate: float = 200.0) -> Recording:
    """`rich` once, or as often as it takes to fill a duration [s], each time at another peak."""
    time, volts = profiles.rich(12.0, 3)
    if duration > 0.0:
        turns, random = int(np.ceil(duration / time[-1])), np.random.default_rng(7)
        peaks = np.concatenate([[1.0], random.uniform(0.5, 1.0, turns)])
        volts = np.concatenate([peak * np.asarray(volts) for peak in peaks[:turns]])
        again = np.concatenate([np.asarray(time) + turn * time[-1] for turn in range(turns)])
        time = np.maximum.accumulate(again)  # rounding
        time, volts = time[time < duration], volts[time < duration]
    values = {**KNOWN, **more}
    how = {"edges": edges, "sample_rate": rate, "irregularity": 0.005, "disc_seed": 3}
    return check(record(values, time, volts, seed=3, **how)[0])  # type: ignore[arg-type]


def identified(recording: Recording) -> Run:
    """Fit what is known to be there."""
    begun = process_time()
    fit = identify([recording], Request(EFFECTS))
    seconds = process_time() - begun
    off = [abs(fit.parameters.value(name) / true - 1.0) for name, true in KNOWN.items()]
    errors = [fit.standard_errors[name] / true for name, true in KNOWN.items()]
    return Run(seconds, f"{max(off):.0e} | {max(errors):.0e}")


def diagnosed(recording: Recording) -> Run:
    """Find what is hidden."""
    begun = process_time()
    found = diagnose([recording], request=Request(workers=1))
    named = ", ".join(finding.effect for finding in found.findings) or "–"
    return Run(process_time() - begun, f"{found.verdict.value}: {named}")


def short_rows() -> list[str]:
    """Every encoder, 28 s: identified, and diagnosed in every case."""
    recordings = {edges: recorded(edges, {}) for edges in EDGES}
    identified(recordings[USUAL]), identified(recordings[2880])  # machine code is loaded once
    lines, head = [], "| edges | CPU | times 96 edges | {} |"
    fits = {edges: identified(recording) for edges, recording in recordings.items()}
    lines += ["`identify`, four parameters:", "", head.format("largest error | largest standard error")]
    lines += ["|---:|---:|---:|---:|---:|", *table(fits), ""]
    for case, more in CASES.items():
        runs = {edges: diagnosed(recorded(edges, more)) for edges in EDGES}
        lines += [f"`diagnose`, {case}:", "", head.format("said"), "|---:|---:|---:|---|", *table(runs), ""]
        print("\n".join(lines), flush=True)
    return lines


def table(runs: Mapping[int, Run]) -> list[str]:
    """One line for each encoder, beside 96 edges."""
    usual = runs[USUAL].seconds
    return [
        f"| {edges} | {run.seconds:.2f} s | {run.seconds / usual:.1f} | {run.said} |" for edges, run in runs.items()
    ]


def long_rows() -> list[str]:
    """Longer and faster recordings."""
    lines = [
        "Longer and faster, friction and delay:",
        "",
        "| recording | edges | `identify` | `diagnose` | at most | said |",
    ]
    lines.append("|---|---:|---:|---:|---:|---|")
    for name, duration, rate, most in LONG:
        for edges in (96, 2880):
            recording = recorded(edges, {}, duration, rate)
            fit, found = identified(recording), diagnosed(recording)
            spans = f"{fit.seconds:.1f} s | {found.seconds:.1f} s"
            lines.append(f"| {name} | {edges} | {spans} | {most:g} s | {found.said} |")
            print(lines[-1], flush=True)
    return lines


def main() -> int:
    """Print and write the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--short", action="store_true", help="28 s only")
    options = parser.parse_args()
    lines = ["# Any encoder", "", f"{machine()}. One process, one worker; CPU time.", "", *short_rows()]
    if not options.short:
        lines += long_rows()
    RESULTS.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
