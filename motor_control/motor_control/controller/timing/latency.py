"""Estimate a sample's age from two clocks that nobody has set, the plant's and ours; and see what comes back how late.

The difference between them is smallest for the sample that took the least time to get here, so a sample is as old as
its own difference is larger (plus that least time, which no one can know). The two clocks may run apart: the smallest
difference is let rise by `DRIFT`, more than a ceramic resonator is off.

What has always been late by the same time shows no age. But each sample says which voltage the plant applies, and that
has to be one of the latest that were asked for, or less. A motor that gets more than any of them is driven by what was
right a while ago (a link that holds samples or voltages back), or by somebody else: a loop around that swings.
"""

from dataclasses import dataclass
from math import exp

from motor_model.sample import Sample

DRIFT = 0.01  # [s/s] twice the 0.5 % of a board with a ceramic resonator
MORE, SOME = 1.1, 0.02  # times what was asked for, and of the voltage limit: a smoothed supply, and rounding
FORGET = 1.0  # [s] time constant
ANSWERS = 3  # that may be on their way however long they take: the plant's next sample, and one that is read meanwhile
# [s] of the whole voltage in excess. Motors of 30 to 600 rad/s with the default gains, at 200 Hz and 1 kHz, turned
# round from half of their top speed: 0 up to 20 ms late; 0.04 with a model at 45 ms, of which it settles; at 60 ms,
# where each of them swings over a third of its top speed and more, 0.14 and more.
MOST = 0.05
LONGEST = 0.25  # [s] of a window: who allows more wants no such check
LATE = (
    "The plant applies {:.3g} V, and no more than {:.3g} V was asked for in the last {:.0f} ms: its samples or its "
    "voltages are late (a slow link to it), or somebody else drives it."
)
PAUSE = 0.4  # [s] without a sample, in which a plant's clock may have stood still: a simulation that was held up


@dataclass(frozen=True, slots=True)
class LatencyState:
    """The smallest difference so far."""

    sample_time: int  # [ns] of the latest sample
    now: float  # [s] when it came
    offset: float  # [s] the smallest of now − sample_time


def track_latency(state: LatencyState | None, sample_time: int, now: float) -> tuple[float, LatencyState]:
    """Estimate the age [s] of a sample that is answered at `now` [s]; a clock that steps back or pauses begins anew."""
    difference = now - sample_time * 1e-9
    if state is None or sample_time < state.sample_time or now - state.now > PAUSE:
        return 0.0, LatencyState(sample_time, now, difference)
    offset = min(state.offset + DRIFT * max(now - state.now, 0.0), difference)
    return difference - offset, LatencyState(sample_time, now, offset)


@dataclass(frozen=True, slots=True)
class Echo:
    """What was asked for, at which sample [ns], newest last; and by how much the plant has applied more."""

    asked: tuple[tuple[int, float], ...] = ()  # [V]
    excess: float = 0.0  # [s] of the whole voltage


def follow_echo(
    echo: Echo, sample: Sample, answer: tuple[int, float], window: float, voltage_limit: float
) -> tuple[str, Echo]:
    """Follow one sample and the answer [V] to the one before it [ns]: a sentence if the motor has to stop, else "".

    window [s]: how late an answer may be. Nothing is known until so much has been asked for.
    """
    if window > LONGEST:
        return "", Echo()
    since = sample.sample_time - round(window * 1e9)
    asked = (*echo.asked, answer)
    while len(asked) > ANSWERS and asked[1][0] <= since:  # the last one before the window may act at its beginning
        asked = asked[1:]
    dt = (sample.sample_time - answer[0]) * 1e-9
    if dt <= 0.0 or voltage_limit <= 0.0:
        return "", Echo(asked, echo.excess)
    way = -1.0 if sample.voltage < 0.0 else 1.0
    most = max(0.0, *(way * voltage for _, voltage in asked))
    known = len(asked) > ANSWERS and asked[0][0] <= since
    excess = max(way * sample.voltage - MORE * most - SOME * voltage_limit, 0.0) / voltage_limit if known else 0.0
    after = Echo(asked, echo.excess * exp(-dt / FORGET) + excess * dt)
    late = after.excess >= MOST and excess > 0.0
    return (LATE.format(sample.voltage, way * most, 1e3 * window) if late else ""), after
