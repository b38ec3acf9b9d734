"""Say in the log what has changed: one line a change of state, none that repeats with every sample."""

import re
from dataclasses import dataclass, replace
from math import inf, isfinite, isnan

from motor_control.controller.output import DISABLED, NO_SAMPLES, RUNNING, Output
from motor_control.controller.run import Config

SATURATED_TIME = 1.0  # [s] of all the voltage, and still slower than the reference: that is no transient
QUIET = 2.0  # [s] in which the same line is not said again, whatever its numbers
STREAM = 0.5  # [s] the same for references: a joystick sends many
SLOWER = 0.95  # of the reference
# From all the voltage to none, or back, so many times within so long [s] at one reference: no load does that. Measured
# at half the top speed, without a model: in 0.1 to 0.3 s of motors of 600 rad/s and 20 and 50 ms with the gains of one
# of 174, at 100 and 200 Hz, whose speed swings by up to its half; none of 6, 30 and 174 rad/s at 50 Hz to 1 kHz.
SWINGS, SWINGING_TIME = 8, 2.0
ALL, NONE = 0.98, 0.02  # of the voltage limit
SWINGING = (
    "The voltage swings between all and nothing, {} times in {:.2g} s at {:.4g} rad/s: kp {:.4g} and ki {:.4g} are too "
    "much for this motor. Lower them, or set `model`: `ros2 run motor_control tune` proposes gains."
)
HOW_TO_LET_GO = "To let go of the motor call motor/release; 0 rad/s stops it."
NUMBER = re.compile(r"-?\d+(\.\d+)?(e[-+]?\d+)?|\bnan\b|\binf\b")


@dataclass(frozen=True, slots=True)
class Line:
    """One line of the log."""

    severe: bool  # a warning
    text: str


@dataclass(frozen=True, slots=True)
class Told:
    """What has been said so far; times are [s]."""

    state: str = ""
    subject: str = ""  # the reason without its numbers
    reason: str = ""
    wanted: float | None = None  # [rad/s] the reference
    full_since: float | None = None  # all the voltage, and slower than the reference
    full_said: bool = False
    at_limit: bool = False  # the voltage was all there is, latest, and not none
    swings: tuple[float, ...] = ()  # when it went from all to none, or back
    swings_said: bool = False  # at this reference
    latest: tuple[tuple[str, float], ...] = ()  # lines of the last seconds


def describe_start(config: Config) -> str:
    """Describe how the controller is set up."""
    gains = config.gains
    source = "observer" if config.observer is not None else "measured"
    return (
        f"Speed controller: kp {gains.kp:.4g} V/(rad/s), ki {gains.ki:.4g} V/rad, speed source {source}, feed-forward "
        f"{'on' if config.feedforward is not None else 'off'}, at most {config.voltage_limit:.4g} V. Waiting for a "
        "reference on motor/reference."
    )


def announce(told: Told, output: Output, wanted: float | None, config: Config, now: float) -> tuple[list[Line], Told]:
    """Find what is new in an output; wanted: the reference [rad/s] as it was sent; now [s] is a monotonic clock."""
    lines: list[Line] = []
    if wanted is not None and wanted != told.wanted and not isnan(wanted):
        first = told.wanted is None
        lines.append(Line(False, f"Reference {wanted:.4g} rad/s." + (f" {HOW_TO_LET_GO}" if first else "")))
    if wanted != told.wanted:
        told = replace(told, swings=(), swings_said=False)
    told = replace(told, wanted=wanted)
    if (output.state, output.reason) != (told.state, told.reason):
        subject = NUMBER.sub("#", output.reason)
        if (output.state, subject) != (told.state, told.subject):
            lines += _describe_change(told, output)
        told = replace(told, state=output.state, reason=output.reason, subject=subject)
    full, told = _watch_saturation(told, output, wanted, config, now)
    swinging, told = _watch_swings(told, output, config, now)
    return _drop_repeated(told, lines + full + swinging, now)


def _describe_change(told: Told, output: Output) -> list[Line]:
    """Describe a change of state or reason."""
    if output.reason:
        # What kept a motor back at the start was not said, and its end is no news: that it waits for a reference, the
        # first line of all says. But that samples come is.
        waits = output.state == DISABLED and not told.latest and told.state != NO_SAMPLES
        news = output.warning or (told.state and not waits)
        return [Line(output.state != DISABLED or output.warning, output.reason)] if news else []
    if output.state == RUNNING and told.state in ("", DISABLED):
        return []  # the reference has been said
    return [Line(False, "Running again." if told.state != RUNNING else "Running without restriction.")]


def _watch_saturation(
    told: Told, output: Output, wanted: float | None, config: Config, now: float
) -> tuple[list[Line], Told]:
    """Watch for a reference that all the voltage does not reach."""
    terms, limit = output.terms, config.voltage_limit
    full = output.state == RUNNING and terms.saturated and abs(terms.voltage) >= ALL * limit > 0.0
    if not full or wanted is None or abs(output.speed) > SLOWER * abs(wanted):
        return [], replace(told, full_since=None, full_said=told.full_said and output.state == RUNNING and full)
    since = now if told.full_since is None else told.full_since
    if told.full_said or now - since < SATURATED_TIME:
        return [], replace(told, full_since=since)
    top = top_speed_of(config)
    what = (
        f"The motor's top speed at {limit:.3g} V is {top:.3g} rad/s by its model"
        if isfinite(top)
        else (f"The motor turns at {abs(output.speed):.3g} rad/s with all the {limit:.3g} V it may get")
    )
    text = f"Saturated: {wanted:.4g} rad/s are not reached. {what}: ask for less, or raise voltage_limit."
    return [Line(True, text)], replace(told, full_since=since, full_said=True)


def _watch_swings(told: Told, output: Output, config: Config, now: float) -> tuple[list[Line], Told]:
    """Watch for a voltage that swings between all and none at one reference: gains that are of another motor."""
    wanted, limit, voltage = told.wanted, config.voltage_limit, output.terms.voltage
    if output.state != RUNNING or not wanted or isnan(wanted):
        return [], replace(told, swings=())
    share = voltage / limit * (1.0 if wanted > 0.0 else -1.0) if limit > 0.0 else 0.0
    if (share < ALL) if not told.at_limit else (share > NONE):
        return [], told
    swings = (*(at for at in told.swings if now - at < SWINGING_TIME), now)
    told = replace(told, at_limit=not told.at_limit, swings=swings)
    if told.swings_said or len(swings) < SWINGS:
        return [], told
    gains = config.gains
    text = SWINGING.format(len(swings), now - swings[0], wanted, gains.kp, gains.ki)
    return [Line(True, text)], replace(told, swings_said=True)


def top_speed_of(config: Config) -> float:
    """Compute the speed [rad/s] that the model reaches with all the voltage; infinite without a model."""
    faults = config.faults
    return (config.voltage_limit - faults.friction) / faults.kv if faults.kv > 0.0 else inf


def _drop_repeated(told: Told, lines: list[Line], now: float) -> tuple[list[Line], Told]:
    """Drop lines that were said a moment ago, whatever their numbers."""
    if not lines:
        return lines, told
    recent = {subject: at for subject, at in told.latest if now - at < QUIET}
    new = []
    for line in lines:
        subject = NUMBER.sub("#", line.text)
        if now - recent.get(subject, -inf) >= (STREAM if subject.startswith("Reference") else QUIET):
            new.append(line)
            recent[subject] = now
    return new, replace(told, latest=tuple(recent.items()))
