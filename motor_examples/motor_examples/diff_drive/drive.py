"""Decide what both wheels shall do: the wanted velocity, 0, or nothing. No clock; `now` is a monotonic one.

Whatever is in doubt, the robot stands:

    cmd_vel is older than its timeout    slow down to 0 within the limits, then let go of both motors
    cmd_vel is not a number              the same
    cmd_vel has an old stamp             the same
    this drive stood still for 1 s       the same for what comes in the next 3.5 s: it may have been sent meanwhile; and
                                         0 for both at once: what was obeyed before does not go on by itself
    one wheel is in trouble              0 for both at once, then let go; a robot on one wheel turns in circles
    nobody knows who controls a wheel,   the same: two do, or one that does not say how long it would go on by itself

While it moves, the wheels are kept to what they should have turned by now: `travel_gain` times what a wheel is behind
is added to its reference. So what a start or a stop has left, the next motion makes up for, and the robot goes straight
although its motors differ. At rest nothing is added: friction would hold a wheel short of a slot's way, and let go.
A velocity counts from when it comes, not from the next step: 20 ms at 45°/s are nearly a degree.

After a trouble, velocities have to begin again, each sender's for themselves (`motor_model.streams`), with 0 or after a
silence as long as the timeout, and long beside the time between them: who went on sending through it has not seen it.
"""

from dataclasses import dataclass, replace
from math import ceil, inf, isfinite

from motor_examples.diff_drive.kinematics import (
    STILL,
    Geometry,
    Limits,
    Twist,
    Wheels,
    approach_twist,
    limit_twist,
    limit_wheels,
    wheel_speeds,
)
from motor_examples.diff_drive.wheel import SILENCE, Wheel, awaits_answer, find_trouble
from motor_model.streams.senders import Message, Senders
from motor_model.streams.sequence import LONGEST

MOST_BEHIND = 1.0  # [rad] that a wheel makes up for: one that slipped or was blocked does not race afterwards
LONGEST_STEP = 0.1  # [s] of the limits' ramp: after a pause of the computer the robot does not jump
LONGEST_PAUSE = 1.0  # [s] without a step, after which a robot that goes on by itself is a surprise
STANDING = 0.3  # [s] at 0 rad/s and reported as such, before the motors are let go
PATIENCE = 2.0  # [s] at 0 rad/s after which they are let go whatever is reported
TOLD = 0.5  # [s] for which it is said that a velocity was not obeyed
APART = 1e3  # [m] of a rate of turn beside a velocity, in the one number by which two velocities are told apart

ASKING = "Both controllers are asked how long they would go on without this drive; until they answer, it waits."
IDLE = "No velocity on cmd_vel; both motors are left alone."
DRIVING = "Driving."
STALE = "The last cmd_vel is older than cmd_vel_timeout ({:g} s)."
OLD = (
    "The stamp of cmd_vel is older than cmd_vel_timeout ({:g} s), or ahead by more: send it sooner, or set both "
    "computers' clocks."
)
PLAYED = (
    "A recording of cmd_vel is played ({}), and nothing is obeyed until that has ended. To drive a robot by a "
    "recording, use ros2 run motor_identification play BAG --topics cmd_vel."
)
STOOD = "The drive stood still for {:.1f} s (Ctrl-Z, a suspended or overloaded computer)."
NOT_A_NUMBER = "cmd_vel is not a number: send a finite velocity."
GOES_ON = (
    "A cmd_vel that went on through a stop is not obeyed until its sender begins again, with 0 or after a silence of "
    "{:g} s; another's 0 lets it not go on."
)
FIXED = (
    "wheel_radius and wheel_separation stay as they are while the robot moves or is asked to: its wheels would jump to "
    "other speeds. Send a cmd_vel of 0, and set them when both wheels stand."
)
BEGIN = "{} Both wheels stop. Then send a cmd_vel of 0, or pause for {:g} s, before the next velocity."


@dataclass(frozen=True, slots=True)
class Config:
    """How to drive."""

    geometry: Geometry
    limits: Limits = Limits()
    cmd_vel_timeout: float = 0.5  # [s] 0: a velocity holds until the next
    travel_gain: float = 2.0  # [1/s] 0: wheels that are behind stay behind


