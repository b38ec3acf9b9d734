"""Leave out the beginning of a log in which a motor was driven and not powered: its supply was switched on later."""

import numpy as np

from motor_identification.logs.correlation import correlate
from motor_identification.logs.form import CsvForm, Kind
from motor_identification.logs.signals import Bools, Floats, Signals

ROWS = 20  # in which a motor stands, or runs: of fewer, a late start is its friction's, or a dead time's
FEWEST_CHANGES = 3  # of the drive while it stands: no dead time is as long, unless the drive goes on in every row
LAGS = 50  # between none and the rows of the standstill, by which the motion may follow its voltage all along
TWICE = 2.0  # what no lag leaves of the correlation to 1, to what the best does: one that repeats comes near by others
HALF = 0.5  # of the voltage at which it stood: it runs later by that much and less
LATE = 0.5  # of the time that it was driven and stood, from which on a lag all along explains the late start
MOSTLY = 0.8  # of the rows with so little voltage, in which it runs
# A motor that stood at so much of the largest voltage, and then turns round at half of it and less, and so often, is
# not held by friction: to turn round it has to start again.
NEARLY, TURNS = 0.9, 3


def drop_unpowered_start(signals: Signals, form: CsvForm) -> tuple[Signals, list[str]]:
    """Leave out the first rows of runs in which the motor stands at voltages at half of which it runs later."""
    keep, said = np.ones(len(signals), np.bool_), []
    for run in signals.runs.values():
        volts, moves = np.abs(signals.voltage[run]), mark_motion(signals.motion[run], form.kind)
        still = int(np.argmax(moves)) if moves.any() else 0
        stood = find_standing_voltage(volts[:still])
        little = (volts[still:] > 0.0) & (volts[still:] <= HALF * stood)
        if np.count_nonzero(little) < ROWS or np.mean(moves[still:][little]) < MOSTLY:
            continue
        held = _breaks_away(volts, still) and not _turns_round(volts, signals.motion[run], form.kind, still, stood)
        if held or _is_as_late_later(signals.voltage[run], signals.motion[run], form.kind, still):
            continue
        keep[run.start : run.start + still - 1] = False
        said.append(
            f"Left out: the first {still - 1} rows, in which {form.motion} stands at up to {stood:.3g} V and behind "
            f"which it runs at {HALF * stood:.3g} V and less: the motor was not powered yet (assumed)."
        )
    return signals.only(keep), said


def _breaks_away(volts: Floats, still: int) -> bool:
    """Whether a motor starts in a row at more voltage, shape (K,), than there was before: friction held it until then.

    Through the zeros of a chirp it runs on at less. Measured: gearmotors that start at 1.6 and 2.0 V and run at 0.8 V.
    A controller takes its voltage away in the row that shows the first count, and gives it back.
    """
    before, behind = volts[:still], volts[still : still + ROWS]
    return bool(np.max(behind) >= np.max(before) and np.argmax(before) >= still - ROWS)


def _turns_round(volts: Floats, motion: Floats, kind: Kind, still: int, stood: float) -> bool:
    """Whether a motor that stood at nearly all the voltage there is, shape (K,), starts the other way at half of it."""
    if stood < NEARLY * float(np.max(volts)):
        return False
    speed = list_advances(motion, kind)
    moving = still + np.flatnonzero(speed[still:])
    turned = moving[1:][np.diff(np.sign(speed[moving])) != 0.0]
    return int(np.count_nonzero(volts[turned] <= HALF * stood)) >= TURNS


def _is_as_late_later(voltage: Floats, motion: Floats, kind: Kind, still: int) -> bool:
    """Whether a motor, shape (K,), follows its voltage [V] half as late all along as it began to: a dead time.

    A chirp through a host that answers 0.15 s late stood 0.25 s at first, and was taken for one without a supply.
    """
    rows = still - int(np.argmax(voltage != 0.0))
    speed = motion if kind is Kind.SPEED else np.gradient(motion)
    lags = np.unique(np.linspace(0, rows, LAGS).astype(np.int64))
    pairs = ((voltage[still - lag : len(voltage) - lag], speed[still:]) for lag in lags)
    missing = np.array([1.0 - abs(correlate(*pair)) for pair in pairs])
    best = int(np.argmin(missing))
    return bool(lags[best] >= LATE * rows and missing[0] > TWICE * missing[best])


def find_standing_voltage(volts: Floats) -> float:
    """The voltage [V] that was there in so many rows of a standstill, shape (S,), and changed; 0 where it was not."""
    driven = volts[np.cumsum(volts) > 0.0]
    if np.count_nonzero(driven) < ROWS or np.count_nonzero(np.diff(driven)) < FEWEST_CHANGES:
        return 0.0
    return float(np.sort(driven)[-ROWS])


def list_advances(motion: Floats, kind: Kind) -> Floats:
    """List by how much each row (K,) of a motion says that the motor turns: speeds, or the way since the row before."""
    return motion if kind is Kind.SPEED else np.diff(motion, prepend=motion[:1])


def mark_motion(motion: Floats, kind: Kind) -> Bools:
    """Mark the rows (K,) in which a motor moves: of counts, those that differ from the ones some rows away."""
    if kind is Kind.SPEED:
        return np.asarray(motion != 0.0)
    moves = np.zeros(len(motion), np.bool_)
    moves[1:] = motion[1:] != motion[:-1]
    moves[ROWS:] |= motion[ROWS:] != motion[:-ROWS]
    return moves
