"""Answer one sample: which speed the law goes by, feed-forward, PI, and no jump where a setting has changed.

With an observer the law goes by the speed at the instant at which its voltage will act: one sample later, and the
model's delay. Its load estimate is part of the feed-forward where that is on, and is then what removes a lasting error:
the integral would do the same work twice and overshoot, so it leaks away with the time constant kp/ki instead. Only
while the motor stands, where no load can be told, the integral does its work until it breaks loose.
"""

from __future__ import annotations

from math import exp, inf, isfinite, isnan, nan
from typing import TYPE_CHECKING

from motor_control.controller import pi
from motor_control.controller import voltage_range as span
from motor_control.controller.faults import detection
from motor_control.controller.faults.evidence import FULL, Seen
from motor_control.controller.leftover import forget, gains_to_rest, reduce_creeping, runs_on
from motor_control.controller.motion import Motion, follow_motion
from motor_control.controller.output import RUNNING, STOPPED, Output, halt
from motor_control.controller.reference import position_law
from motor_control.controller.reference.demand import Demand, Kind
from motor_control.controller.reference.ramp import Target, approach, round_to_rest
from motor_control.controller.run import Config, Run, begin
from motor_control.controller.timing.sample_rate import explain_lowering, lower_gains
from motor_control.controller.timing.timekeeping import MARGIN, limit_held
from motor_model.frozen_record import replace
from motor_model.sample import Sample

if TYPE_CHECKING:  # they compile; who has no model does not wait for that
    from motor_control.controller.observer import Estimate
    from motor_control.controller.observer import State as Watched

BRAKING = "0 V until the motor turns slower than {:.3g} rad/s: with a single channel a brake would lose the direction."
IGNORED = "The plant's output is off: it applies 0 V where {:.2g} V were asked for. Call motor/enable with data: true."
NOT_FINITE = "The observer's speed is {}: look at the samples and the model; it begins anew."
IGNORED_TIME, IGNORED_STEP = 0.05, 0.02  # [s]; at most as much a sample, so it takes three
IGNORED_SHARE = 0.02  # of the voltage limit: a smaller duty may well be rounded to none
REVERSAL_SHARE = 0.06  # of the top speed: from there the paper's motor stops within a slot, an edge or two show it
REVERSAL_EDGES = 150.0  # [edges/s], where the top speed is not known


def step(config: Config, run: Run, sample: Sample, demand: Demand, pauses: bool = False) -> tuple[Output, Run]:
    """Answer a sample, towards what is asked for. pauses: 0 V will be sent all the same.

    Where the settings have changed since the last sample, the integral takes up what would make the voltage jump, as
    far as its own bound lets it.
    """
    if run.config is config:
        return _apply_law(config, run, sample, demand, hold=pauses or run.paused)
    before, _ = _apply_law(run.config, run, sample, demand)
    run = replace(run, config=config, watched=_hand_over(run, config, sample))
    terms = _apply_law(config, run, sample, demand, hold=True)[0].terms
    jump = terms.proportional + terms.integral + terms.feedforward - before.terms.voltage
    if isfinite(jump):
        run = replace(run, law=pi.State(run.law.integral - jump))
    return _apply_law(config, run, sample, demand, hold=True)


def reversal_speed_of(config: Config, motion: Motion) -> float:
    """Find the speed [rad/s] below which a single channel may be braked: as set, or by top speed, or by edges."""
    if config.reversal_speed > 0.0:
        return config.reversal_speed
    by_edges = REVERSAL_EDGES * config.faults.slot if config.faults.slot > 0.0 else inf
    if config.faults.fastest < inf:
        return REVERSAL_SHARE * config.faults.fastest
    return min(by_edges, REVERSAL_SHARE * motion.fastest(config.voltage_limit))


def _hand_over(run: Run, config: Config, sample: Sample) -> Watched | None:
    """Hand the observer's state over to new settings."""
    if config.observer is None:
        return None
    if run.watched is None:
        return config.observer.begin(sample, sample.speed)
    same = run.config.observer is not None and run.config.observer == config.observer
    return run.watched if same else config.observer.adopt(run.watched)