@dataclass(frozen=True, slots=True)
class State:
    """What is remembered; times are [s]."""

    command: Twist | None = None  # the latest velocity, as long as it is obeyed
    commanded: float | None = None  # when it came
    twist: Twist = STILL  # behind the limits
    stepped: float | None = None  # when that was
    since: float | None = None  # since when both motors have been given references; None: they are left alone
    still_since: float | None = None  # since when those have been 0
    behind: Wheels = Wheels(0.0, 0.0)  # [rad] that each wheel still has to turn
    angles: Wheels = Wheels(0.0, 0.0)  # [rad] of both at the last step
    reason: str = IDLE
    trouble: str = ""  # why velocities have to begin again; empty: they need not
    senders: Senders = Senders(longest=LONGEST)  # of velocities, obeyed or not; keys are pressed at any times
    refused: str = ""  # why a velocity was not obeyed, where there is no trouble any more
    refused_at: float = 0.0  # when that was


@dataclass(frozen=True, slots=True)
class Decision:
    """What both motors shall be told."""

    references: Wheels | None  # None: nothing
    release: bool = False  # let go of both
    reason: str = ""
    healthy: bool = True


def take_command(
    config: Config, state: State, twist: Twist, now: float, age: float = 0.0, number: int | None = None
) -> State:
    """Take a velocity that comes at `now` [s]; one that is not a number, or old by its stamp (age [s]), is a stop.

    number: of its publisher's messages; None: not counted.
    """
    paused = inf if state.commanded is None else now - state.commanded
    state = _hear(_advance(config, _notice_pause(state, now), now), twist, now, number)
    if not (isfinite(twist.linear) and isfinite(twist.angular)):
        return replace(_end(state, NOT_A_NUMBER), commanded=now)
    if not abs(age) <= (config.cmd_vel_timeout or inf):
        return replace(_end(state, OLD.format(config.cmd_vel_timeout)), commanded=now)
    sender = state.senders.latest
    goes_on = state.senders.ended > 0 and state.senders.bars(state.command is not None)
    if state.trouble:
        known = sender.sequence.latest  # nan of its first message
        silence = known if isfinite(known) else inf if number == 1 else paused
        goes_on = goes_on or not (silence > config.cmd_vel_timeout > 0.0 or twist == STILL)
        if goes_on:
            return replace(state, commanded=now)
    elif goes_on:
        return replace(state, refused=GOES_ON.format(round(sender.sequence.needed, 1)), refused_at=now)
    return replace(state, command=twist, commanded=now, trouble="", refused="", senders=state.senders.obey())


def refuse_command(state: State, why: str, now: float, twist: Twist | None = None, number: int | None = None) -> State:
    """Stop for a velocity that comes at `now` [s] and cannot be obeyed, as a sentence says; None: for any that may."""
    state = state if twist is None else _hear(state, twist, now, number)
    return replace(_end(state, why), commanded=now)


def _find_pause(config: Config, state: State) -> float:
    """Find for how long [s] whoever sent last has to pause, so that his next velocity begins."""
    known = state.senders.known
    needed = max(known[-1].sequence.needed if known else 0.0, config.cmd_vel_timeout)
    return ceil(10.0 * needed) / 10.0


def _hear(state: State, twist: Twist, now: float, number: int | None) -> State:
    """Hear a velocity, whether or not it is obeyed."""
    message = Message("cmd_vel", number, twist.linear + APART * twist.angular, twist == STILL, now)
    return replace(state, senders=state.senders.hear(message, 0.0, -inf))


def _end(state: State, trouble: str) -> State:
    """Obey nothing any more of what was asked for."""
    return replace(state, command=None, trouble=trouble, senders=state.senders.end())


