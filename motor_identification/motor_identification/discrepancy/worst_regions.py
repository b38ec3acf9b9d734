"""Find the worst regions: the conditions under which most of the gap arises, and the intervals that meet them."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from motor_identification.discrepancy.operating_conditions import OperatingConditions, find_conditions
from motor_identification.recording import Bools, Floats, have_steady_states
from motor_identification.validation.held_out import HeldOut

LEAST_CONTRAST = 0.05  # [nat] of contrast below which no region is worse than the rest
SECOND_CONTRAST = 0.1  # [nat] that a second condition must add
MOMENT, LEAST_VALUES = 1.0 / 60.0, 3  # of the time, which a region has at least, or values off by more than the sensor
RECORDING_PENALTY = 0.5  # [nat] by which "in this recording" has to be better than what a motor does
THRESHOLD_SHARES = (
    0.01,
    0.02,
    0.05,
    0.1,
    0.15,
    0.2,
    0.3,
    0.5,
    0.7,
    0.8,
    0.9,
)  # of the largest: thresholds that are tried
SINCE_THRESHOLDS = (0.02, 0.05, 0.1, 0.2, 0.5, 1.0)  # [s]
STEADY_ACCELERATION = 0.02  # of the largest acceleration


@dataclass(frozen=True)
class Region:
    """Some of the intervals that count, and what is left there."""

    words: str
    inside: Bools  # (I,) which of `HeldOut.residuals`
    gap: float  # [rad/s]
    floor: float  # [rad/s]
    excess: float  # share of what the gap has above the floor (in squares)
    time: float  # share of the time
    bias: float  # [rad/s] simulated − measured along the motion, time-weighted: positive is too fast
    offset: float  # [rad/s] the same whichever way it turns: positive is too far forward


@dataclass(frozen=True)
class _Condition:
    axis: str
    words: str
    inside: Bools


def find_worst_regions(held: HeldOut, share: float, count: int = 3) -> tuple[Region, ...]:
    """Find the worst regions that do not overlap, the worst first; none only where no motion is held out."""
    if not held.counted.any():
        return ()
    seen = find_conditions(held)
    squares = held.weight * (held.residuals**2 - held.floors(share) ** 2)
    conditions = list(_conditions(held, seen))
    open_, found = np.ones(len(squares), dtype=bool), list[Region]()
    while len(found) < count:
        region = _worst_of(held, share, seen, squares, conditions, open_)
        if found and (region.excess < 0.1 or region.time == 1.0 or region.gap < 2.0 * region.floor):
            break
        found.append(region)
        open_ &= ~region.inside
        if region.time == 1.0:
            break
    return tuple(found)


def _worst_of(
    held: HeldOut, share: float, seen: OperatingConditions, squares: Floats, conditions: list[_Condition], open_: Bools
) -> Region:
    """The condition, or two on different axes, whose share of the excess is most above its share of the time.

    A value or two in a moment are no condition: a count more, over a very short row, held 42 % of an excess.
    """
    inside = np.array([one.inside & open_ for one in conditions], dtype=np.float64)
    excess = (inside * squares) @ inside.T / max(float(squares @ open_), 1e-300)
    time = (inside * held.weight) @ inside.T / max(float(held.weight @ open_), 1e-300)
    beyond = (inside * (squares > 0.0)) @ inside.T
    contrast = np.where(
        (time >= MOMENT) | (beyond >= LEAST_VALUES), measure_contrast(np.clip(excess, 0.0, 1.0), time), 0.0
    )
    axes = np.array([one.axis for one in conditions])
    of_recording = (axes[:, None] == "recording") | (axes[None, :] == "recording")
    contrast = np.where(of_recording, contrast - RECORDING_PENALTY, contrast)
    alone = np.diag(contrast)
    pairs = np.where(axes[:, None] == axes[None, :], 0.0, contrast)
    i, j = np.unravel_index(int(np.argmax(pairs)), pairs.shape)
    single = int(np.argmax(alone))
    chosen = [conditions[single]]
    if pairs[i, j] > alone[single] + SECOND_CONTRAST:
        chosen = [conditions[min(i, j)], conditions[max(i, j)]]
    elif alone[single] < LEAST_CONTRAST:
        chosen = [_Condition("", "everywhere alike", np.ones(len(squares), dtype=bool))]
    return _region(held, share, seen, squares, chosen, open_)


def measure_contrast(excess: Floats, time: Floats) -> Floats:
    """Measure the contrast [nat], a Kullback-Leibler divergence of the excess from the time; 0 where there is less."""
    tiny = 1e-12
    inner = excess * np.log((excess + tiny) / (time + tiny))
    outer = (1.0 - excess) * np.log((1.0 - excess + tiny) / (1.0 - time + tiny))
    return np.asarray(np.where(excess > time, inner + outer, 0.0))


def _region(
    held: HeldOut, share: float, seen: OperatingConditions, squares: Floats, chosen: list[_Condition], open_: Bools
) -> Region:
    inside = np.all([one.inside for one in chosen], axis=0) & open_
    weight = held.weight[inside]
    left, still = held.residuals[inside], seen.still[inside]
    bias = np.where(still | (seen.speed[inside] == 0.0), np.abs(left), left * np.sign(seen.speed[inside]))
    total = max(float(weight.sum()), 1e-300)
    everything = bool(inside.all())
    return Region(
        words=("" if bool(open_.all()) else "elsewhere, ") + _joined(chosen),
        inside=inside,
        gap=float(np.sqrt(weight @ left**2 / total)),
        floor=float(np.sqrt(weight @ held.floors(share)[inside] ** 2 / total)),
        excess=1.0 if everything else float(np.clip(squares[inside].sum() / max(squares.sum(), 1e-300), 0.0, 1.0)),
        time=1.0 if everything else float(weight.sum()),
        bias=float(weight @ bias / total),
        offset=float(weight @ left / total),
    )


def _joined(chosen: list[_Condition]) -> str:
    """Conditions as one phrase: a second "at" is left out."""
    first, *others = (one.words for one in chosen)
    return ", ".join((first, *(words.removeprefix("at ") for words in others)))


def _conditions(held: HeldOut, seen: OperatingConditions) -> Iterator[_Condition]:
    """Everything that a region may be said to be, in the order in which two of them are said."""
    size, moving = np.abs(seen.speed), ~seen.still
    yield _Condition("speed", "at standstill", seen.still)
    for limit in choose_thresholds(size):
        yield _Condition("speed", f"at |ω| < {limit:g} rad/s", moving & (size < limit))
        yield _Condition("speed", f"at |ω| > {limit:g} rad/s", size > limit)
    yield _Condition("direction", "in forward motion", seen.speed > 0.0)
    yield _Condition("direction", "in backward motion", seen.speed < 0.0)
    limit = STEADY_ACCELERATION * float(np.abs(seen.acceleration[moving]).max(initial=0.0))
    yield _Condition("acceleration", "during acceleration", moving & (seen.acceleration > limit))
    yield _Condition("acceleration", "during deceleration", moving & (seen.acceleration < -limit))
    yield _Condition("acceleration", "at constant speed", moving & (np.abs(seen.acceleration) <= limit))
    yield from _driven(seen, moving)
    for limit in SINCE_THRESHOLDS:
        yield _Condition("since", f"within {limit:g} s after a standstill or reversal", moving & (seen.since < limit))
    for limit in () if have_steady_states(held.recordings) else choose_thresholds(seen.time):
        yield _Condition("time", f"at t > {limit:g} s", seen.time > limit)
        yield _Condition("time", f"at t < {limit:g} s", seen.time < limit)
    if len(held.recordings) > 1:
        for number, recording in enumerate(held.recordings):
            yield _Condition("recording", f"in {recording.uri}", seen.recording == number)


def _driven(seen: OperatingConditions, moving: Bools) -> Iterator[_Condition]:
    size = np.abs(seen.voltage)
    yield _Condition("voltage", "at u = 0", moving & (size == 0.0))
    yield _Condition("voltage", "while the voltage opposes the motion", seen.voltage * seen.speed < 0.0)
    for limit in choose_thresholds(size):
        yield _Condition("voltage", f"at |u| < {limit:g} V", moving & (size < limit))
        yield _Condition("voltage", f"at |u| > {limit:g} V", moving & (size > limit))


def choose_thresholds(values: Floats) -> list[float]:
    """Choose thresholds: shares of the largest value, rounded to two digits."""
    top = float(values.max(initial=0.0))
    return sorted({float(f"{share * top:.2g}") for share in THRESHOLD_SHARES if share * top > 0.0})