def _apply_law(config: Config, run: Run, sample: Sample, demand: Demand, hold: bool = False) -> tuple[Output, Run]:
    """Apply the law under one configuration; its time step is the plant's. hold: the integral stays."""
    dt = (sample.sample_time - run.sample_time) * 1e-9
    seen: Estimate | None = None
    watched = run.watched
    if config.observer is not None and watched is not None:
        seen, watched = config.observer.update(watched, sample)
    speed = sample.speed if seen is None else seen.speed
    if not isfinite(speed):
        return halt(STOPPED, NOT_FINITE.format(speed), run.reference, speed), begin(config, sample, run.motion)
    aim, place = _aim(config, run, sample, demand, speed, dt)
    target = _approach(config, run, aim.speed, demand.kind, dt)
    ignored = _count_ignored(config, run, sample, dt)
    motion = follow_motion(run.motion, sample, config.faults.slot, dt, config.voltage_limit, run.faults.periods.regular)
    allowed = _allow(config, run, aim.speed, target, speed, motion)
    known = config.single_channel or seen is not None
    rests = known and target.reference == 0.0 and (run.rests or speed == 0.0)
    if rests:
        allowed = span.limit_at_rest(allowed, 0.0 if config.single_channel else span.AT_REST * config.voltage_limit)
    run = reduce_creeping(run, sample, target.reference)
    step_time = 0.0 if hold or ignored > IGNORED_TIME else dt
    gains = lower_gains(config.gains, config.faults, run.motion.most, config.voltage_limit, config.sample_period)
    note = config.note if gains is config.gains else explain_lowering(gains, config.faults, config.sample_period)
    if demand.kind is Kind.VOLTAGE or aim.rests:
        terms, law = pi.apply_voltage(0.0 if aim.rests else demand.value, allowed.low, allowed.high), pi.State()
    else:
        terms, law = _compute_terms(config, gains, run, seen, target, speed, step_time, allowed)
    sigma, innovation = (nan, nan) if seen is None else (seen.sigma, seen.innovation)
    plugs = terms.saturated and terms.voltage * speed < 0.0 and abs(terms.voltage) < FULL * config.voltage_limit
    limit = config.voltage_limit
    look = Seen(
        sample, speed, motion, target.reference, dt, limit, innovation, run.rhythm, run.asked, plugs, bool(run.caution)
    )
    fault, trouble = detection.find_fault(config.faults, run.faults, look)
    after = Run(
        config,
        sample.sample_time,
        speed if isnan(target.reference) else target.reference,
        law,
        motion,
        allowed.reversing,
        watched,
        asked=terms.voltage,
        ignored=ignored,
        faults=trouble,
        place=place,
        rests=rests,
    )
    reason = (not aim.note and trouble.warning) or _explain(config, run, after, allowed, terms) or aim.note or note
    warning = ignored > IGNORED_TIME or bool(note or aim.note or trouble.warning)
    return Output(RUNNING, reason, target.reference, speed, terms, sigma, innovation, warning, fault), after


def _aim(
    config: Config, run: Run, sample: Sample, demand: Demand, speed: float, dt: float
) -> tuple[position_law.Aim, position_law.State | None]:
    """Find the speed [rad/s] that is wanted: as asked for, none for a voltage, or by the angle that is missing."""
    wanted = demand.value
    if demand.kind is Kind.SPEED:
        wanted = round_to_rest(wanted, config.faults.slot)
    if demand.kind is not Kind.POSITION or config.position is None:
        return position_law.Aim(wanted if demand.kind is Kind.SPEED else nan), position_law.leave(run.place, dt)
    place = run.place or position_law.begin(config.position, wanted)
    return position_law.approach(config.position, place, wanted, sample.edge_count, 0.0 in (speed, sample.speed), dt)


