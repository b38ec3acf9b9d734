"""Leaves out runs in which the motor never moves, or hardly begins to, beside others: no reader of a bag takes them."""

from collections.abc import Sequence

from motor_identification.logs.run import Run

FEWEST = 4  # rows in motion: of fewer, no fit has three intervals
_NAMED = 8  # runs


def leave_out_still_runs(runs: Sequence[Run]) -> tuple[tuple[Run, ...], tuple[str, ...]]:
    """The runs with motion, and findings: up to which voltage it stood in the others, and which were too short.

    All of them, if none moves long enough.
    """
    used = tuple(run for run in runs if rows_in_motion(run) >= FEWEST)
    if not used or len(used) == len(runs):
        return tuple(runs), ()
    still = [run for run in runs if not rows_in_motion(run)]
    short = [run for run in runs if 0 < rows_in_motion(run) < FEWEST]
    said = []
    if still:
        largest = max(abs(sample.voltage) for run in still for sample in run.samples)
        said.append(f"Left out: {_which(still)} in which the motor never moves, at {largest:.3g} V at most")
    if short:
        said.append(f"Left out: {_which(short)} of fewer than {FEWEST} rows in motion")
    lists = [", ".join(run.label for run in some[:_NAMED]) for some in (still, short) if some]
    return used, tuple(f"{line} ({named})." for line, named in zip(said, lists, strict=True))


def _which(runs: Sequence[Run]) -> str:
    return "1 run" if len(runs) == 1 else f"{len(runs)} runs"


def rows_in_motion(run: Run) -> int:
    """In how many rows of a run the motor moves."""
    counts = [sample.edge_count for sample in run.samples]
    before = [counts[0], *counts[:-1]]
    return sum(
        sample.speed != 0.0 or count != last for sample, count, last in zip(run.samples, counts, before, strict=True)
    )
