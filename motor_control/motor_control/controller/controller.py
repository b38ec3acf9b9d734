"""Decide whether the motor may run, and answer every sample: a voltage with everything that led to it. No clock.

Time between samples is the plant's own (`sample_time`); `now`, a monotonic clock of the caller's, tells how old a
sample is and whether samples still come at all. Whatever is wrong, the answer is 0 V with a sentence that says why.

A reference is obeyed from when it comes until something ends it: a stop, a reset, `release`, or what
`reference/ending.py` lists. Then the motor waits for a fresh one: those that go on coming have to begin again.
"""

from math import nan

from motor_control.controller import pi
from motor_control.controller import speed_law as law
from motor_control.controller.interruptions import count_interruption
from motor_control.controller.obstacles import explain_stop, find_mistake, find_obstacle, is_finite
from motor_control.controller.output import DISABLED, NO_SAMPLES, RUNNING, STOPPED, Output, halt
from motor_control.controller.plant_watch import watch_plant
from motor_control.controller.reference import position_law
from motor_control.controller.reference.demand import Demand, Kind
from motor_control.controller.reference.ending import AWAY, OFF, drop_old_reference
from motor_control.controller.run import Config, Run, begin
from motor_control.controller.state import (
    NAMES,
    State,
    command_joint,
    doubt,
    drop,
    meet_other_plant,
    refer,
    release,
    reset,
    stop,
)
from motor_control.controller.timing.latency import follow_echo, track_latency
from motor_control.controller.timing.timekeeping import (
    PERIODS,
    Timekeeping,
    count_lapse,
    find_holding_voltage,
    find_longest_hold,
    keep_time,
    regain,
)
from motor_model.frozen_record import replace
from motor_model.sample import Sample
from motor_model.sensing.mains_rhythm import follow_rhythm

__all__ = [
    "Config",
    "State",
    "command_joint",
    "doubt",
    "drop",
    "meet_other_plant",
    "refer",
    "release",
    "reset",
    "stop",
    "update",
    "watch",
]

REPEAT_SILENCE = 0.2  # [s] how often it is said again that no samples come
EARLIER = 2.0  # sample periods that an answer takes beside what a sample may: from one latch to the next, and back
TOLD = 0.5  # [s] for which it is said that a demand was not taken

STALE = "The sample is {:.0f} ms old and latency_limit is {:.0f} ms: give the controller more processor time."
NEVER_A_SAMPLE = "No sample has come on motor/speed yet: start motor_sim or motor_driver."
SILENCE = "No sample on motor/speed for {:.1f} s: see whether motor_sim or motor_driver still runs."
TWO_PLANTS = f"Two plants publish motor/speed {NAMES}: end one of them."


def update(config: Config, state: State, sample: Sample, reference: float | None, now: float) -> tuple[Output, State]:
    """Answer one sample; reference [rad/s]: one that has come since the last sample; now [s] is a monotonic clock."""
    age, latency = track_latency(state.latency, sample.sample_time, now)
    plant = watch_plant(state.plant, sample, now, config.sample_period)
    timing = _keep_time(config, state, sample, age, now)
    state = replace(state, rhythm=follow_rhythm(state.rhythm, sample), timing=timing)
    if plant.two and not state.latched:
        state = stop(state, TWO_PLANTS, now)
    state = drop_old_reference(config, state, plant, now)
    if reference is not None:
        state = refer(state, reference, now)
    output, after = _answer(config, state, sample, age, now)
    ours = after.demand is not None or bool(after.latched) and state.drives
    drives = state.drives or after.demand is not None
    begins = ours and (not state.drives or state.silent is not None) or _is_unheard(state.run, after, now)
    if after.refused and now - after.refused_at <= TOLD and (output.state == DISABLED or not output.reason):
        output = replace(output, reason=after.refused, warning=True)
    held = output.state == STOPPED and after.demand is not None
    since, why = (now if state.held is None else state.held, output.reason) if held else (None, "")
    after = replace(after, arrival=now, silent=None, drives=ours, plant=plant, latency=latency)
    after = replace(after, held=since, held_by=why)
    return replace(output, latency=age, drives=drives, begins=begins), after


def watch(config: Config, state: State, now: float) -> tuple[Output | None, State]:
    """Between samples: an output to publish once none has come for `sample_timeout`, again every 0.2 s; else None."""
    silence = now - (state.since if state.arrival is None else state.arrival)
    if silence <= config.sample_timeout or (state.silent is not None and now - state.silent < REPEAT_SILENCE):
        return None, state
    reason = NEVER_A_SAMPLE if state.arrival is None else SILENCE.format(silence)
    output = replace(halt(NO_SAMPLES, reason, nan, nan), drives=state.drives and state.silent is None)
    return output, replace(state, run=None, silent=now)


