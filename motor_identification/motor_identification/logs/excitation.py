"""What a log's motion can show, before anything is fitted: ways, levels, standing, full voltage."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.log import Log
from motor_identification.logs.run import Run
from motor_model.sample import Measurement

STANDING = 0.01  # of the largest speed: below, the motor stands
FASTER = 0.03  # of the largest speed, that a motor comes to the other way: less is the noise of its rest
CHANGES = 0.5  # of the largest voltage, whose change no speed that turns stays the same in
ALIKE = 0.02  # of the largest voltage, within which two levels are one
MOSTLY = 0.5  # of the rows: standing for longer is worth a word
FULL = 0.98  # of the full voltage, from which on it is at its limit
SWEPT = 0.1  # of the rows, at voltages that do not last
FEW = 0.02  # of the rows: what is rarer shows nothing


@dataclass(frozen=True)
class Excitation:
    """Shares are of the rows, 0 to 1."""

    low: float  # [V]
    high: float  # [V]
    levels: int  # of the voltage but 0, apart by more than a fiftieth of the largest
    forward: float
    backward: float
    standing: float
    full: float  # at the largest voltage that the log knows


def measure_excitation(log: Log) -> Excitation:
    """Measure what drove the motor in a log, and how it moved."""
    voltage = np.concatenate([_column(run, "voltage") for run in log.runs])
    speed = np.concatenate([_column(run, "speed") for run in log.runs])
    top = float(np.quantile(np.abs(speed), 0.99))
    largest = float(np.max(np.abs(voltage)))
    stale = np.ptp(speed) == 0.0 and np.ptp(voltage) > CHANGES * largest  # a sensor shows its last one
    still = np.ones(len(speed), np.bool_) if stale or top <= 0.0 else np.abs(speed) <= STANDING * top
    return Excitation(
        low=float(voltage.min()),
        high=float(voltage.max()),
        levels=_levels(voltage, ALIKE * largest),
        forward=_share(speed, still, top),
        backward=_share(-speed, still, top),
        standing=float(np.mean(still)),
        full=float(np.mean(np.abs(voltage) >= FULL * log.info.max_voltage)),
    )


def describe_excitation(log: Log) -> list[str]:
    """Say what drove the motor, and what can be identified from it and what not."""
    found = measure_excitation(log)
    ways = "both ways" if min(found.forward, found.backward) > FEW else "one way only"
    about = (
        f"Excitation: {_voltages(found)}, {ways}; "
        f"the motor stands in {100 * found.standing:.0f} % of the rows, full voltage in {100 * found.full:.0f} %."
    )
    lines = [about]
    if _stands(found):
        return [*lines, "The motor hardly moves: nothing can be identified from this."]
    unsigned = found.low >= 0.0 and ways == "both ways"
    if unsigned:
        no_speed = (
            "" if log.info.measurement is Measurement.SPEED else ", or a speed was taken for a position (--speed)"
        )
        lines.append(
            "Caution: the voltage has no sign, and the motor runs both ways: a column with the direction is missing "
            f"(--direction COL), or something else drives it{no_speed}."
        )
    missing = []
    if ways == "one way only":
        missing.append("friction, a constant load and a dead zone look alike (it runs one way only)")
    if found.levels < 2:
        missing.append("kv and friction cannot be separated (one voltage only)")
    if log.info.measurement is Measurement.SPEED and log.info.sample_period > 10.0:
        missing.append("ka and delays cannot be seen (steady states)")
    if missing:
        lines.append(f"Not to be had from it: {'; '.join(missing)}.")
    elif not unsigned:
        lines.append("kv, ka and friction can be identified.")
    if found.standing > MOSTLY:
        lines.append(f"The motor stands for {100 * found.standing:.0f} % of the time, which says little.")
    return lines


def hardly_moves(log: Log) -> bool:
    """Whether the motor stands in nearly all of a log's rows."""
    return _stands(measure_excitation(log))


def _stands(found: Excitation) -> bool:
    return found.forward + found.backward < FEW


def _share(speed: NDArray[np.float64], still: NDArray[np.bool_], top: float) -> float:
    """The share of the rows (K,) in which a motor runs forward; 0 where that is never more than noise."""
    return float(np.mean(~still & (speed > 0.0))) if np.max(speed) > FASTER * top else 0.0


def _column(run: Run, name: str) -> NDArray[np.float64]:
    return np.array([getattr(sample, name) for sample in run.samples], dtype=np.float64)


def _levels(voltage: NDArray[np.float64], apart: float) -> int:
    """Different voltages, counted up to 20: those that last for a share of the rows, or all where many do not."""
    values = np.sort(voltage)
    begins = [0]
    while begins[-1] < len(values):
        begins.append(int(np.searchsorted(values, values[begins[-1]] + max(apart, 1e-12), side="right")))
    counts = np.diff(begins)
    lasts = counts >= min(FEW * len(voltage), 5)
    if np.sum(counts[~lasts]) >= SWEPT * len(voltage):  # a ramp, a sweep
        lasts[:] = True
    first, last = values[begins[:-1]], values[np.array(begins[1:]) - 1]
    driven = (first > 0.5 * apart) | (last < -0.5 * apart)
    return int(min(np.count_nonzero(driven & lasts), 20))


def _voltages(found: Excitation) -> str:
    if found.low == found.high:
        return f"{found.low:.3g} V all the time"
    near_0 = 0.5 * ALIKE * max(abs(found.low), abs(found.high))
    beside = "beside 0" if found.low <= near_0 and found.high >= -near_0 else "but for a few rows"
    many = {1: f"a single level {beside}", 20: "20 levels and more"}.get(found.levels, f"{found.levels} levels")
    return f"{found.low:.3g} to {found.high:.3g} V in {many}"
