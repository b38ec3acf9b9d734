"""Count what interrupts a run again and again: samples or references that are no numbers between good ones.

One of them is 0 V until the next good one comes. But half of all samples at 0 V and half at full voltage is half of the
voltage, for ever, and every check that looks for a voltage that lasts sees none.
"""

from dataclasses import dataclass

MOST = 3  # interruptions
WITHIN = 1.0  # [s] of the one before: what comes more seldom leaves the checks for faults time enough
SENTENCE = "{} It comes and goes, {} times within a second of one another: see who else publishes."


@dataclass(frozen=True, slots=True)
class Interruptions:
    """How often it went from good to bad."""

    bad: bool = False  # the latest sample, or what was asked for at it
    count: int = 0
    latest: float = 0.0  # [s] when it last went bad


def count_interruption(before: Interruptions, reason: str, now: float) -> tuple[str, Interruptions]:
    """Count a reason why this sample is not acted on ("": it is), at a time [s]: a sentence if it is one too many."""
    if not reason or before.bad:
        return "", Interruptions(bool(reason), before.count, before.latest)
    count = before.count + 1 if before.count and now - before.latest <= WITHIN else 1
    return (SENTENCE.format(reason, count) if count >= MOST else ""), Interruptions(True, count, now)