def _keep_time(config: Config, state: State, sample: Sample, age: float, now: float) -> Timekeeping:
    """Follow how the controller keeps its time, with a sample of an age [s] that is answered at `now` [s]."""
    if state.arrival is None or state.plant is None:
        return state.timing
    gap = max(now - state.arrival, (sample.sample_time - state.plant.sample_time) * 1e-9)
    hold = find_longest_hold(config.gains, config.faults, state.motion, config.latency_limit)
    hold = max(hold, PERIODS * config.sample_period)
    demand, timeout = state.demand, config.sample_timeout
    known = demand is not None and demand.kind is Kind.SPEED and find_holding_voltage(state.motion, demand.value) > 0.0
    late = age if age > config.latency_limit else 0.0
    after = keep_time(state.timing, gap, hold, timeout, late, config.latency_limit if known else 0.0)
    return count_lapse(state.timing, after, gap, timeout) if state.drives and demand is not None else after


def _is_unheard(before: Run | None, after: State, now: float) -> bool:
    """Whether the plant still applies 0 V to a fresh reference: it may not have heard the 0 V that voltages begin with.

    True now and then for as long as the reference is fresh: who has just asked for a motion means it, and who goes on
    asking as before does not know that the plant wants to see 0 V.
    """
    if before is None or after.run is None or now - after.begun > OFF:
        return False
    return before.ignored // law.IGNORED_TIME < after.run.ignored // law.IGNORED_TIME


def _answer(config: Config, state: State, sample: Sample, age: float, now: float) -> tuple[Output, State]:
    """Answer a sample of an age [s], at a time [s], with the reference in force."""
    demand = state.demand
    name, reason = find_obstacle(config, state, sample)
    mistake = find_mistake(config, demand, sample) if name == RUNNING and demand is not None else ""
    if demand is not None and not state.latched:
        passing = mistake or (reason if config.voltage_limit == 0.0 or not is_finite(sample) else "")
        often, interruptions = count_interruption(state.interruptions, passing, now, config.faults.stall_time)
        state = replace(state, interruptions=interruptions)
        if often:
            return _stop_for_good(state, often, nan, sample.speed, now)
    shown = demand.value if demand is not None and demand.kind is Kind.SPEED else nan
    if demand is None or name != RUNNING or (mistake and state.run is None):
        name, reason = (STOPPED, mistake) if mistake else (name, reason)
        return replace(halt(name, reason, shown, sample.speed), warning=bool(state.dropped)), replace(state, run=None)
    waiting = STALE.format(1e3 * age, 1e3 * config.latency_limit) if state.timing.stale else state.timing.waiting
    wanted = Demand(0.0) if mistake else demand
    before = _continue_run(config, state, sample)
    output, run = law.step(config, before, sample, wanted, bool(waiting or mistake or state.timing.old is not None))
    window = config.latency_limit + EARLIER * config.sample_period
    answer = before.sample_time, before.asked
    held_back, echo = follow_echo(before.echo, sample, answer, window, config.voltage_limit)
    run, output = replace(run, echo=echo), replace(output, fault=output.fault or held_back)
    if output.fault:
        state = replace(state, motion=run.motion)
        return _stop_for_good(state, output.fault, output.reference, output.speed, now)
    if output.state != RUNNING:
        return output, replace(state, run=None)
    if mistake:  # the checks go on: it may come and go
        output = halt(STOPPED, mistake, shown, sample.speed)
        run = replace(run, asked=0.0, paused=True, law=pi.State(), reference=sample.speed)
    elif waiting:  # what it says is over; the run goes on with the next one that is in time
        output = halt(STOPPED, waiting, shown, sample.speed)
        run = replace(run, asked=0.0, paused=True)
    timing = regain(state.timing, run.reference, output.speed, config.sample_timeout)
    state = replace(state, motion=run.motion, faults=run.faults, judged=run.sample_time, timing=timing)
    return output, replace(state, run=run, place=run.place)


def _stop_for_good(state: State, fault: str, reference: float, speed: float, now: float) -> tuple[Output, State]:
    """Latch a stop for a fault, and say what ends it."""
    state = stop(state, fault, now)
    return replace(halt(STOPPED, explain_stop(state), reference, speed), fault=fault), state


def _continue_run(config: Config, state: State, sample: Sample) -> Run:
    """Find the run that this sample belongs to, lost samples in between or not; a new one begins at its own speed.

    A new one begins where there was none, and after a gap that the plant's own watchdog does not survive either: what
    the integral knew is of another motion. What its faults have shown so far holds for a while: whoever ends a run
    again and again, with a reference that is no number or samples that do not come, would else blind every check. So
    does that a motor was pushed out of an angle, and how far: to let go of it and to ask again does not make it forget.
    Only its pushes are counted from 0 again.
    """
    run = state.run
    if run is not None and 0 <= sample.sample_time - run.sample_time <= config.sample_timeout * 1e9:
        return replace(run, rhythm=state.rhythm, caution=state.timing.caution)
    just_now = 0 <= sample.sample_time - state.judged <= AWAY * 1e9
    run = begin(config, sample, state.motion, state.faults if just_now else None)
    place = position_law.leave(state.place, 0.0) if just_now else None
    return replace(run, place=place, rhythm=state.rhythm, caution=state.timing.caution)


WAITING = halt(NO_SAMPLES, NEVER_A_SAMPLE, nan, nan)  # what holds before anything has happened
