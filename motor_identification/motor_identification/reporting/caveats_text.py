"""What a diagnosis's numbers are beside or depend on, in words: a random torque, gains of runs, an assumed supply."""

from collections.abc import Sequence
from itertools import pairwise
from pathlib import PurePath

import numpy as np

from motor_identification.diagnosis.candidate_model import tosses
from motor_identification.diagnosis.evidence.command_evidence import find_falling, find_stopped
from motor_identification.diagnosis.result import Diagnosis, Finding
from motor_identification.diagnosis.thresholds import EXPLAINED_GAP, WILD_TIME
from motor_identification.noise.error_model import Disturbance, average_correlation
from motor_identification.recording import Floats, have_steady_states
from motor_identification.reporting.names import effect_name, join_names
from motor_identification.reporting.numbers import format_measured
from motor_identification.validation.held_out import HeldOut
from motor_model.effects import EFFECT_BY_NAME

TOO_STRONG = (
    " That is more than the {:.3g} V that was applied: rather noise of the sensor, times of rows that are off, or "
    "something else that moves the shaft."
)
NO_TORQUE = "What is left is no random torque: none is found beside it ({})."
OF_STATES = "The rest is random: {} from state to state."
IN_A_ROW = (
    "The rest is random: a torque that lasts for less than a row ({:.3g} s), of which strength and correlation time do "
    "not show apart; its mean over a row is {:.2g} V RMS."
)
QUICK = (
    " It lasts for less than a row and is {:.2g} % of the voltage that was applied: rather noise of the sensor, or "
    "stamps that are off by a part of a row."
)
LARGE = (
    " That is {:.0f} % of the {:.3g} V that was applied at most{}: the voltage that was logged is probably not what "
    "drove the motor."
)
TOSSED = (
    " That is {:.2g} % of the voltage that was applied at most, and more than gears and loads make: what is not in the "
    "table may be in it, and what was fitted beside it off by more than its errors."
)
STOOD = ", under half of which and more it stood for {:.3g} s after it had turned"
LARGE_SHARE = 0.5  # of the largest voltage: a motor on which a random torque of more acts follows something else
SLOW = 0.05  # of the largest speed: below it a motor has stopped
STOOD_SHARE = 0.1  # of the time in which it was driven by a large voltage: less may be a start, or a turn
MUCH = 0.02  # of the largest voltage: the RMS of a torque that is no trifle
NEGLIGIBLE = 1e-4  # of the largest voltage: the RMS of a torque that leaves nothing of a gap
BREAKAWAY, PEAKS = "breakaway_voltage", 3.0  # standard deviations that a torque reaches now and then
CUT = (
    "It came to rest wherever the voltage stayed below {:.2g} V or so: firmware or a driver that puts out nothing "
    "below a least duty does that, too."
)
COMES_TO_REST = 3.0  # time constants below the breakaway in which a motor is on its way to rest, and that are seen
STILL_RUNS = 0.1  # of that time, in which a motor that runs on below its breakaway would turn half as fast as it should
SUPPLY = (
    "A supply of {:.4g} V is assumed, the most that was applied unless the import said more: of another one "
    "(import_log --max-voltage) "
)
LOGGED_SUPPLY = (
    "A supply of {:.4g} V is taken, the supply column's median unless the import said another or a row got more: of "
    "another one (import_log --max-voltage) "
)
OTHERWISE = "kv and what its bridge does come out otherwise."
MAY_EXPLAIN = "{} may explain what is missing."
GAINS = (
    "From run to run the speed at the same voltage differed by {:.2g} % (RMS), as it does where the supply differs; if "
    "that is a battery, log its voltage."
)
GAINS_OR_CURVE = (
    "From run to run the gain differed by {:.2g} % (RMS), as it does where the supply differs; but no two runs were at "
    "the same voltage, so that it may as well be a curve over the voltage, of the bridge or of a friction: repeat a "
    "run at the voltage of another."
)
FEW = "Most of that gap is in {} of {:,} values ({}): {:.3g} rad/s is left without. Look at stamps and values there."
FALLING = (
    "The speed falls where the voltage rises, each time: {:.3g} rad/s at {:.3g} V, {:.3g} rad/s at {:.3g} V. No motor "
    "does so: a sensor that misses counts at speed, a supply that gives way, or a load that came each time may."
)
STOPPED = (
    "From {0:.4g} s on{1} the motor stands under voltages that moved it before: switched off, blocked, or its sensor "
    "silent? Leave that part out (--stop {0:.4g}{2})."
)
MOST, NAMED = 0.9, 2  # of a gap's square that is most of it; instants that are named
MIDDLE = (0.1, 0.9)  # shares of a run's driven samples between which its voltages are said to lie
NEAR = 0.02  # of the largest voltage: below it nothing drives, and voltages that differ by no more are the same