def _approach(config: Config, run: Run, wanted: float, kind: Kind, dt: float) -> Target:
    """Approach a speed [rad/s] within the rate limit; under a voltage there is none."""
    if kind is Kind.VOLTAGE:
        return Target(nan, 0.0)
    since = config.sample_period if run.begins else dt
    return approach(wanted, run.reference, config.reference_rate_limit, since, config.gentle)


def _count_ignored(config: Config, run: Run, sample: Sample, dt: float) -> float:
    """Count the time [s] for which the plant has applied nothing of what was asked."""
    asked_much = abs(run.asked) > IGNORED_SHARE * config.voltage_limit
    return run.ignored + min(dt, IGNORED_STEP) if sample.voltage == 0.0 and asked_much else 0.0


def _explain(config: Config, before: Run, after: Run, allowed: span.Span, terms: pi.Terms) -> str:
    """Explain what keeps the motor from what is asked for, as a sentence; "" where nothing does."""
    if after.ignored > IGNORED_TIME:
        return IGNORED.format(before.asked)
    if allowed.braking:
        return BRAKING.format(reversal_speed_of(config, after.motion))
    kept = terms.saturated and 0.0 < abs(terms.voltage) < FULL * config.voltage_limit
    return before.caution if kept and abs(terms.error) > MARGIN * abs(after.reference) else ""


def _allow(config: Config, run: Run, wanted: float, target: Target, speed: float, motion: Motion) -> span.Span:
    """Find the voltages that are allowed, on the way to a speed [rad/s]."""
    limit, slow = config.voltage_limit, reversal_speed_of(config, motion)
    if not config.single_channel or isnan(target.reference):
        allowed = span.both_ways(limit)
    elif config.observer is not None:
        forward = config.feedforward.voltage(target.reference, target.slope, 0.0) if config.feedforward else 0.0
        allowed = span.known(target.reference, speed, forward, limit, slow)
    else:
        allowed = span.toward(target.reference, speed, limit, slow, run.reversing)
    if run.caution and not isnan(target.reference):
        allowed = limit_held(allowed, motion, wanted, target.reference, speed)
    if config.plug_limit >= 2.0:
        return allowed
    learnt = limit / motion.fastest(limit)  # 0: nothing is learnt yet
    back_emf = span.back_emf_of(speed, config.faults.kv or learnt, span.GIVE_UP * slow)
    return span.limit_plugging(allowed, back_emf, config.plug_limit * limit)


def _compute_terms(
    config: Config,
    gains: pi.Config,
    run: Run,
    seen: Estimate | None,
    target: Target,
    speed: float,
    dt: float,
    allowed: span.Span,
) -> tuple[pi.Terms, pi.State]:
    """Compute the terms at a speed [rad/s], over a time step [s], with gains that the sample period bears."""
    reference = target.reference
    if seen is not None and reference == 0.0 and speed == 0.0:  # it stands, and shall
        return pi.Terms(0.0, 0.0, 0.0, 0.0, 0.0, False), pi.State()
    law, forward, leaks = run.law, 0.0, False
    if config.single_channel and seen is None and speed == 0.0:  # what held the other direction is of no use from here
        law = pi.State(min(max(law.integral, allowed.low), allowed.high))
    law = forget(gains, law, dt, runs_on(config, run.motion, law, reference, reference - speed))
    if config.feedforward is not None:
        forward = config.feedforward.voltage(reference, target.slope, 0.0 if seen is None else seen.load)
        if seen is not None and speed != 0.0:
            leak = gains.ki / gains.kp if gains.kp > 0.0 else gains.ki
            law, leaks = pi.State(law.integral * exp(-dt * min(leak, 1e6))), True
            gains = config.resting if gains is config.gains else pi.Config(gains.kp, 0.0, gains.limit)
    if not leaks:  # else it takes back by itself
        gains = gains_to_rest(gains, law, reference, reference - speed)
    return pi.update(gains, law, reference - speed, forward, dt, allowed.low, allowed.high)
