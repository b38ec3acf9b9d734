"""Count what interrupts a run again and again: samples or references that are no numbers, or a `voltage_limit` of 0.

One of them is 0 V until the next good one comes. But half of all samples at 0 V and half at full voltage is half of the
voltage, for ever, and every check that looks for a voltage that lasts sees none.
"""

from dataclasses import dataclass

MOST = 3  # interruptions
# [s] of the one before, at least: what comes more seldom leaves the checks for faults time enough. They take as long as
# `stall_time`, and begin anew after an interruption; so it is `STALLS` of that where that is more.
WITHIN, STALLS = 1.0, 2.0
SENTENCE = "{} It comes and goes, {} times within {} of one another: see who else publishes, or sets parameters."


@dataclass(frozen=True, slots=True)
class Interruptions:
    """How often it went from good to bad."""

    bad: bool = False  # the latest sample, or what was asked for at it
    count: int = 0
    latest: float = 0.0  # [s] when it last went bad


def count_interruption(
    before: Interruptions, reason: str, now: float, stall_time: float = 0.0
) -> tuple[str, Interruptions]:
    """Count a reason why this sample is not acted on ("": it is), at a time [s]: a sentence if it is one too many."""
    if not reason or before.bad:
        return "", Interruptions(bool(reason), before.count, before.latest)
    within = max(WITHIN, STALLS * stall_time)
    count = before.count + 1 if before.count and now - before.latest <= within else 1
    words = SENTENCE.format(reason, count, "a second" if within == WITHIN else f"{within:g} s")
    return (words if count >= MOST else ""), Interruptions(True, count, now)
