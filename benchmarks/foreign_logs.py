"""Logs as other people make them, of motors of any size, simulated: does the diagnosis name what is in them?

Top speeds of 5 to 2,000 rad/s, supplies of 3 to 48 V, time constants of 20 to 600 ms, rows of 20 to 1,000 Hz; speeds
or positions of any encoder, or a tachogenerator with noise of 0.1 to 2 % of its top speed, as it is or by a converter;
one excitation alone (steps, a staircase, a PRBS, ramps, a sweep, a speed loop), and a random torque of up to 1.5 % of
the supply. Friction is in four of five; a delay, drag, a dead zone, an asymmetry or a load now and then. The tests'
independent plant moves; `import_log` is told nothing.
"""

import os
import tempfile
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from time import process_time

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy: small matrices

import numpy as np
from foreign_logs_cases import EXCITATIONS, SENSORS, Case, draw, write
from foreign_truth import measure_lead
from machine import commit, machine
from seeded_cases import run_seeds

from motor_identification.diagnose import diagnose
from motor_identification.diagnosis.candidate_test import likelihood_threshold
from motor_identification.diagnosis.result import Diagnosis
from motor_identification.logs.columns.said import Said
from motor_identification.logs.imported import import_log
from motor_identification.recording import check, recording_of
from motor_model.effects import EFFECT_BY_NAME, normalised
from motor_model.errors import MotorError

RESULTS = Path(__file__).with_name("results") / "foreign_logs.md"
LAGS = {"transport_delay", "armature_inductance"}
KINDS = ("right", "right, not all", "silent", "wrong", "refused")


@dataclass(frozen=True)
class Outcome:
    """What a log gave."""

    case: Case
    kind: str
    said: str
    error: float  # relative, of kv
    seconds: float  # of a processor
    lead: float = np.nan  # of log likelihood, of what is hidden over what was named; where that is not all, or wrong

    @property
    def is_told(self) -> bool:
        """Whether the log tells more than was named, as plainly as the diagnosis asks."""
        return self.lead > likelihood_threshold()


def judge(case: Case, found: Diagnosis) -> str:
    """Sort a diagnosis into its kind; one of a finding's rivals counts as its name."""
    known = tuple(name for name in case.hidden if name in EFFECT_BY_NAME)
    hidden, outside = set(normalised(known)), known != case.hidden
    names = [{one.effect, *one.ambiguous_with} for one in found.findings]
    unexplained = found.verdict.value == "unexplained"
    if case.logger.is_smoothed:  # a lag of the sensor, by whichever name
        names = [name for name in names if name & hidden or not name & LAGS]
    if any(not name & hidden for name in names):
        return "wrong"
    if outside:
        return "right" if unexplained and len(names) == len(hidden) else "right, not all" if names else "silent"
    unexplained &= not case.logger.is_smoothed
    if not hidden and unexplained:
        return "wrong"
    if all(any(effect in name for name in names) for effect in hidden):
        return "right" if not unexplained else "right, not all"
    return "right, not all" if names else "silent"


def find(case: Case) -> Outcome:
    """Write, import and diagnose a case."""
    begun = process_time()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "log.csv"
        write(case, path)
        try:
            (motor,) = import_log(path, Said()).motors
            runs = [check(recording_of(part.samples, motor.log.info, part.label)) for part in motor.log.runs]
            found = diagnose(runs)
        except MotorError as error:
            return Outcome(case, "refused", str(error).replace(str(path), "log.csv"), np.nan, process_time() - begun)
    said = " + ".join(" or ".join((one.effect, *one.ambiguous_with)) for one in found.findings) or "–"
    error = found.model.parameters.value("kv") / case.values["kv"] - 1.0
    kind, seconds = judge(case, found), process_time() - begun
    lead = np.nan if kind == "right" else measure_lead(runs, case.values, case.hidden, found)
    return Outcome(case, kind, f"{said} ({found.verdict.value})", error, seconds, lead)


def row(title: str, outcomes: list[Outcome]) -> str:
    """A row of the table."""
    count = Counter(one.kind for one in outcomes)
    errors = [abs(one.error) for one in outcomes if one.kind.startswith("right")]
    cells = [str(count[kind]) for kind in KINDS] + [str(sum(one.is_told for one in outcomes))]
    cells += [f"{np.median(errors):.1%}" if errors else "–", f"{np.median([one.seconds for one in outcomes]):.0f} s"]
    return f"| {title} | {len(outcomes)} | " + " | ".join(cells) + " |"


def page(outcomes: list[Outcome], first: int, name: str, about: str) -> str:
    """The whole page of the benchmark of this name."""
    groups = {"all": outcomes}
    groups |= {f"… {name}": [one for one in outcomes if one.case.excitation == name] for name in EXCITATIONS}
    groups |= {f"… {name}": [one for one in outcomes if one.case.sensor == name] for name in SENSORS}
    shares = sorted({one.case.torque / one.case.supply for one in outcomes})
    for share in shares:
        groups[f"… torque {share:.1%}"] = [one for one in outcomes if one.case.torque / one.case.supply == share]
    lines = [
        f"# {about.splitlines()[0]}",
        "",
        f"`python benchmarks/{name}.py --cases {len(outcomes)} --first {first}`",
        f"(commit {commit()}; {machine()}).",
        *about.splitlines()[1:],
        '"Right": all that is in the motor is named, or one of a few that the log cannot tell apart; "silent": nothing',
        "is named, which a single step or the size of an effect may deserve; wrong: a name whose effect is not there,",
        'or "unexplained" where nothing is missing. "Told": of those not right, in how many the log tells more:',
        "what is hidden, fitted from its true values, is likelier than what was named by more than a diagnosis asks",
        f"({likelihood_threshold():.1f} of log likelihood). In the others nobody could say more; what is outside the",
        "table is not asked.",
        "",
        f"| logs | number | {' | '.join(KINDS)} | told | error of kv where right | CPU time |",
        "|---|---:|" + "---:|" * (len(KINDS) + 3),
        *(row(title, some) for title, some in groups.items() if some),
        "",
        "What was not right:",
        "",
    ]
    for one in sorted(outcomes, key=lambda one: -KINDS.index(one.kind)):
        if one.kind != "right":
            truth = " + ".join(one.case.hidden) or "nothing"
            lead = "" if np.isnan(one.lead) else f"; likelier by {one.lead:.0f}"
            lines.append(f"- {one.case.seed}, {one.kind}: {one.said} for {truth} ({one.case.describe()}{lead})")
    return "\n".join([*lines, ""])


def say(outcome: Outcome) -> str:
    """Say an outcome in a line."""
    case = outcome.case
    truth = " + ".join(case.hidden) or "nothing"
    return f"{case.seed} {outcome.kind} | {truth} | {outcome.said} | {case.describe()}"


def find_drawn(draw_case: Callable[[int], Case], seed: int) -> Outcome:
    """Draw, write, import and diagnose a case."""
    return find(draw_case(seed))


def run(draw_case: Callable[[int], Case], results: Path, about: str) -> None:
    """Print the cases that a benchmark draws as they come, and write its page."""
    run_seeds(
        partial(find_drawn, draw_case),
        say,
        lambda outcomes, first: page(outcomes, first, results.stem, about),
        results,
        about,
        100,
    )


def main() -> None:
    """Print the cases as they come, and write the page."""
    run(draw, RESULTS, __doc__ or "")


if __name__ == "__main__":
    main()
