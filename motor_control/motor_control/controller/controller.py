"""The speed controller: one encoder sample and a reference in; a voltage and everything that led to it out. No clock.

Time between samples is the plant's own (`sample_time`), so a message that comes late changes nothing; `now` only tells
whether samples still come at all. Whatever is wrong, the answer is 0 V with a sentence that says why.
"""

from dataclasses import dataclass, replace
from math import isfinite, nan

from motor_control.controller import pi
from motor_control.controller import speed_law as law
from motor_control.controller.speed_law import Config, Run
from motor_model.sample import Sample

RUNNING, DISABLED, NO_SAMPLES, STOPPED = "running", "disabled", "no_samples", "stopped"
REPEAT_SILENCE = 0.2  # [s] how often it is said again that no samples come

NO_REFERENCE = "No reference yet: publish a speed in rad/s on motor/reference."
BAD_REFERENCE = "The reference is {}: publish a finite speed in rad/s on motor/reference."
BAD_SAMPLE = "A sample on motor/speed says {} = {}: find out what is wrong with the plant."
NEVER_A_SAMPLE = "No sample has come on motor/speed yet: start motor_sim or motor_driver."
SILENCE = "No sample on motor/speed for {:.1f} s: see whether motor_sim or motor_driver still runs."
CALL_RESET = "{} Call motor/reset to go on."


@dataclass(frozen=True, slots=True)
class State:
    """What the controller remembers; the times are [s] on the clock of `now`."""

    since: float = 0.0  # when it began
    arrival: float | None = None  # when the latest sample came
    silent: float | None = None  # when silence was last reported; None while samples come
    run: Run | None = None
    latched: str = ""  # why the motor stays at 0 V until `reset`


@dataclass(frozen=True, slots=True)
class Output:
    """What `ControlState` shows, without its header."""

    state: str
    reason: str
    reference: float  # [rad/s] the one the law used, behind the rate limit; NaN: none
    speed: float  # [rad/s] NaN: none
    terms: pi.Terms
    speed_sigma: float = nan  # [rad/s] NaN: measured, not estimated
    innovation: float = nan  # [rad] angle at the latest edge less the observer's prediction
    warning: bool = False  # somebody should read the reason


def update(config: Config, state: State, sample: Sample, reference: float | None, now: float) -> tuple[Output, State]:
    """Answer one sample; reference [rad/s] is the latest one or None, now [s] is a monotonic clock of the caller's."""
    name, reason = _obstacle(state, sample, reference)
    halted = State(state.since, now, None, None, state.latched)
    if reference is None or name != RUNNING:
        return _halt(name, reason, nan if reference is None else reference, sample.speed), halted
    answer, run = law.step(config, _continued(config, state.run, sample), sample, reference)
    if answer.fault:
        reason = CALL_RESET.format(answer.fault)
        return _halt(STOPPED, reason, answer.reference, answer.speed), stop(halted, answer.fault)
    if not isfinite(answer.speed):
        return _halt(STOPPED, answer.reason, answer.reference, answer.speed), halted
    return _answered(answer), State(state.since, now, None, run, "")


def watch(config: Config, state: State, now: float) -> tuple[Output | None, State]:
    """Between samples: an output to publish once none has come for `sample_timeout`, again every 0.2 s; else None."""
    silence = now - (state.since if state.arrival is None else state.arrival)
    if silence <= config.sample_timeout or (state.silent is not None and now - state.silent < REPEAT_SILENCE):
        return None, state
    reason = NEVER_A_SAMPLE if state.arrival is None else SILENCE.format(silence)
    return _halt(NO_SAMPLES, reason, nan, nan), replace(state, run=None, silent=now)


def stop(state: State, reason: str) -> State:
    """Latch 0 V from the next sample on, until `reset`; `reason` is a sentence."""
    return replace(state, run=None, latched=reason)


def reset(state: State) -> State:
    """Clear the latched stop."""
    return replace(state, latched="")


def _obstacle(state: State, sample: Sample, reference: float | None) -> tuple[str, str]:
    """Why not to run, as state and reason; (running, "") where nothing speaks against it."""
    if state.latched:
        return STOPPED, CALL_RESET.format(state.latched)
    for name, value in (("speed", sample.speed), ("voltage", sample.voltage), ("edge_period", sample.edge_period)):
        if not isfinite(value):
            return STOPPED, BAD_SAMPLE.format(name, value)
    if reference is None:
        return DISABLED, NO_REFERENCE
    if not isfinite(reference - sample.speed):
        return STOPPED, BAD_REFERENCE.format(reference)
    return RUNNING, ""


def _continued(config: Config, run: Run | None, sample: Sample) -> Run:
    """The run that this sample belongs to, lost samples in between or not; a new one begins at its own speed.

    A new one begins where there was none, where the plant has restarted (its clock is behind), and after a gap that the
    plant's own watchdog does not survive either: what the integral knew is of another motion.
    """
    if run is not None and 0 <= sample.sample_time - run.sample_time <= config.sample_timeout * 1e9:
        return run
    return law.begin(config, sample)


def _answered(answer: law.Answer) -> Output:
    """A running motor's output."""
    return Output(
        RUNNING,
        answer.reason,
        answer.reference,
        answer.speed,
        answer.terms,
        answer.speed_sigma,
        answer.innovation,
        answer.warning,
    )


def _halt(name: str, reason: str, reference: float, speed: float) -> Output:
    return Output(name, reason, reference, speed, pi.Terms(reference - speed, 0.0, 0.0, 0.0, 0.0, False))


WAITING = _halt(NO_SAMPLES, NEVER_A_SAMPLE, nan, nan)  # what holds before anything has happened
