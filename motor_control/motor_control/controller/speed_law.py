"""The control law at one sample: which speed it goes by, feed-forward, PI, and no jump where a setting has changed.

With an observer the law goes by the speed at the instant at which its voltage will act: one sample later, and the
model's delay. Its load estimate is part of the feed-forward where that is on, and is then what removes a lasting error:
the integral would do the same work twice and overshoot, so it leaks away with the time constant kp/ki instead. Only
while the motor stands, where no load can be told, the integral does its work until it breaks loose.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import exp, isfinite, nan
from typing import TYPE_CHECKING

from motor_control.checks import at_least
from motor_control.controller import faults, pi
from motor_control.controller import voltage_range as span
from motor_model.sample import Sample

if TYPE_CHECKING:  # they compile; who has no model does not wait for that
    from motor_control.controller.feedforward import FeedForward
    from motor_control.controller.observer import Estimate, Observer
    from motor_control.controller.observer import State as Watched

BRAKING = "0 V until the motor turns slower than {:g} rad/s: with a single channel a brake would lose the direction."
IGNORED = "The plant applies 0 V where {:.2g} V were asked for: call motor/enable with data: true, or see what it says."
NOT_FINITE = "The observer's speed is {}: look at the samples and the model; it begins anew."
IGNORED_TIME, IGNORED_STEP = 0.05, 0.02  # [s]; at most as much a sample, so it takes three
IGNORED_SHARE = 0.02  # of the voltage limit: a smaller duty may well be rounded to none


@dataclass(frozen=True, slots=True)
class Config:
    """How to control.

    Raises:
        MotorError: a value is negative or not finite.
    """

    gains: pi.Config
    voltage_limit: float  # [V]
    sample_timeout: float  # [s] silence after which there is no plant
    reference_rate_limit: float  # [rad/s²] 0: none
    reversal_speed: float  # [rad/s] a single-channel motor faster than this is not pushed against its motion
    single_channel: bool = True  # the encoder does not measure direction
    faults: faults.Config = faults.Config()
    observer: Observer | None = None  # None: the law goes by the reported speed
    feedforward: FeedForward | None = None
    note: str = ""  # what was asked for and cannot be had
    resting: pi.Config = field(init=False, repr=False)  # the gains without the integral's

    def __post_init__(self) -> None:
        at_least(0.0, voltage_limit=self.voltage_limit, sample_timeout=self.sample_timeout)
        at_least(0.0, reference_rate_limit=self.reference_rate_limit, reversal_speed=self.reversal_speed)
        object.__setattr__(self, "resting", replace(self.gains, ki=0.0))


@dataclass(frozen=True, slots=True)
class Run:
    """What is remembered from one sample to the next while running; a run ends with every stop, gap and restart."""

    config: Config
    sample_time: int  # [ns]
    reference: float  # [rad/s] behind the rate limit
    law: pi.State
    reversing: bool = False
    watched: Watched | None = None  # the observer's
    asked: float = 0.0  # [V] the latest answer
    ignored: float = 0.0  # [s] for which the plant has applied nothing of what was asked
    faults: faults.State = faults.State()


@dataclass(frozen=True, slots=True)
class Answer:
    """What the law made of one sample."""

    reference: float  # [rad/s] behind the rate limit
    speed: float  # [rad/s]
    terms: pi.Terms
    reason: str
    fault: str  # why the motor has to stop; "": it may go on
    warning: bool
    speed_sigma: float = nan  # [rad/s] NaN: measured
    innovation: float = nan  # [rad]


def begin(config: Config, sample: Sample) -> Run:
    """A run begins at the motor's own speed."""
    state = faults.State(sample.edge_count)
    watched = config.observer.begin(sample, sample.speed) if config.observer else None
    return Run(config, sample.sample_time, sample.speed, pi.State(), watched=watched, faults=state)


def step(config: Config, run: Run, sample: Sample, wanted: float) -> tuple[Answer, Run]:
    """The answer to a sample, towards a wanted speed [rad/s]; all finite.

    Where the settings have changed since the last sample, the integral takes up what would make the voltage jump, as
    far as its own bound lets it.
    """
    if run.config is config:
        return _law(config, run, sample, wanted)
    before, _ = _law(run.config, run, sample, wanted)
    run = replace(run, config=config, watched=_handed_over(run, config, sample))
    terms = _law(config, run, sample, wanted, hold=True)[0].terms
    jump = terms.proportional + terms.integral + terms.feedforward - before.terms.voltage
    if isfinite(jump):
        run = replace(run, law=pi.State(run.law.integral - jump))
    return _law(config, run, sample, wanted, hold=True)


