"""Watch whether the controller keeps its time, and limit what it may ask for while it does not.

The plant holds a voltage until the next one comes, for as long as its `command_timeout`. What holds a speed may be held
for long; but what is right to bring the motor to it, or 0 V for an old sample, carries it past it while the controller
is not scheduled, and the next answer carries it back: a swing as long as the load on the machine. So

    cautious  after an answer that came too late, the voltage stays within `MARGIN` of what held this speed in the last
              steady motion, but for 0 V where the motor is too fast: held for however long, it does not carry the motor
              away. That ends when the controller has kept its time for a while and the motor is back at its speed.
    stale     a sample too old to act on gets 0 V. But where it is known what holds the speed, it gets that until such
              samples have come for as long as one may be old: as a rule they had come just when the controller was held
              up, and the next ones are fresh.
    waiting   a lapse is 0 V for such a sample, or a silence that ends a run, for which the plant gives 0 V. After the
              second one soon after another, the motor gets 0 V until time has been kept; after each further one for
              twice as long.

Too late is what this loop cannot bear: a proportional gain kp around a motor of gain 1/kv and time constant τ does not
overshoot as long as its voltage is held for no longer than τ ln(1 + kv/kp). Both are the model's, or of what was
learnt: kv by the last steady motion, τ by the gains, whose zero is the motor's pole (τ = kp/ki).
"""

from dataclasses import dataclass, replace
from math import copysign, inf, log1p

from motor_control.controller import pi
from motor_control.controller.faults.evidence import Config as FaultConfig
from motor_control.controller.motion import Motion
from motor_control.controller.voltage_range import Span

MARGIN = 0.04  # of the voltage: of a motor with friction that is 4.5 % of its speed, and 5 % is what a loop may be off
NEAR = 0.8, 1.25  # times the speed of the last steady motion: friction has another share of the voltage farther off
PERIODS = 2.5  # sample periods that may pass between two answers: one sample may be lost
# Times `sample_timeout`. For KEPT time has to be kept, 2.5 time constants of the paper's motor; after RESIGNED the law
# acts as ever whether or not the motor is back, for there is another load; in FORGET one lapse is forgotten.
KEPT, RESIGNED, FORGET = 2.0, 10.0, 20.0
MOST_KEPT = 16.0  # times KEPT: who asks again after that waits no longer
HELD_UP = (
    "The controller was held up for {:.0f} ms, not for the first time, and the motor gets 0 V until it has kept its "
    "time for {:.2g} s: give the controller more processor time, or lower sample_rate."
)
NEARBY = (
    "The controller was held up for {:.0f} ms, and until it keeps its time the voltage stays near what held this speed "
    "before: give the controller more processor time, or lower sample_rate."
)


@dataclass(frozen=True, slots=True)
class Timekeeping:
    """How the controller has kept its time so far; times are [s]."""

    kept: float = inf  # for which no answer was too late
    longest: float = 0.0  # between two answers, or of a sample to its answer, when it was too long last
    cautious: bool = False
    old: float | None = None  # for which samples have been too old to act on; None: the latest one was not
    stale: bool = False  # they have been for too long, and get 0 V
    lapses: float = 0.0  # less what is forgotten of them
    wait: float = 0.0  # for which time has to be kept before the motor is driven; 0: it may be

    @property
    def waiting(self) -> str:
        """Why the motor gets 0 V, as a sentence; "": it may be driven."""
        return HELD_UP.format(1e3 * self.longest, self.wait) if self.wait else ""

    @property
    def caution(self) -> str:
        """Why the voltage stays near what held the speed, as a sentence; "": it need not."""
        return NEARBY.format(1e3 * self.longest) if self.cautious else ""


def find_longest_hold(gains: pi.Config, faults: FaultConfig, motion: Motion | None, latency_limit: float) -> float:
    """Find how long [s] an answer may be held without an overshoot; where the motor is not known, the latency limit."""
    kv, time_constant = faults.kv, faults.time_constant
    if kv == 0.0 and motion is not None and motion.held_speed > 0.0 and gains.ki > 0.0:
        kv, time_constant = motion.held_voltage / motion.held_speed, gains.kp / gains.ki
    if kv == 0.0 or gains.kp == 0.0:
        return latency_limit
    return time_constant * log1p(kv / gains.kp)


def keep_time(
    before: Timekeeping, gap: float, longest_hold: float, sample_timeout: float, late: float = 0.0, borne: float = 0.0
) -> Timekeeping:
    """Follow one sample that is answered `gap` [s] after the one before.

    late [s]: the age at which it is too old to act on, 0: it is not; borne [s]: for how long such samples are.
    """
    missed = late > 0.0 or gap > longest_hold
    kept = 0.0 if missed else before.kept + gap
    since = 0.0 if before.old is None else before.old + min(gap, longest_hold)  # and no pause in between
    return Timekeeping(
        kept,
        max(gap, late) if missed else before.longest,
        missed or (before.cautious and kept < RESIGNED * sample_timeout),
        since if late > 0.0 else None,
        late > 0.0 and since >= borne,
        max(before.lapses - gap / (FORGET * sample_timeout), 0.0),
        before.wait if kept < before.wait else 0.0,
    )


def count_lapse(before: Timekeeping, after: Timekeeping, gap: float, sample_timeout: float) -> Timekeeping:
    """Count a lapse of a loop that drives the motor, if this is one; while it waits there is none."""
    lapsed = (after.stale and not before.stale) or gap > sample_timeout
    if before.wait or not lapsed:
        return after
    lapses = after.lapses + 1.0
    wait = KEPT * sample_timeout * min(2.0 ** (round(lapses) - 2), MOST_KEPT) if round(lapses) > 1 else 0.0
    return replace(after, lapses=lapses, wait=wait)


def regain(timing: Timekeeping, reference: float, speed: float, sample_timeout: float) -> Timekeeping:
    """End the caution of a loop that keeps its time again, where the motor is back at its reference [rad/s]."""
    back = abs(speed - reference) <= MARGIN * abs(reference)
    return replace(timing, cautious=False) if back and timing.kept >= KEPT * sample_timeout else timing


def find_holding_voltage(motion: Motion | None, wanted: float) -> float:
    """Find the voltage [V], a magnitude, that holds a speed [rad/s] by the last steady motion; 0: that is not known."""
    if motion is None or motion.held_speed == 0.0:
        return 0.0
    share = wanted * motion.steady_way / motion.held_speed
    return motion.held_voltage * share if NEAR[0] <= share <= NEAR[1] else 0.0


def limit_held(allowed: Span, motion: Motion, wanted: float, reference: float, speed: float) -> Span:
    """Keep the voltage within what may be held, where that is known.

    wanted, reference, speed [rad/s]: what is asked for, the same behind the rate limit, and how fast the motor turns.
    """
    volts = find_holding_voltage(motion, wanted)
    if volts == 0.0:
        return allowed
    less = reference != wanted or speed / wanted > 1.0 + MARGIN  # than what holds the speed may be right
    ends = (0.0 if less else (1.0 - MARGIN) * volts, (1.0 + MARGIN) * volts)
    low, high = sorted(copysign(end, wanted) for end in ends)
    low, high = (min(max(end, allowed.low), allowed.high) for end in (low, high))
    return allowed._replace(low=low, high=high)
