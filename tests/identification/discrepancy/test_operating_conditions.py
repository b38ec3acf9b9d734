"""What the motor was doing in every interval, held against the plant's truth."""

from dataclasses import replace
from math import tau

import numpy as np
from diagnosed import BASE, held_with_true_gains
from plant import profiles, record

from motor_identification.discrepancy.operating_conditions import find_conditions
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.problem import make_problem
from motor_identification.recording import check
from motor_identification.validation.hold_out import make_hold_out

FRICTION = {"ks": 0.4}
DISC = {"eccentricity": 0.03, "eccentricity_phase": 1.0}


def test_conditions_are_what_the_motor_did() -> None:
    recording, truth = record(BASE | FRICTION, *profiles.reversals(8.0), seed=3)
    kept = make_hold_out([check(recording)], [check(recording)])
    problem = make_problem([check(recording)], ())
    seen = find_conditions(kept.validate(Estimate(problem, np.log([BASE["kv"], BASE["ka"]]))))
    moving = ~seen.still
    assert np.sum(moving) > 200
    speed = np.interp(seen.time, truth.time, truth.speed)
    fast = moving & (np.abs(speed) > 20.0)
    assert np.median(np.abs(seen.speed - speed)[fast]) < 0.3
    pushed = np.interp(seen.time, truth.time, np.gradient(np.abs(truth.speed), truth.time))
    strong = fast & (np.abs(pushed) > 100.0)
    assert np.median(np.abs(seen.acceleration / pushed - 1.0)[strong]) < 0.05
    turned = np.searchsorted(truth.reversal_time, seen.time) - 1
    after = fast & (turned >= 0)
    since = seen.time[after] - truth.reversal_time[turned[after]]
    assert np.max(np.abs(seen.since[after] - since)) < 0.06  # a slot takes that long where the motor is slowest
    at = np.searchsorted(recording.time, seen.time, side="right") - 1
    assert np.array_equal(seen.voltage, recording.voltage[at])


def test_the_angle_is_the_measured_one() -> None:
    """The disc is the same in every turn: the angle within a run advances as the truth does, to a fifth of a slot."""
    one = held_with_true_gains(**DISC)
    seen = find_conditions(one)
    recording, truth = record(
        BASE | DISC, *profiles.rich(9.0, seed=5), seed=2, disc_seed=1, irregularity=0.003
    )  # the held-out recording of `diagnosed`, with what really happened
    first = (seen.time < 4.0) & ~seen.still
    angle = np.interp(seen.time[first], truth.time, truth.angle)
    off = np.mod(seen.angle[first] - angle + np.pi, tau) - np.pi
    # The disc shows θ + e·sin: off by twice e at most, from the angle at the start.
    assert np.ptp(off) < 2.5 * DISC["eccentricity"]
    assert recording.duration > 30.0


def test_a_recording_of_which_nothing_counts_has_no_conditions() -> None:
    recording, _ = record(BASE, *profiles.reversals(8.0, times=2), seed=3)
    kept = make_hold_out([check(recording)] * 2, [check(recording)] * 2)
    held = kept.validate(Estimate(make_problem([check(recording)], ()), np.log([BASE["kv"], BASE["ka"]])))
    half = replace(held, scored=(held.scored[0], np.zeros_like(held.scored[1])))
    seen = find_conditions(half.joined(0.1))
    assert len(seen.since) > 0 and set(seen.recording.tolist()) == {0}