def _handed_over(run: Run, config: Config, sample: Sample) -> Watched | None:
    """The observer's state under new settings."""
    if config.observer is None:
        return None
    if run.watched is None:
        return config.observer.begin(sample, sample.speed)
    same = run.config.observer is not None and run.config.observer == config.observer
    return run.watched if same else config.observer.adopt(run.watched)


def _law(config: Config, run: Run, sample: Sample, wanted: float, hold: bool = False) -> tuple[Answer, Run]:
    """One step under one configuration; its time step is what passed on the plant's clock. hold: the integral stays."""
    dt = (sample.sample_time - run.sample_time) * 1e-9
    reference, slope = approach(wanted, run.reference, config.reference_rate_limit, dt)
    seen: Estimate | None = None
    watched = run.watched
    if config.observer is not None and watched is not None:
        seen, watched = config.observer.update(watched, sample)
    speed = sample.speed if seen is None else seen.speed
    if not isfinite(speed):
        return Answer(reference, speed, _nothing(reference), NOT_FINITE.format(speed), "", True), begin(config, sample)
    asked_much = abs(run.asked) > IGNORED_SHARE * config.voltage_limit
    ignored = run.ignored + min(dt, IGNORED_STEP) if sample.voltage == 0.0 and asked_much else 0.0
    allowed = _span(config, run, reference, slope, speed)
    step = 0.0 if hold or ignored > IGNORED_TIME else dt
    terms, law = _terms(config, run, seen, (reference, slope, speed, step), allowed)
    fault, trouble = faults.update(config.faults, run.faults, sample, speed, dt, config.voltage_limit)
    reason = BRAKING.format(config.reversal_speed) if allowed.braking else config.note
    if ignored > IGNORED_TIME:
        reason = IGNORED.format(run.asked)
    warning = ignored > IGNORED_TIME or bool(config.note)
    sigma, innovation = (nan, nan) if seen is None else (seen.sigma, seen.innovation)
    answer = Answer(reference, speed, terms, reason, fault, warning, sigma, innovation)
    after = Run(config, sample.sample_time, reference, law, allowed.reversing, watched, terms.voltage, ignored, trouble)
    return answer, after


def _span(config: Config, run: Run, reference: float, slope: float, speed: float) -> span.Span:
    """Both ways where the direction is measured."""
    if not config.single_channel:
        return span.both_ways(config.voltage_limit)
    if config.observer is not None:
        forward = config.feedforward.voltage(reference, slope, 0.0) if config.feedforward else 0.0
        return span.known(reference, speed, forward, config.voltage_limit, config.reversal_speed)
    return span.toward(reference, speed, config.voltage_limit, config.reversal_speed, run.reversing)


def _terms(
    config: Config, run: Run, seen: Estimate | None, now: tuple[float, float, float, float], allowed: span.Span
) -> tuple[pi.Terms, pi.State]:
    """The terms for (reference [rad/s], its slope [rad/s²], speed [rad/s], time step [s])."""
    reference, slope, speed, dt = now
    if seen is not None and reference == 0.0 and speed == 0.0:  # it stands, and shall
        return _nothing(0.0), pi.State()
    law, gains, forward = run.law, config.gains, 0.0
    if config.single_channel and seen is None and speed == 0.0:  # what held the other direction is of no use from here
        law = pi.State(min(max(law.integral, allowed.low), allowed.high))
    if config.feedforward is not None:
        forward = config.feedforward.voltage(reference, slope, 0.0 if seen is None else seen.load)
        if seen is not None and speed != 0.0:
            leak = gains.ki / gains.kp if gains.kp > 0.0 else gains.ki
            law, gains = pi.State(law.integral * exp(-dt * min(leak, 1e6))), config.resting
    return pi.update(gains, law, reference - speed, forward, dt, allowed.low, allowed.high)


def approach(wanted: float, start: float, rate: float, dt: float) -> tuple[float, float]:
    """The reference [rad/s] that the rate limit [rad/s²] lets through, and its slope [rad/s²]; 0 is no limit."""
    if rate == 0.0:
        return wanted, 0.0
    reference = start + min(max(wanted - start, -rate * dt), rate * dt)
    return reference, (reference - start) / dt if dt > 0.0 else 0.0


def _nothing(reference: float) -> pi.Terms:
    return pi.Terms(reference, 0.0, 0.0, 0.0, 0.0, False)