def step(config: Config, state: State, wheels: tuple[Wheel, Wheel], now: float) -> tuple[Decision, State]:
    """Decide what both motors are told at `now` [s]."""
    state = _notice_pause(state, now)
    driven = 0.0 if state.since is None else now - state.since
    trouble = next(filter(None, (find_trouble(wheel, now, driven) for wheel in wheels)), "")
    if trouble:
        state = replace(_end(state, trouble), twist=STILL)
    state = _follow_travel(_advance(config, _drop_stale(config, state, now), now), wheels)
    refused = state.refused if now - state.refused_at <= TOLD else ""
    healthy = not (state.trouble or refused)
    reason = BEGIN.format(state.trouble, _find_pause(config, state)) if state.trouble else refused or state.reason
    if state.command is None and state.since is None:
        return Decision(None, False, reason, healthy), replace(state, twist=STILL, behind=Wheels(0.0, 0.0))
    if state.since is None and any(map(awaits_answer, wheels)):
        return Decision(None, False, ASKING, healthy), replace(state, twist=STILL, behind=Wheels(0.0, 0.0))
    still_since = (now if state.still_since is None else state.still_since) if state.twist == STILL else None
    state = replace(state, since=now if state.since is None else state.since, still_since=still_since)
    if state.command is None and _stands(state, wheels, now):
        return Decision(None, True, reason, healthy), replace(state, since=None, still_since=None)
    reason = DRIVING if state.command is not None and not refused else reason
    return Decision(_references(config, state), False, reason, healthy), state


def refuse_geometry(config: Config, state: State, wheels: tuple[Wheel, Wheel], wanted: Geometry) -> str:
    """Tell why the robot may not be taken for another one now, as a sentence; "" where it may."""
    asked = state.command not in (None, STILL) or state.twist != STILL
    moves = asked or any(wheel.speed != 0.0 for wheel in wheels)
    return FIXED if moves and wanted != config.geometry else ""


def _notice_pause(state: State, now: float) -> State:
    """Stop where the robot moved when this drive last ran, and that is long ago."""
    paused = 0.0 if state.stepped is None else now - state.stepped
    if paused <= LONGEST_PAUSE or (state.command is None and state.twist == STILL):
        return state
    return replace(_end(state, STOOD.format(paused)), twist=STILL, stepped=now)


def _advance(config: Config, state: State, now: float) -> State:
    """Approach the velocity in force up to `now` [s]; what the wheels should have turned meanwhile they are behind."""
    dt = 0.0 if state.stepped is None else min(max(now - state.stepped, 0.0), LONGEST_STEP)
    command = STILL if state.command is None else limit_twist(config.geometry, config.limits, state.command)
    speeds, twist = wheel_speeds(config.geometry, state.twist), approach_twist(config.limits, state.twist, command, dt)
    behind = Wheels(*(b + w * dt for b, w in zip(state.behind, speeds, strict=True)))
    return replace(state, stepped=now, twist=twist, behind=behind)


def _follow_travel(state: State, wheels: tuple[Wheel, Wheel]) -> State:
    """Follow what each wheel has turned of what it should have."""
    angles = Wheels(wheels[0].angle, wheels[1].angle)
    rows = zip(state.behind, angles, state.angles, strict=True)
    behind = Wheels(*(min(max(b - (a - was), -MOST_BEHIND), MOST_BEHIND) for b, a, was in rows))
    return replace(state, behind=behind, angles=angles)


def _references(config: Config, state: State) -> Wheels:
    """Compute the references [rad/s] of both wheels; one that makes up for its way keeps to its limit, too."""
    wanted = wheel_speeds(config.geometry, state.twist)
    if state.twist == STILL:
        return wanted
    made_up = (w + config.travel_gain * b for w, b in zip(wanted, state.behind, strict=True))
    return limit_wheels(config.limits, Wheels(*made_up))


def _drop_stale(config: Config, state: State, now: float) -> State:
    """Drop a velocity that is too old."""
    if state.command is None or state.commanded is None or not config.cmd_vel_timeout:
        return state
    if now - state.commanded <= config.cmd_vel_timeout:
        return replace(state, reason=IDLE)
    return replace(state, command=None, reason=STALE.format(config.cmd_vel_timeout))


def _stands(state: State, wheels: tuple[Wheel, Wheel], now: float) -> bool:
    """Whether both wheels stand after their 0 rad/s, or had their time to; one that is not heard has nothing to say."""
    still = 0.0 if state.still_since is None else now - state.still_since
    seen = all(wheel.sample is not None and wheel.speed == 0.0 for wheel in wheels if now - wheel.heard <= SILENCE)
    return still > PATIENCE or (seen and still > STANDING)