def describe_gains(diagnosis: Diagnosis) -> str:
    """Say by how much the gain differs from run to run; empty where it does not."""
    scatter = diagnosis.gain_scatter
    if scatter <= 0.0:
        return ""
    words = GAINS if _share_voltages([one.voltage for one in diagnosis.after.recordings]) else GAINS_OR_CURVE
    return words.format(100.0 * scatter)


def _share_voltages(runs: Sequence[Floats]) -> bool:
    """Whether two runs, each of voltages [V] with shape (K,), were driven at the same voltage for a part of the time.

    Steps of one level a run, each of another, are told by a gain a run as well as by any curve over the voltage:
    fifteen such steps of one motor, on a bridge with a dead band and a limit, came to gains that differ by 7.6 %.
    """
    near = NEAR * max((float(np.max(np.abs(run), initial=0.0)) for run in runs), default=0.0)
    driven = [run[np.abs(run) > near] for run in runs if np.any(np.abs(run) > near)]
    spans = sorted(tuple(np.quantile(run, MIDDLE)) for run in driven)
    return any(above[0] <= below[1] + near for below, above in pairwise(spans))


def describe_supply(diagnosis: Diagnosis) -> str:
    """Say which supply a bridge was taken to be on, where a log does not tell and it matters; else empty."""
    names = {name for one in diagnosis.findings for name in (one.effect, *one.ambiguous_with)}
    near = [name for name in (diagnosis.nearest.effects if diagnosis.nearest else ()) if EFFECT_BY_NAME[name].of_supply]
    imported = [one for one in diagnosis.after.recordings if one.info.source == "import"]
    if not (near or any(EFFECT_BY_NAME[name].of_supply for name in names)) or not imported:
        return ""
    most = max(imported, key=lambda one: one.info.full_voltage)
    words = LOGGED_SUPPLY if np.any(np.isfinite(most.supply_voltage)) else SUPPLY
    then = MAY_EXPLAIN.format(join_names([effect_name(name) for name in near])) if near else OTHERWISE
    return words.format(most.info.full_voltage) + then


def describe_likes(diagnosis: Diagnosis) -> str:
    """Say what outside the table does the same as what was found, one sentence an effect; empty where nothing does."""
    return " ".join(said for one in diagnosis.findings if (said := EFFECT_BY_NAME[one.effect].stands_for))


def describe_cut(diagnosis: Diagnosis) -> str:
    """Say that what holds a motor may be a voltage that never came out; empty where it ran on below its breakaway.

    A friction that is smaller in motion lets a motor run on under voltages that it would not break away at.
    """
    found = [one.parameters[BREAKAWAY][0] for one in diagnosis.findings if BREAKAWAY in one.parameters]
    if not found:
        return ""
    values, held, breakaway = diagnosis.model.parameters.values, diagnosis.after, found[0]
    kv, friction = values["kv"], values.get("ks", 0.0)
    wait = COMES_TO_REST * values["ka"] / kv
    low = runs = 0.0
    for recording, data in zip(held.recordings, held.intervals, strict=True):
        volts, rows = np.abs(recording.voltage), data.find_rows(recording)
        since = recording.time - np.maximum.accumulate(np.where(volts >= breakaway, recording.time, -np.inf))
        marks = ((volts > friction) & (volts < breakaway) & (since > wait) & np.isfinite(since))[rows]
        turns = 2.0 * kv * np.abs(data.speed) > volts[rows] - friction
        low += float(data.duration[marks].sum())
        runs += float(data.duration[marks & turns].sum())
    return CUT.format(breakaway) if low > wait and runs < STILL_RUNS * low else ""


