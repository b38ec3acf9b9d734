"""Leaves out runs in which the motor never moves, beside others in which it does: no reader of a bag takes them."""

from collections.abc import Sequence

from motor_identification.logs.run import Run


def leave_out_still_runs(runs: Sequence[Run]) -> tuple[tuple[Run, ...], tuple[str, ...]]:
    """The runs with motion, and a finding that tells up to which voltage it stood in the others; all, if none moves."""
    moving = tuple(run for run in runs if moves(run))
    if not moving or len(moving) == len(runs):
        return tuple(runs), ()
    still = [run for run in runs if not moves(run)]
    largest = max(abs(sample.voltage) for run in still for sample in run.samples)
    which = "1 run" if len(still) == 1 else f"{len(still)} runs"
    named = ", ".join(run.label for run in still[:8])
    return moving, (f"Left out: {which} in which the motor never moves, at {largest:.3g} V at most ({named}).",)


def moves(run: Run) -> bool:
    """Whether the motor moves at all in a run."""
    first = run.samples[0].edge_count
    return any(sample.speed != 0.0 or sample.edge_count != first for sample in run.samples)