def describe_disturbance(diagnosis: Diagnosis) -> str:
    """Say how strong the random torque is that nothing predicts, with standard errors; empty where there is none."""
    found = diagnosis.disturbance
    if found is None or find_falling(diagnosis.after) is not None:
        return ""
    strength = format_measured(found.rms_voltage, found.rms_error, "V RMS")
    largest = max((float(np.max(np.abs(one.voltage))) for one in diagnosis.after.recordings), default=0.0)
    if found.rms_voltage < NEGLIGIBLE * largest and diagnosis.gap_after > EXPLAINED_GAP * diagnosis.noise_floor:
        return NO_TORQUE.format(strength)
    if found.rms_voltage < min(NEGLIGIBLE * largest, found.rms_error):  # and the sensor leaves the rest
        return ""
    if have_steady_states(diagnosis.after.recordings):
        return OF_STATES.format(strength)
    time = format_measured(found.correlation_time, found.time_error, "s")
    torque = f"The rest is random: a torque of {strength}, correlated over {time}."
    row = min((one.sample_period for one in diagnosis.after.recordings), default=0.0)
    if found.rms_error > found.rms_voltage and 0.0 < found.correlation_time < row:
        mean = found.rms_voltage * float(np.sqrt(average_correlation(np.array(row / found.correlation_time))))
        doubt = QUICK.format(100.0 * mean / largest) if mean > MUCH * largest else ""
        return IN_A_ROW.format(row, mean) + doubt
    strong = TOO_STRONG.format(largest) if found.rms_voltage > largest else ""
    if not strong and found.rms_voltage > MUCH * largest and found.correlation_time < row:
        strong = QUICK.format(100.0 * found.rms_voltage / largest)
    if not strong and found.rms_voltage > LARGE_SHARE * largest:
        strong = LARGE.format(100.0 * found.rms_voltage / largest, largest, _describe_stop(diagnosis.after, largest))
    if not strong and tosses(found, diagnosis.after.recordings):
        strong = TOSSED.format(100.0 * found.rms_voltage / largest)
    lasts = found.correlation_time >= row  # else it is rather the sensor's noise, which holds no motor
    return torque + strong + (_describe_breakaway(diagnosis.findings, found) if lasts else "")


def _describe_stop(held: HeldOut, largest: float) -> str:
    """Say for how long motors stood under a large voltage after they had turned; empty where that is next to nothing.

    largest: [V] of all recordings.
    """
    stood = driven = 0.0
    for recording, data in zip(held.recordings, held.intervals, strict=True):
        large = np.abs(recording.voltage[data.find_rows(recording)]) > LARGE_SHARE * largest
        slow = np.abs(data.speed) < SLOW * float(np.max(np.abs(data.speed), initial=0.0))
        driven += float(data.duration[large].sum())
        stood += float(data.duration[large & slow & np.logical_or.accumulate(~slow)].sum())
    return STOOD.format(stood) if stood > STOOD_SHARE * driven else ""


def describe_falling(diagnosis: Diagnosis) -> str:
    """Say that a speed falls where the voltage rises, and what may be the cause; empty where it does not."""
    found = find_falling(diagnosis.after)
    return "" if found is None else FALLING.format(found.speed, found.voltage, found.slower, found.higher)


def describe_stopped(diagnosis: Diagnosis) -> str:
    """Say from when on a motor stands that moved under the same voltages before; empty where none does."""
    recordings = diagnosis.after.recordings
    found = find_stopped(recordings)
    if found is None:
        return ""
    name = PurePath(found.recording.uri).name
    where, how = (f" in {name}", f", of {name} alone") if len(recordings) > 1 else ("", "")
    return STOPPED.format(found.begin, where, how)


def describe_few_values(diagnosis: Diagnosis) -> str:
    """Say in how few values a gap is that neither sensor nor torque leaves; empty where it is in many, or none is."""
    if not diagnosis.gap_after > EXPLAINED_GAP * diagnosis.noise_floor > 0.0:
        return ""
    held = diagnosis.after
    squares = held.weight * held.residuals**2
    worst = np.argsort(-squares)
    few = int(np.searchsorted(np.cumsum(squares[worst]), MOST * squares.sum())) + 1
    if few > WILD_TIME * len(squares):
        return ""
    time = np.concatenate([data.time[data.last] for data in held.intervals])[held.counted]
    names = [f" of {one.uri.rsplit('/', 1)[-1]}" if len(held.recordings) > 1 else "" for one in held.recordings]
    run = np.repeat(np.arange(len(held.intervals)), [int(marks.sum()) for marks in held.scored])
    where = " and ".join(f"{time[k]:.4g} s{names[run[k]]}" for k in sorted(worst[: min(few, NAMED)]))
    left = float(np.sqrt(squares[worst[few:]].sum() / held.weight[worst[few:]].sum()))
    return FEW.format(few, len(squares), where + (", the worst" if few > NAMED else ""), left)


def _describe_breakaway(findings: Sequence[Finding], torque: Disturbance) -> str:
    """Say by how much a motor may hold more than it seems beside a random torque; empty where its error covers that.

    It breaks away at that torque's peaks: simulated, 2.7 and 4.7 standard deviations of it below the true voltage.
    """
    peaks = PEAKS * torque.rms_voltage
    errors = [one.parameters[BREAKAWAY][1] for one in findings if BREAKAWAY in one.parameters]
    if not errors or not peaks > errors[0]:
        return ""
    return f" The motor breaks away at the peaks of that: {BREAKAWAY} may be larger by {peaks:.2g} V or so."
